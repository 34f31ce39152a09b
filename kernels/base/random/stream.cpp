#include "kernels/base/random/stream.h"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

namespace ensonify::random {
namespace {

/// FNV-1a: short, and the same on every machine, unlike std::hash.
std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char letter : text) {
    hash ^= static_cast<unsigned char>(letter);
    hash *= 0x100000001b3ULL;
  }
  return hash;
}

double open_unit(std::uint32_t low, std::uint32_t high) {
  const std::uint64_t word = (static_cast<std::uint64_t>(high) << 32) | low;
  return (static_cast<double>(word >> 12) + 0.5) * 0x1p-52;  // 52 bits and the half step never round to 0 or 1
}

}  // namespace

std::array<std::uint32_t, 4> philox_block(const std::array<std::uint32_t, 4>& counter,
                                          const std::array<std::uint32_t, 2>& key) {
  const r123::Philox4x32::ctr_type c{{counter[0], counter[1], counter[2], counter[3]}};
  const r123::Philox4x32::key_type k{{key[0], key[1]}};
  const auto r = r123::Philox4x32{}(c, k);
  return {r[0], r[1], r[2], r[3]};
}

Stream::Stream(std::uint64_t seed, std::string_view name) : key_(mix(mix(seed + 1) ^ hash_of(name))) {}

std::array<std::uint32_t, 4> Stream::bits(std::uint64_t a, std::uint64_t b, std::uint64_t c) const {
  // Two counters fill Philox's 128 bits. The third changes the key, one-to-one, so no two triples share a block.
  const std::uint64_t key = key_ ^ mix(c);
  return philox_block({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a >> 32),
                       static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(b >> 32)},
                      {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)});
}

double Stream::uniform(std::uint64_t a, std::uint64_t b, std::uint64_t c) const {
  const auto r = bits(a, b, c);
  return open_unit(r[0], r[1]);
}

double Stream::normal(std::uint64_t a, std::uint64_t b, std::uint64_t c) const { return normal_pair(a, b, c)[0]; }

std::array<double, 2> Stream::normal_pair(std::uint64_t a, std::uint64_t b, std::uint64_t c) const {
  const auto r = bits(a, b, c);
  const double radius = std::sqrt(-2.0 * std::log(open_unit(r[0], r[1])));
  const double angle = 2.0 * std::numbers::pi * open_unit(r[2], r[3]);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace ensonify::random
