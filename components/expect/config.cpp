#include "components/expect/config.h"

#include <fmt/format.h>

#include <map>

#include "components/config/config_reader.h"

namespace ensonify {
namespace {

using Kind = Expectation::Kind;

constexpr double kLongest_s = 1e7;

std::string limits_text(const Expectation& e) {
  if (e.min && e.max) return fmt::format("in [{}, {}]", *e.min, *e.max);
  return e.min ? fmt::format("at least {}", *e.min) : fmt::format("at most {}", e.max.value_or(0.0));
}

std::string after_text(const Expectation& e) { return e.after_s > 0.0 ? fmt::format(" after {} s", e.after_s) : ""; }

Messages read_messages(ConfigReader& from) {
  Messages messages;
  from.required("topic", messages.topic);
  if (auto where = from.optional_section("where")) messages.where = expect::Condition::read(*where);
  return messages;
}

void read_limits(ConfigReader& from, Expectation& e, double least) {
  from.optional("min", e.min, least, 1e300);
  from.optional("max", e.max, least, 1e300);
  if (!e.min && !e.max) from.problem("", "has no limit; give min, max or both");
  if (e.min && e.max && *e.min > *e.max) from.problem("max", "is below min");
}

void read_count(ConfigReader& from, Expectation& e) {
  e.messages = read_messages(from);
  read_limits(from, e, 0.0);
  e.name = fmt::format("count of {} {}", e.messages.text(), limits_text(e));
}

void read_rate(ConfigReader& from, Expectation& e) {
  from.required("topic", e.messages.topic);
  from.required("hz", e.hz, 1e-6, 1e6);
  from.optional("tolerance", e.tolerance, 0, 1);
  from.optional("after_s", e.after_s, 0, kLongest_s);
  e.name = fmt::format("rate of {} {} Hz{}", e.messages.topic, e.hz, after_text(e));
}

void read_bounds(ConfigReader& from, Expectation& e) {
  e.messages = read_messages(from);
  from.required("field", e.field);
  if (const ConfigNode* node = from.node("field")) e.field_place = node->place;
  read_limits(from, e, -1e300);
  from.optional("after_s", e.after_s, 0, kLongest_s);
  e.name = fmt::format("{} of {} {}{}", e.field, e.messages.text(), limits_text(e), after_text(e));
}

void read_eventually(ConfigReader& from, Expectation& e) {
  e.messages = read_messages(from);
  from.required("within_s", e.within_s, 0, kLongest_s);
  e.name = fmt::format("eventually {} within {} s", e.messages.text(), e.within_s);
}

void read_never(ConfigReader& from, Expectation& e) {
  e.messages = read_messages(from);
  if (!e.messages.where) from.problem("where", "is missing: to expect no message at all use count with max: 0");
  from.optional("after_s", e.after_s, 0, kLongest_s);
  e.name = fmt::format("never {}{}", e.messages.text(), after_text(e));
}

void read_order(ConfigReader& from, Expectation& e) {
  auto first = from.section("first"), then = from.section("then");
  e.messages = read_messages(first);
  e.then = read_messages(then);
  e.name = fmt::format("{} before {}", e.messages.text(), e.then.text());
}

void read_no_gap(ConfigReader& from, Expectation& e) {
  from.required("topic", e.messages.topic);
  e.name = "no gap in " + e.messages.topic;
}

void read_same_as(ConfigReader& from, Expectation& e) {
  from.required_path("record", e.record);
  from.optional("topics", e.topics);
  e.name = "same as " + e.record.substr(e.record.find_last_of('/') + 1);
}

struct KindEntry {
  const char* word;
  Kind kind;
  void (*read)(ConfigReader&, Expectation&);
};
constexpr KindEntry kKinds[] = {
    {"count", Kind::kCount, read_count},     {"rate", Kind::kRate, read_rate},
    {"bounds", Kind::kBounds, read_bounds},  {"eventually", Kind::kEventually, read_eventually},
    {"never", Kind::kNeverSeen, read_never}, {"order", Kind::kOrder, read_order},
    {"no_gap", Kind::kNoGap, read_no_gap},   {"same_as", Kind::kSameAs, read_same_as},
};

std::optional<Expectation> read_expectation(ConfigReader& from) {
  std::optional<Expectation> found;
  std::string words;
  int kinds = 0;
  for (const KindEntry& entry : kKinds) {
    words += (words.empty() ? "" : ", ") + std::string(entry.word);
    if (auto section = from.optional_section(entry.word)) {
      ++kinds;
      found.emplace().kind = entry.kind;
      entry.read(*section, *found);
    }
  }
  std::string name;
  from.optional("name", name);
  if (found && !name.empty()) found->name = name;
  if (kinds != 1)
    from.problem(
        "", std::string(kinds == 0 ? "says nothing" : "says several things") + "; give one of " + words + ", exit");
  return found;
}

}  // namespace

std::string Messages::text() const { return where ? topic + " with " + where->text() : topic; }

ExpectConfig ExpectConfig::read(ConfigReader& from) {
  ExpectConfig config;
  std::map<std::string, int> names;
  auto items = from.list("expect");
  if (items.empty()) from.problem("expect", "holds no expectation");
  for (ConfigReader& item : items) {
    auto expectation = read_expectation(item);
    if (!expectation) continue;
    if (const int before = names[expectation->name]++; before > 0) {
      expectation->name += fmt::format(" ({})", before + 1);
    }
    config.expectations.push_back(std::move(*expectation));
  }
  return config;
}

}  // namespace ensonify
