#include "components/expect/config.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

#include "components/config/config_error.h"
#include "components/config/config_node.h"
#include "components/config/parameter_info.h"
#include "components/config/read_parameters.h"
#include "components/config/scalar_text.h"
#include "components/errors/nearest_name.h"

namespace ensonify {
namespace expect {
namespace {

bool same(const Scalar& value, const std::string& wanted) {
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr) return std::get<std::string>(value) == wanted;
  const auto wanted_number = parse_number(wanted);
  return wanted_number && *number == *wanted_number;
}

using msg::FieldInfo;
using msg::RawArray;
using msg::Value;

const std::vector<std::string> kReductions = {"min", "max", "mean", "any", "all", "nonzero", "size"};

bool is_reduction(const std::string& step) {
  return std::find(kReductions.begin(), kReductions.end(), step) != kReductions.end();
}

std::vector<std::string> steps_of(const std::string& path) {
  std::vector<std::string> steps(1);
  for (const char c : path) {
    if (c == '.') steps.emplace_back();
    else steps.back() += c;
  }
  return steps;
}

std::optional<std::size_t> index_of(const std::string& step) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
  return error == std::errc{} && end == step.data() + step.size() ? std::optional(index) : std::nullopt;
}

/// What the reductions need of the elements seen one by one.
struct Tally {
  std::size_t size = 0, nonzero = 0, numbers = 0;
  double low = INFINITY, high = -INFINITY, sum = 0.0;

  void add(double x) {
    ++size;
    if (x != 0.0) ++nonzero;
    if (std::isnan(x)) return;
    ++numbers;
    low = std::min(low, x);
    high = std::max(high, x);
    sum += x;
  }
};

std::optional<Scalar> reduced(const Tally& tally, const std::string& reduction) {
  if (reduction == "size") return static_cast<double>(tally.size);
  if (reduction == "nonzero") return static_cast<double>(tally.nonzero);
  if (tally.size == 0) return std::nullopt;
  if (reduction == "any") return tally.nonzero > 0 ? 1.0 : 0.0;
  if (reduction == "all") return tally.nonzero == tally.size ? 1.0 : 0.0;
  if (tally.numbers == 0) return std::nullopt;
  if (reduction == "min") return tally.low;
  if (reduction == "max") return tally.high;
  return tally.sum / static_cast<double>(tally.numbers);
}

std::optional<Scalar> in_array(const RawArray& array, const std::string& step) {
  const std::size_t count = array.bytes.size / msg::dtype_size(array.dtype);
  if (const auto index = index_of(step)) {
    return *index < count ? std::optional<Scalar>(array.number(*index)) : std::nullopt;
  }
  Tally tally;
  for (std::size_t i = 0; i < count; ++i) tally.add(array.number(i));
  return reduced(tally, step);
}

/// The reduction of one column of an array of rows, as the heights of beam x 3 positions.
std::optional<Scalar> in_column(const RawArray& array, std::size_t column, const std::string& reduction) {
  if (array.shape.size() < 2 || column >= array.shape.back()) return std::nullopt;
  const std::size_t count = array.bytes.size / msg::dtype_size(array.dtype);
  Tally tally;
  for (std::size_t i = column; i < count; i += array.shape.back()) tally.add(array.number(i));
  return reduced(tally, reduction);
}

std::optional<Scalar> reduced(const Value::List& list, const std::string& reduction) {
  Tally tally;
  for (const Value& value : list) {
    double number = 0.0;
    if (value.number(number)) tally.add(number);
    else if (reduction == "size") ++tally.size;
    else return std::nullopt;
  }
  return reduced(tally, reduction);
}

const Value* in_list(const Value::List& list, const std::string& step) {
  if (const auto index = index_of(step)) return *index < list.size() ? &list[*index] : nullptr;
  for (const Value& value : list) {
    const Value* name = value.find("name");
    if (name && name->as<std::string>() && *name->as<std::string>() == step) return &value;
  }
  return nullptr;
}

std::optional<Scalar> scalar_of(const Value& value) {
  double number = 0.0;
  if (value.number(number)) return number;
  if (const auto* text = value.as<std::string>()) return *text;
  if (const auto* boolean = value.as<bool>()) return *boolean ? "true" : "false";
  return std::nullopt;
}

std::string alternatives(const std::string& step, const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(step, known);
  if (!nearest.empty()) return "; did you mean " + nearest + "?";
  return fmt::format("; allowed: {}", fmt::join(known, ", "));
}

/// The field under `members` named by the step, or why there is none.
const FieldInfo* member(const std::vector<FieldInfo>& members, const std::string& step, std::string& fault) {
  std::vector<std::string> names;
  for (const FieldInfo& field : members) {
    if (field.name == step) return &field;
    names.push_back(field.name);
  }
  fault = "there is no field " + step + alternatives(step, names);
  return nullptr;
}

bool has_named_elements(const FieldInfo& list) {
  const auto& fields = list.members.front().members;
  return std::any_of(fields.begin(), fields.end(), [](const FieldInfo& field) { return field.name == "name"; });
}

bool is_single(const FieldInfo& field) {
  using Kind = FieldInfo::Kind;
  return field.kind == Kind::boolean || field.kind == Kind::integer || field.kind == Kind::number ||
         field.kind == Kind::text;
}

}  // namespace

std::optional<Scalar> value_at(const Value& message, const std::string& path) {
  const Value* here = &message;
  const std::vector<std::string> steps = steps_of(path);
  for (const std::string& step : steps) {
    if (const auto* array = here->as<RawArray>()) {
      if (&step == &steps.back()) return in_array(*array, step);
      const auto column = index_of(step);
      return column ? in_column(*array, *column, steps.back()) : std::nullopt;
    }
    if (const auto* list = here->as<Value::List>()) {
      if (is_reduction(step)) return reduced(*list, step);
      here = in_list(*list, step);
    } else {
      here = here->find(step);
    }
    if (!here) return std::nullopt;
  }
  return scalar_of(*here);
}

std::string path_fault(const msg::TypeInfo& type, const std::string& path) {
  using Kind = FieldInfo::Kind;
  FieldInfo whole;
  whole.members = type.fields;
  const FieldInfo* here = &whole;
  bool reduction = false, column = false;
  for (const std::string& step : steps_of(path)) {
    std::string fault;
    if (std::exchange(column, false) && is_reduction(step)) continue;
    if (reduction || is_single(*here)) return "nothing is inside a single value: " + step;
    if (here->kind == Kind::map) {
      here = member(here->members, step, fault);
      if (!here) return fault;
      continue;
    }
    const auto index = index_of(step);
    if (is_reduction(step)) {
      reduction = true;
    } else if (index && here->kind == Kind::fixed_list && *index >= here->length) {
      return fmt::format("there is no element {}; allowed: 0..{}", step, here->length - 1);
    } else if (here->kind == Kind::array) {
      if (!index) return "an array has no part " + step + alternatives(step, kReductions) + " or an index";
      reduction = column = true;  // a single value, or what follows is of its column
    } else if (index || (here->kind == Kind::list && has_named_elements(*here))) {
      here = &here->members.front();
    } else {
      return "a list has no part " + step + alternatives(step, kReductions) + " or an index";
    }
  }
  if (reduction || is_single(*here)) return "";
  return fmt::format("is not a single value; add an index or one of {}", fmt::join(kReductions, ", "));
}

std::string text_of(const Scalar& value) {
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  return std::get<std::string>(value);
}

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
