#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

struct evp_md_ctx_st;  // OpenSSL's

namespace ensonify::tiles {

/// Error that makes a tile set unreadable or unwritable; the text says where and why.
struct TileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A square grey image in memory, rows from the north as images have them.
template <class Value>
struct GreyImage {
  int side = 0;
  std::vector<Value> value;
};

/// PNG, lossless. The bytes depend on the values and the version of libpng only. Throws TileError.
std::vector<std::uint8_t> encode_png(const GreyImage<std::uint16_t>& image);
std::vector<std::uint8_t> encode_png(const GreyImage<std::uint8_t>& image);

/// The reverse. Throws TileError for anything but a whole grey PNG of that depth and `side` by `side` values.
void decode_png(std::span<const std::uint8_t> png, int side, GreyImage<std::uint16_t>& image);
void decode_png(std::span<const std::uint8_t> png, int side, GreyImage<std::uint8_t>& image);

/// The whole file. Throws TileError naming it.
std::vector<std::uint8_t> read_file(const std::string& path);

/// Writes beside the path first and renames, so that no half file is ever seen there. Throws TileError naming it.
void write_file(const std::string& path, std::span<const std::uint8_t> bytes);
void write_file(const std::string& path, std::string_view text);

/// CRC-32C (Castagnoli's polynomial, reflected, as iSCSI has it) [RFC3720, appendix B.4]: finds what a disk or a power
/// cut has spoilt, in a fifth of the time that SHA-256 takes; not what somebody has forged. `before`: that of the bytes
/// before these.
std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t before = 0);

/// SHA-256 of bytes that come in pieces [FIPS180-4]. Throws TileError if the cryptographic library refuses.
class Sha256 {
 public:
  Sha256();
  void add(std::span<const std::byte> bytes);
  /// Digest of all that was added, as 64 hexadecimal digits; the last call.
  std::string digest();

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

/// Throws TileError, naming the file, if it cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace ensonify::tiles
