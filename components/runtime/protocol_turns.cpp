// GRANT and DONE: numbers, low byte first.
#include <cstring>

#include "components/runtime/protocol.h"

namespace ensonify::protocol {
namespace {

template <class T>
void put(std::string& to, T value) {
  to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Reads little-endian numbers from the front; remembers when there were too few bytes.
struct Cursor {
  std::string_view rest;
  bool good = true;

  template <class T>
  T get() {
    T value{};
    if (rest.size() < sizeof value) return good = false, value;
    std::memcpy(&value, rest.data(), sizeof value);
    rest.remove_prefix(sizeof value);
    return value;
  }
  TopicCounts counts() {
    const auto n = get<std::uint32_t>();
    TopicCounts counts;
    for (std::uint32_t i = 0; i < n && good; ++i) {
      const auto topic = get<std::uint32_t>();
      counts.emplace_back(topic, get<std::uint64_t>());
    }
    return counts;
  }
};

void put_counts(std::string& to, const TopicCounts& counts) {
  put(to, static_cast<std::uint32_t>(counts.size()));
  for (const auto& [topic, count] : counts) {
    put(to, topic);
    put(to, count);
  }
}

}  // namespace

std::string encode(const Grant& grant) {
  std::string bytes = "G";
  put(bytes, grant.epoch);
  put(bytes, static_cast<std::int64_t>(grant.horizon.count()));
  put_counts(bytes, grant.inputs);
  return bytes;
}

std::optional<Grant> read_grant(std::string_view bytes) {
  if (bytes.empty() || bytes[0] != 'G') return std::nullopt;
  Cursor cursor{bytes.substr(1)};
  Grant grant;
  grant.epoch = cursor.get<std::uint32_t>();
  grant.horizon = SimTime{cursor.get<std::int64_t>()};
  grant.inputs = cursor.counts();
  if (!cursor.good || !cursor.rest.empty()) return std::nullopt;
  return grant;
}

std::string encode(const Done& done) {
  std::string bytes = "D";
  put(bytes, done.epoch);
  put(bytes, static_cast<std::int64_t>(done.next.count()));
  put(bytes, static_cast<std::uint8_t>(done.finish ? 1 : 0));
  put(bytes, done.cost_ns);
  put_counts(bytes, done.outputs);
  return bytes;
}

std::optional<Done> read_done(std::string_view bytes) {
  if (bytes.empty() || bytes[0] != 'D') return std::nullopt;
  Cursor cursor{bytes.substr(1)};
  Done done;
  done.epoch = cursor.get<std::uint32_t>();
  done.next = SimTime{cursor.get<std::int64_t>()};
  done.finish = (cursor.get<std::uint8_t>() & 1) != 0;
  done.cost_ns = cursor.get<std::int64_t>();
  done.outputs = cursor.counts();
  if (!cursor.good || !cursor.rest.empty()) return std::nullopt;
  return done;
}

}  // namespace ensonify::protocol
