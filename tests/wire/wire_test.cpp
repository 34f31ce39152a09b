// Bytes of every message type, stored once and never changed: what was written by an old version must stay readable.
// A file `ping_1.hex` holds the frames behind the envelope of one ping/1, one frame per line. When a type gains a field
// its old file stays, and `ping_1.b.hex` joins it (`wire_test "[store]"` writes what is missing).
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "messages/all.h"
#include "messages/codec.h"

using namespace ensonify::msg;
namespace fs = std::filesystem;

namespace {

fs::path folder() { return fs::path(std::getenv("ENSONIFY_SOURCE")) / "tests/wire/bytes"; }

/// Gives every field a value of its own, none of them the default.
class Filler {
 public:
  template <class T>
  void fill(T& member) {
    ++count_;
    if constexpr (std::is_same_v<T, bool>) {
      member = true;
    } else if constexpr (std::is_integral_v<T>) {
      member = static_cast<T>(-1000 - count_);
    } else if constexpr (std::is_floating_point_v<T>) {
      member = static_cast<T>(count_ + 0.25);
    } else if constexpr (std::is_same_v<T, std::string>) {
      member = "text " + std::to_string(count_);
    } else if constexpr (IsArray<T>::value) {
      member = T({2, 3});
      for (std::size_t i = 0; i < member.size(); ++i) {
        using Element = std::remove_cvref_t<decltype(member[i])>;
        member[i] = static_cast<Element>(10 * count_ + static_cast<int>(i));
      }
    } else if constexpr (IsFixed<T>::value) {
      for (auto& element : member) fill(element);
    } else if constexpr (IsVector<T>::value) {
      member.resize(2);
      for (auto& element : member) fill(element);
    } else {
      T::fields(member, [this](const char*, const char*, const char*, auto& field) { this->fill(field); });
    }
  }

 private:
  int count_ = 0;
};

std::string hex(const Buffer& bytes) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const std::byte b : bytes.bytes()) {
    text += kDigits[std::to_integer<int>(b) >> 4];
    text += kDigits[std::to_integer<int>(b) & 15];
  }
  return text;
}

Buffer unhex(const std::string& text) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(text.substr(i, 2), nullptr, 16));
  }
  return Buffer::own(std::move(bytes));
}

std::string text_of(const Body& body) {
  std::string text = hex(body.map) + "\n";
  for (const Buffer& array : body.arrays) text += hex(array) + "\n";
  return text;
}

Body body_of(const std::string& text) {
  Body body;
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  body.map = unhex(line);
  while (std::getline(lines, line)) body.arrays.push_back(unhex(line));
  return body;
}

std::string read_file(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// "ping_1" for ping/1; `.b`, `.c` follow in files of later versions.
std::string stem_of(std::string type) {
  std::replace(type.begin(), type.end(), '/', '_');
  return type;
}

/// Stored files of a type, oldest first.
std::vector<fs::path> stored(const std::string& type) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder())) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(stem_of(type) + ".", 0) == 0) files.push_back(entry.path());
  }
  // "ping_1.b.hex" < "ping_1.hex": the file without a letter is the first.
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return std::pair(a.string().size(), a.string()) < std::pair(b.string().size(), b.string());
  });
  return files;
}

template <class M>
Body filled() {
  M message;
  Filler().fill(message);
  return encode(message);
}

}  // namespace

TEST_CASE("what was stored decodes to the fields that it holds") {
  for_each_message([](const auto& example) {
    using M = std::remove_cvref_t<decltype(example)>;
    for (const fs::path& file : stored(M::kType)) {
      INFO(file.filename());
      const Body body = body_of(read_file(file));
      const Value written = decode_value(body, body.size());
      const Value read = to_value(decode<M>(body, body.size()));
      for (const MapEntry& entry : *written.as<Value::Map>()) {
        INFO(entry.first);
        const Value* field = read.find(entry.first);
        REQUIRE(field);
        CHECK((*field == entry.second));
      }
    }
  });
}

TEST_CASE("what is encoded today is the newest that is stored") {
  for_each_message([](const auto& example) {
    using M = std::remove_cvref_t<decltype(example)>;
    INFO(
        M::kType << ": after adding a field, store its bytes with `wire_test \"[store]\"`; never change a stored file");
    const auto files = stored(M::kType);
    REQUIRE_FALSE(files.empty());
    CHECK(read_file(files.back()) == text_of(filled<M>()));
  });
}

TEST_CASE("store the bytes of types that have changed", "[.][store]") {
  for_each_message([](const auto& example) {
    using M = std::remove_cvref_t<decltype(example)>;
    const std::string text = text_of(filled<M>());
    const auto files = stored(M::kType);
    if (!files.empty() && read_file(files.back()) == text) return;
    const std::string letter = files.empty() ? "" : std::string(".") + static_cast<char>('a' + files.size());
    std::ofstream(folder() / (stem_of(M::kType) + letter + ".hex")) << text;
  });
  SUCCEED();
}

TEST_CASE("the envelope has the layout of docs/manual/wire.md") {
  const Envelope envelope{1, 1, 0x04030201, 0x08070605, 0x0C0B0A09, 0x100F0E0D, 0x1817161514131211, 0x201F1E1D1C1B1A19,
                          -2};
  const std::string stored_bytes = read_file(folder() / "envelope.hex");
  const auto bytes = encode_envelope(envelope);
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  CHECK(hex(Buffer::own(text)) + "\n" == stored_bytes);
  CHECK(decode_envelope(unhex(stored_bytes.substr(0, 128)).bytes()) == envelope);
}
