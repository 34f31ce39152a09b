#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "components/config/config_node.h"
#include "components/config/parameters.h"
#include "messages/schema.h"
#include "messages/value.h"

namespace ensonify {

class ConfigReader;

namespace expect {

/// Value inside a message, named by a path: keys and indices between dots ("position_enu_m.2"), the name of a list's
/// element ("counters.pings.count"), and at the end of a path to an array or a list of numbers one of
/// min, max, mean, any (1 if one is not 0), all (1 if none is 0), nonzero (how many are not 0), size. It is a number,
/// or a text (a boolean is "true" or "false").
using Scalar = std::variant<double, std::string>;

/// The value at the path, or nothing: no such element, or the reduction of nothing. NaN elements do not count in
/// min, max and mean.
std::optional<Scalar> value_at(const msg::Value& message, const std::string& path);

/// Reason that no message of this type has a single value at the path; "" if one can.
std::string path_fault(const msg::TypeInfo& type, const std::string& path);

/// As people read it: 3.5, "done".
std::string text_of(const Scalar& value);

/// A field's path, and where the user wrote it.
struct FieldPath {
  std::string path;
  ConfigPlace place;

  void read(ConfigReader& from, const char* key);
  ConfigNode in_file() const { return ConfigNode::text(path); }
  static std::string schema() { return R"({"type": "string"})"; }
};

/// `{field: state, equals: done}`: a field and what its value must be. Several comparisons must all hold.
struct Condition {
  FieldPath field;
  std::optional<std::string> equals;  // as written; a number compares as a number
  std::optional<std::string> differs;
  std::optional<double> above, below, at_least, at_most;

  static void parameters(auto& self, auto&& visit) {
    visit("field", "", must(any()), "path of a value in the message: position_enu_m.2", self.field);
    visit("equals", "", any(), "the value; a number compares as a number", self.equals);
    visit("not", "", any(), "value that must not be", self.differs);
    visit("above", "", any(), "the value is greater", self.above);
    visit("below", "", any(), "the value is less", self.below);
    visit("at_least", "", any(), "the value is this or greater", self.at_least);
    visit("at_most", "", any(), "the value is this or less", self.at_most);
  }
  void check(const ConfigReader& from) const;

  /// A text never is above or below anything, and NaN satisfies nothing but `not`.
  bool holds(const Scalar& value) const;
  /// "state = done".
  std::string text() const;
};

}  // namespace expect

/// Messages that an expectation is about.
struct Messages {
  std::string topic;
  std::optional<expect::Condition> where;  // not given: all of the topic

  static void parameters(auto& self, auto&& visit) {
    visit("topic", "", must(not_empty()), "PROCESS/PORT of the output", self.topic);
    visit("where", "messages of the topic that count; left out: all", self.where);
  }
  /// "bow/ping", "pilot/mission with state = done".
  std::string text() const;
};

/// One expectation of a launch file, as its user wrote it.
struct Expectation {
  enum class Kind { kCount, kRate, kBounds, kEventually, kNeverSeen, kOrder, kNoGap, kSameAs };
  static constexpr double kLongest_s = 1e7;

  Kind kind = Kind::kCount;
  std::string name;           // unique; what it says, unless the user named it
  Messages messages;          // all kinds but same_as; of `order`: first
  Messages then;              // order
  expect::FieldPath field;    // bounds
  std::optional<double> min;  // count, bounds
  std::optional<double> max;
  double hz = 0.0;                  // rate
  double tolerance = 0.05;          // rate, as a fraction
  double after_s = 0.0;             // bounds, never, rate: earlier messages do not count
  double within_s = 0.0;            // eventually
  std::string record;               // same_as: path
  std::vector<std::string> topics;  // same_as: only these; empty: all of the record

