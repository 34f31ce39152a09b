#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/expect/condition.h"

namespace ensonify {

class ConfigReader;

/// Messages that an expectation is about.
struct Messages {
  std::string topic;
  std::optional<expect::Condition> where;  // not given: all of the topic

  /// "bow/ping", "pilot/mission with state = done".
  std::string text() const;
};

/// One expectation of a launch file, as its user wrote it.
struct Expectation {
  enum class Kind { kCount, kRate, kBounds, kEventually, kNeverSeen, kOrder, kNoGap, kSameAs };

  Kind kind = Kind::kCount;
  std::string name;           // unique; what it says, unless the user named it
  Messages messages;          // all kinds but same_as; of `order`: first
  Messages then;              // order
  std::string field;          // bounds
  ConfigPlace field_place;    // bounds
  std::optional<double> min;  // count, bounds
  std::optional<double> max;
  double hz = 0.0;                  // rate
  double tolerance = 0.05;          // rate, as a fraction
  double after_s = 0.0;             // bounds, never, rate: earlier messages do not count
  double within_s = 0.0;            // eventually
  std::string record;               // same_as: path
  std::vector<std::string> topics;  // same_as: only these; empty: all of the record
};

struct ExpectConfig {
  std::vector<Expectation> expectations;

  static ExpectConfig read(ConfigReader& from);
};

}  // namespace ensonify
