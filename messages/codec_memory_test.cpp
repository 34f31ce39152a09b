// How much memory the decoder takes for messages made to make it take much. Counts every allocation of this program.
#include <malloc.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <new>

#include "messages/codec.h"
#include "messages/sonar.h"

namespace {
std::atomic<std::size_t> in_use{0};
std::atomic<std::size_t> peak{0};

void note_allocation(void* memory) {
  const std::size_t now = in_use += ::malloc_usable_size(memory);
  if (now > peak) peak = now;
}
}  // namespace

// Not inlined: g++ 12 would see free() get a new that it takes for the library's.
[[gnu::noinline]] void* operator new(std::size_t size) {
  void* memory = std::malloc(size);
  if (!memory) throw std::bad_alloc();
  note_allocation(memory);
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  if (memory) in_use -= ::malloc_usable_size(memory);
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }

using namespace ensonify::msg;
using namespace std::string_literals;

namespace {

/// Bytes allocated at most while the message is examined.
std::size_t cost(const std::string& map) {
  const Body body{Buffer::own(map), {}};
  const std::size_t before = in_use;
  peak = before;
  try {
    decode<Ping>(body, kMaxMapBytes);
  } catch (const DecodeError&) {
  }
  return peak - before;
}

constexpr std::size_t kMost = 4 * kMaxValues * sizeof(Value);  // lists double as they grow; the old half is alive then

/// A map with one key, and what stands under it.
std::string under_key(const std::string& key, std::initializer_list<std::string> parts) {
  std::string map(1, '\x81');
  map.push_back(static_cast<char>(0xA0 + key.size()));
  map.append(key);
  for (const std::string& part : parts) map.append(part);
  return map;
}

}  // namespace

TEST_CASE("what a message promises costs nothing until its bytes are there") {
  CHECK(cost("\xDF\xFF\xFF\xFF\xFF") < 4096);                    // a map of 4 billion
  CHECK(cost(under_key("a", {"\xDD\xFF\xFF\xFF\xFF"})) < 4096);  // a list of 4 billion
  CHECK(cost(under_key("a", {"\xDB\xFF\xFF\xFF\xFF"})) < 4096);  // a text of 4 GB
  CHECK(cost(under_key("a", {"\xC6\xFF\xFF\xFF\xFF"})) < 4096);  // bytes, 4 GB
  // An array of 4 GB without its frame.
  CHECK(cost(under_key("beam_angle_rad", {"\x83\xA5", "dtype", "\xA2", "f4", "\xA5", "shape", "\x91\xCE\x40"s,
                                          std::string(3, '\0'), "\xA5", "frame", "\x03"})) < 8192);
}

TEST_CASE("a map full of the smallest values stays within the bound on values") {
  CHECK(cost(under_key("a", {"\xDD\x00\x0F\xFF\x00"s, std::string(0x0FFF00, '\xC0')})) < kMost);
  std::string lists;
  for (int i = 0; i < 100'000; ++i) lists.append("\x91\x90");  // lists of empty lists
  CHECK(cost(under_key("a", {"\xDD\x00\x01\x86\xA0"s, lists})) < kMost);
}