 protected:
  static void topic_only(auto& self, auto&& visit) {
    visit("topic", "", must(not_empty()), "PROCESS/PORT of the output", self.messages.topic);
  }
  static void after(auto& self, auto&& visit) {
    visit("after_s", "s", in(0, kLongest_s), "earlier messages do not count", self.after_s);
  }
  static void limits(auto& self, double least, auto&& visit) {
    visit("min", "", in(least, 1e300), "least that is allowed; give min, max or both", self.min);
    visit("max", "", in(least, 1e300), "most that is allowed", self.max);
  }
  void check_limits(const ConfigReader& from) const;
  std::string limits_text() const;
  std::string after_text() const;
};

/// The kinds: each lists its part of an expectation, and says what it expects.
struct CountExpected : Expectation {
  static constexpr Kind kKind = Kind::kCount;
  static void parameters(auto& self, auto&& visit) {
    Messages::parameters(self.messages, visit);
    limits(self, 0.0, visit);
  }
  void check(const ConfigReader& from) const { check_limits(from); }
  std::string text() const;
};
struct RateExpected : Expectation {
  static constexpr Kind kKind = Kind::kRate;
  static void parameters(auto& self, auto&& visit) {
    topic_only(self, visit);
    visit("hz", "Hz", must(in(1e-6, 1e6)), "rate in sim time", self.hz);
    visit("tolerance", "", in(0, 1), "deviation allowed, as a fraction of the rate", self.tolerance);
    after(self, visit);
  }
  std::string text() const;
};
struct BoundsExpected : Expectation {
  static constexpr Kind kKind = Kind::kBounds;
  static void parameters(auto& self, auto&& visit) {
    Messages::parameters(self.messages, visit);
    visit("field", "", must(any()), "path of a value in the message", self.field);
    limits(self, -1e300, visit);
    after(self, visit);
  }
  void check(const ConfigReader& from) const { check_limits(from); }
  std::string text() const;
};
struct EventuallyExpected : Expectation {
  static constexpr Kind kKind = Kind::kEventually;
  static void parameters(auto& self, auto&& visit) {
    Messages::parameters(self.messages, visit);
    visit("within_s", "s", must(in(0, kLongest_s)), "sim time by which it must have come", self.within_s);
  }
  std::string text() const;
};
struct NeverExpected : Expectation {
  static constexpr Kind kKind = Kind::kNeverSeen;
  static void parameters(auto& self, auto&& visit) {
    Messages::parameters(self.messages, visit);
    after(self, visit);
  }
  void check(const ConfigReader& from) const;
  std::string text() const;
};
struct OrderExpected : Expectation {
  static constexpr Kind kKind = Kind::kOrder;
  static void parameters(auto& self, auto&& visit) {
    visit("first", "message that must come first", self.messages);
    visit("then", "message that must come after it", self.then);
  }
  void check(const ConfigReader& from) const;
  std::string text() const;
};
struct NoGapExpected : Expectation {
  static constexpr Kind kKind = Kind::kNoGap;
  static void parameters(auto& self, auto&& visit) { topic_only(self, visit); }
  std::string text() const;
};
struct SameAsExpected : Expectation {
  static constexpr Kind kKind = Kind::kSameAs;
  static void parameters(auto& self, auto&& visit) {
    visit("record", "", must(path()), "whose messages the run repeats", self.record);
    visit("topics", "", any(), "topics to compare; none: all of the record", self.topics);
  }
  std::string text() const;
};

/// An entry of the list: exactly one kind, and a name.
struct ExpectEntry {
  std::string name;
  std::optional<CountExpected> count;
  std::optional<RateExpected> rate;
  std::optional<BoundsExpected> bounds;
  std::optional<EventuallyExpected> eventually;
  std::optional<NeverExpected> never;
  std::optional<OrderExpected> order;
  std::optional<NoGapExpected> no_gap;
  std::optional<SameAsExpected> same_as;

  static void parameters(auto& self, auto&& visit) {
    visit("name", "", any(), "name of the verdict; left out: what the entry says", self.name);
    visit("count", "number of messages", self.count);
    visit("rate", "messages a second, from the first to the run's end", self.rate);
    visit("bounds", "limits of a field, in every message", self.bounds);
    visit("eventually", "a message that comes in time", self.eventually);
    visit("never", "a message that does not come", self.never);
    visit("order", "a message that comes after another", self.order);
    visit("no_gap", "sequence numbers from 0 without a gap", self.no_gap);
    visit("same_as", "a record whose messages come again: time, number and bytes", self.same_as);
  }
  void check(const ConfigReader& from) const;
  /// The one that is given.
  std::optional<Expectation> expectation() const;
};

struct ExpectParameters {
  std::vector<ExpectEntry> entries;

  static void parameters(auto& self, auto&& visit) {
    visit("expect", "list of what must hold, each entry of one kind; the launch file's own", self.entries);
  }
};

struct ExpectConfig {
  using Parameters = ExpectParameters;
  std::vector<Expectation> expectations;

  static ExpectConfig read(ConfigReader& from);
};

}  // namespace ensonify
