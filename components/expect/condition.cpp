#include "components/expect/condition.h"

#include <fmt/format.h>

#include <vector>

#include "components/config/config_reader.h"
#include "components/config/scalars.h"

namespace ensonify::expect {
namespace {

std::optional<std::string> text_at(ConfigReader& from, const char* key) {
  const ConfigNode* node = from.node(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_scalar()) {
    from.problem(key, "is not a number, a text, true or false");
    return std::nullopt;
  }
  return node->scalar;
}

bool same(const Scalar& value, const std::string& wanted) {
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr) return std::get<std::string>(value) == wanted;
  const auto wanted_number = parse_number(wanted);
  return wanted_number && *number == *wanted_number;
}

}  // namespace

Condition Condition::read(ConfigReader& from) {
  Condition condition;
  from.required("field", condition.field);
  if (const ConfigNode* node = from.node("field")) condition.place = node->place;
  condition.equals = text_at(from, "equals");
  condition.differs = text_at(from, "not");
  from.optional("above", condition.above);
  from.optional("below", condition.below);
  from.optional("at_least", condition.at_least);
  from.optional("at_most", condition.at_most);
  if (!condition.equals && !condition.differs && !condition.above && !condition.below && !condition.at_least &&
      !condition.at_most) {
    from.problem("", "compares nothing; give one of equals, not, above, below, at_least, at_most");
  }
  return condition;
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
  return fmt::format("{} {}", field, fmt::join(parts, " and "));
}

}  // namespace ensonify::expect
