#include "components/expect/config.h"

#include <fmt/format.h>

#include <map>

#include "components/config/config_node.h"
#include "components/config/parameter_info.h"
#include "components/config/read_parameters.h"

namespace ensonify {
namespace expect {
namespace {

bool same(const Scalar& value, const std::string& wanted) {
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr) return std::get<std::string>(value) == wanted;
  const auto wanted_number = parse_number(wanted);
  return wanted_number && *number == *wanted_number;
}

}  // namespace

void FieldPath::read(ConfigReader& from, const char* key) {
  from.required(key, path);
  if (const ConfigNode* node = from.node(key)) place = node->place;
}

void Condition::check(const ConfigReader& from) const {
  if (!equals && !differs && !above && !below && !at_least && !at_most) {
    from.problem("", "compares nothing; give one of equals, not, above, below, at_least, at_most");
  }
}

bool Condition::holds(const Scalar& value) const {
  if (equals && !same(value, *equals)) return false;
  if (differs && same(value, *differs)) return false;
  if (!above && !below && !at_least && !at_most) return true;
  const auto* number = std::get_if<double>(&value);
  return number && (!above || *number > *above) && (!below || *number < *below) &&
         (!at_least || *number >= *at_least) && (!at_most || *number <= *at_most);
}

std::string Condition::text() const {
  std::vector<std::string> parts;
  if (equals) parts.push_back("= " + *equals);
  if (differs) parts.push_back("not " + *differs);
  if (above) parts.push_back(fmt::format("> {}", *above));
  if (below) parts.push_back(fmt::format("< {}", *below));
  if (at_least) parts.push_back(fmt::format(">= {}", *at_least));
  if (at_most) parts.push_back(fmt::format("<= {}", *at_most));
  return fmt::format("{} {}", field.path, fmt::join(parts, " and "));
}

}  // namespace expect

std::string Messages::text() const { return where ? topic + " with " + where->text() : topic; }

void Expectation::check_limits(const ConfigReader& from) const {
  if (!min && !max) from.problem("", "has no limit; give min, max or both");
  if (min && max && *min > *max) from.problem("max", "is below min");
}

std::string Expectation::limits_text() const {
  if (min && max) return fmt::format("in [{}, {}]", *min, *max);
  return min ? fmt::format("at least {}", *min) : fmt::format("at most {}", max.value_or(0.0));
}

std::string Expectation::after_text() const { return after_s > 0.0 ? fmt::format(" after {} s", after_s) : ""; }

std::string CountExpected::text() const { return fmt::format("count of {} {}", messages.text(), limits_text()); }

std::string RateExpected::text() const { return fmt::format("rate of {} {} Hz{}", messages.topic, hz, after_text()); }

std::string BoundsExpected::text() const {
  return fmt::format("{} of {} {}{}", field.path, messages.text(), limits_text(), after_text());
}

std::string EventuallyExpected::text() const {
  return fmt::format("eventually {} within {} s", messages.text(), within_s);
}

void NeverExpected::check(const ConfigReader& from) const {
  if (!messages.where) from.problem("where", "is missing: to expect no message at all use count with max: 0");
}

std::string NeverExpected::text() const { return fmt::format("never {}{}", messages.text(), after_text()); }

void OrderExpected::check(const ConfigReader& from) const {
  for (const char* key : {"first", "then"}) {
    if (!from.has(key)) from.problem(key, "is missing");
  }
}

std::string OrderExpected::text() const { return fmt::format("{} before {}", messages.text(), then.text()); }

std::string NoGapExpected::text() const { return "no gap in " + messages.topic; }

std::string SameAsExpected::text() const { return "same as " + record.substr(record.find_last_of('/') + 1); }

void ExpectEntry::check(const ConfigReader& from) const {
  int kinds = 0;
  std::string words;
  for (const ParameterInfo& kind : parameters_of<ExpectEntry>()) {
    if (kind.key == "name") continue;
    words += kind.key + ", ";
    kinds += from.has(kind.key);
  }
  if (kinds == 1) return;
  from.problem("",
               std::string(kinds == 0 ? "says nothing" : "says several things") + "; give one of " + words + "exit");
}

std::optional<Expectation> ExpectEntry::expectation() const {
  std::optional<Expectation> found;
  const auto take = [&](const auto& given) {
    if (!given) return;
    found = *given;
    found->kind = given->kKind;
    found->name = name.empty() ? given->text() : name;
  };
  take(count), take(rate), take(bounds), take(eventually), take(never), take(order), take(no_gap), take(same_as);
  return found;
}

ExpectConfig ExpectConfig::read(ConfigReader& from) {
  ExpectParameters given;
  read_parameters(from, given);
  if (given.entries.empty()) from.problem("expect", "holds no expectation");
  ExpectConfig config;
  std::map<std::string, int> names;
  for (const ExpectEntry& entry : given.entries) {
    auto expectation = entry.expectation();
    if (!expectation) continue;
    if (const int before = names[expectation->name]++; before > 0) {
      expectation->name += fmt::format(" ({})", before + 1);
    }
    config.expectations.push_back(std::move(*expectation));
  }
  return config;
}

}  // namespace ensonify
