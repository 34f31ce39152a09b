#include "components/terrain/tiles/file_bytes.h"

#include <fmt/format.h>
#include <nmmintrin.h>
#include <openssl/evp.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <csetjmp>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace ensonify::tiles {
namespace {

void check(int answer) {
  if (answer != 1) throw TileError("no SHA-256 in the cryptographic library");
}

static_assert(std::endian::native == std::endian::little, "PNG's 16-bit values are swapped for little-endian machines");

constexpr int kCompression = 3;  // zlib's: twice as fast as its default, and 3 % larger

/// What libpng's callbacks reach: memory, and the text of an error.
struct Transfer {
  std::vector<std::uint8_t>* written = nullptr;
  std::span<const std::uint8_t> left;
  char fault[200] = "";
};

void fail(png_structp png, png_const_charp text) {
  auto* transfer = static_cast<Transfer*>(png_get_error_ptr(png));
  std::strncpy(transfer->fault, text, sizeof transfer->fault - 1);
  png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

void append(png_structp png, png_bytep bytes, std::size_t count) {
  auto* transfer = static_cast<Transfer*>(png_get_io_ptr(png));
  transfer->written->insert(transfer->written->end(), bytes, bytes + count);
}

void consume(png_structp png, png_bytep bytes, std::size_t count) {
  auto* transfer = static_cast<Transfer*>(png_get_io_ptr(png));
  if (count > transfer->left.size()) png_error(png, "the file ends too early");
  std::memcpy(bytes, transfer->left.data(), count);
  transfer->left = transfer->left.subspan(count);
}

/// False after an error. Holds nothing that a long jump would leave behind.
bool write(Transfer& transfer, const std::uint8_t* values, int side, int bytes_per_value) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &transfer, fail, ignore);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  const bool ready = info != nullptr && setjmp(png_jmpbuf(png)) == 0;
  if (ready) {
    const auto size = static_cast<png_uint_32>(side);
    png_set_write_fn(png, &transfer, append, nullptr);
    png_set_IHDR(png, info, size, size, 8 * bytes_per_value, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(png, kCompression);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, bytes_per_value == 2 ? PNG_FILTER_UP : PNG_FILTER_NONE);
    png_write_info(png, info);
    if (bytes_per_value == 2) png_set_swap(png);
    for (int row = 0; row < side; ++row)
      png_write_row(png, values + static_cast<std::ptrdiff_t>(row) * side * bytes_per_value);
    png_write_end(png, nullptr);
  }
  png_destroy_write_struct(&png, &info);
  return ready && transfer.fault[0] == '\0';
}

bool read(Transfer& transfer, std::uint8_t* values, int side, int bytes_per_value) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &transfer, fail, ignore);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  const bool ready = info != nullptr && setjmp(png_jmpbuf(png)) == 0;
  if (ready) {
    png_set_read_fn(png, &transfer, consume);
    png_read_info(png, info);
    const auto size = static_cast<png_uint_32>(side);
    if (png_get_image_width(png, info) != size || png_get_image_height(png, info) != size ||
        png_get_bit_depth(png, info) != 8 * bytes_per_value || png_get_color_type(png, info) != PNG_COLOR_TYPE_GRAY ||
        png_get_interlace_type(png, info) != PNG_INTERLACE_NONE) {
      png_error(png, "the image has another size or kind of values");
    }
    if (bytes_per_value == 2) png_set_swap(png);
    for (int row = 0; row < side; ++row)
      png_read_row(png, values + static_cast<std::ptrdiff_t>(row) * side * bytes_per_value, nullptr);
    png_read_end(png, nullptr);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  return ready && transfer.fault[0] == '\0';
}

template <class Value>
std::vector<std::uint8_t> encode(const GreyImage<Value>& image) {
  if (image.side < 1 ||
      image.value.size() != static_cast<std::size_t>(image.side) * static_cast<std::size_t>(image.side))
    throw TileError("an image needs side x side values");
  std::vector<std::uint8_t> bytes;
  Transfer transfer{.written = &bytes};
  if (!write(transfer, reinterpret_cast<const std::uint8_t*>(image.value.data()), image.side, sizeof(Value)))
    throw TileError(std::string("libpng: ") + transfer.fault);
  return bytes;
}

template <class Value>
void decode(std::span<const std::uint8_t> png, int side, GreyImage<Value>& image) {
  image.side = side;
  image.value.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  Transfer transfer{.left = png};
  if (!read(transfer, reinterpret_cast<std::uint8_t*>(image.value.data()), side, sizeof(Value)))
    throw TileError(std::string("is no whole PNG of a tile: ") + transfer.fault);
}

}  // namespace

std::vector<std::uint8_t> read_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw TileError(path + ": cannot be read: " + std::strerror(errno));
  stream.seekg(0, std::ios::end);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(std::max<std::streamoff>(0, stream.tellg())));
  stream.seekg(0);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream) throw TileError(path + ": cannot be read to its end");
  return bytes;
}

void write_file(const std::string& path, std::span<const std::uint8_t> bytes) {
  const std::string part = path + ".part";
  {
    std::ofstream stream(part, std::ios::binary | std::ios::trunc);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    stream.flush();
    if (!stream) {
      const std::string why = std::strerror(errno);
      stream.close();
      std::error_code ignored;
      std::filesystem::remove(part, ignored);
      throw TileError(path + ": cannot be written: " + why);
    }
  }
  std::filesystem::rename(part, path);
}

void write_file(const std::string& path, std::string_view text) {
  write_file(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t before) {
  std::uint64_t sum = ~before;
  for (; bytes.size() >= sizeof(std::uint64_t); bytes = bytes.subspan(sizeof(std::uint64_t))) {
    std::uint64_t word;
    std::memcpy(&word, bytes.data(), sizeof word);
    sum = _mm_crc32_u64(sum, word);
  }
  auto last = static_cast<std::uint32_t>(sum);
  for (const std::byte byte : bytes) last = _mm_crc32_u8(last, std::to_integer<std::uint8_t>(byte));
  return ~last;
}

Sha256::Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
  check(context_ ? EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) : 0);
}

void Sha256::add(std::span<const std::byte> bytes) {
  check(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()));
}

std::string Sha256::digest() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  check(EVP_DigestFinal_ex(context_.get(), digest.data(), &length));
  std::string text;
  for (unsigned int i = 0; i < length; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

std::string sha256_of_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw TileError(path + ": cannot be read: " + std::strerror(errno));
  Sha256 sum;
  std::vector<char> buffer(1 << 20);
  while (stream) {
    stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    sum.add(std::as_bytes(std::span(buffer).first(static_cast<std::size_t>(stream.gcount()))));
  }
  if (!stream.eof()) throw TileError(path + ": cannot be read to its end");
  return sum.digest();
}

std::vector<std::uint8_t> encode_png(const GreyImage<std::uint16_t>& image) { return encode(image); }
std::vector<std::uint8_t> encode_png(const GreyImage<std::uint8_t>& image) { return encode(image); }
void decode_png(std::span<const std::uint8_t> png, int side, GreyImage<std::uint16_t>& image) {
  decode(png, side, image);
}
void decode_png(std::span<const std::uint8_t> png, int side, GreyImage<std::uint8_t>& image) {
  decode(png, side, image);
}

}  // namespace ensonify::tiles
