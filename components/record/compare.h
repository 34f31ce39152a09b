#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "components/record/reader.h"
#include "messages/value.h"

namespace ensonify::record {

/// The first thing, in sim time, that two records do not share.
struct Difference {
  SimTime t_sim{0};  // of the message, in A if it has it
  std::string topic;
  std::uint32_t seq = 0;
  std::string field;  // "t_sim_ns", a field such as "position_enu_m.2", or "" when one record lacks the message
  std::string a;
  std::string b;
};

/// Messages of one topic in both records.
struct TopicComparison {
  std::string topic;
  std::uint64_t a = 0;
  std::uint64_t b = 0;
  std::uint64_t only_a = 0;  // lost in B
  std::uint64_t only_b = 0;  // added in B
  std::uint64_t differing = 0;
};

struct Comparison {
  std::optional<Difference> first;  // nothing: the same messages
  std::vector<TopicComparison> topics;
  std::vector<std::string> notes;  // what differs beside the messages: facts, types, a record that ends early
};

/// Compares message by message, matched by topic and sequence number. Topics can be limited to names and patterns
/// ("bow/*"); none means all.
Comparison compare(RecordReader& a, RecordReader& b, const std::vector<std::string>& topics = {});

}  // namespace ensonify::record
