#include "launch/dataset/draws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "components/config/config_text.h"
#include "components/config/parse_yaml.h"
#include "components/config/scalar_text.h"
#include "components/errors/nearest_name.h"
#include "kernels/base/random/stream.h"

namespace ensonify::dataset {
namespace {

const std::vector<std::string> kForms = {"uniform", "log_uniform", "normal", "integer", "one_of", "by_split"};

/// Tries of a bounded normal distribution. With a tenth of it within the bounds, as is asked for, 0.9^500 fail.
constexpr std::uint64_t kNormalTries = 500;
constexpr double kLeastWithin = 0.1;

/// The word of the distribution that a node is; "": it is none.
std::string form_of(const ConfigNode& node) {
  if (!node.is_map()) return "";
  for (const std::string& form : kForms) {
    if (node.find(form) != nullptr) return form;
  }
  return "";
}

std::optional<std::array<double, 2>> two_numbers(const ConfigNode* node) {
  if (node == nullptr || !node->is_list() || node->items.size() != 2) return std::nullopt;
  std::array<double, 2> both{};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto number = node->items[i].is_scalar() ? parse_number(node->items[i].scalar) : std::nullopt;
    if (!number || !std::isfinite(*number)) return std::nullopt;
    both[i] = *number;
  }
  return both;
}

double below(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

/// Finds what is wrong with the distributions of a tree.
class Check {
 public:
  explicit Check(std::vector<ConfigProblem>& problems) : problems_(problems) {}

  void tree(const ConfigNode& node, const std::string& path) {
    if (const std::string form = form_of(node); !form.empty()) return distribution(node, form, path);
    if (node.is_map() && node.entries.size() == 1 && node.entries[0].value.is_list()) misspelt(node.entries[0], path);
    for (const auto& entry : node.entries) tree(entry.value, path + "." + entry.key);
    for (std::size_t i = 0; i < node.items.size(); ++i) tree(node.items[i], fmt::format("{}[{}]", path, i));
  }

 private:
  void problem(const ConfigNode& node, const std::string& path, const std::string& message) {
    problems_.push_back({node.place, path, message});
  }

  /// A map with one list may be a value of its own; {unifrom: [1, 2]} is not meant so.
  void misspelt(const ConfigNode::Entry& entry, const std::string& path) {
    if (const std::string near = nearest_name(entry.key, kForms); !near.empty())
      problems_.push_back({entry.place, path, entry.key + " is not a distribution; did you mean " + near + "?"});
  }

  void distribution(const ConfigNode& node, const std::string& form, const std::string& path) {
    const std::string beside = form == "normal" ? "within" : form == "one_of" ? "weights" : "";
    for (const auto& entry : node.entries) {
      if (entry.key != form && entry.key != beside)
        problems_.push_back({entry.place, path + "." + entry.key,
                             "is not known beside " + form + (beside.empty() ? "" : "; allowed: " + beside)});
    }
    if (form == "one_of") return choice(node, path);
    if (form == "by_split") return by_split(*node.find(form), path + ".by_split");
    const auto bounds = two_numbers(node.find(form));
    const std::string at = path + "." + form;
    if (!bounds) return problem(*node.find(form), at, "is not a list of two numbers");
    if (form == "normal") return normal(node, *bounds, path);
    if ((*bounds)[0] > (*bounds)[1])
      problem(*node.find(form), at, fmt::format("{} is over {}; allowed: [least, most]", (*bounds)[0], (*bounds)[1]));
    if (form == "log_uniform" && !((*bounds)[0] > 0.0))
      problem(*node.find(form), at, fmt::format("{} is not over 0", (*bounds)[0]));
    if (form == "integer") {
      for (const double bound : *bounds) {
        if (bound != std::floor(bound) || std::abs(bound) > 1e9)
          problem(*node.find(form), at, fmt::format("{} is not a whole number within 1e9", bound));
      }
    }
  }

  void normal(const ConfigNode& node, const std::array<double, 2>& of, const std::string& path) {
    const auto within = two_numbers(node.find("within"));
    if (!(of[1] > 0.0)) return problem(node, path + ".normal", fmt::format("{}: the deviation is not over 0", of[1]));
    if (!within) return problem(node, path + ".within", "must be given: the list of two numbers, [least, most]");
    const double share = below(((*within)[1] - of[0]) / of[1]) - below(((*within)[0] - of[0]) / of[1]);
    if (share < kLeastWithin)
      problem(node, path + ".within",
              fmt::format("holds {:.2g} of the distribution; allowed: {} or more", std::max(0.0, share), kLeastWithin));
  }

  void by_split(const ConfigNode& of, const std::string& path) {
    const bool whole = of.is_map() && of.entries.size() == 3 && of.find("train") && of.find("val") && of.find("test");
    if (!whole) return problem(of, path, "is not a map of train, val and test");
    for (const auto& entry : of.entries) tree(entry.value, path + "." + entry.key);
  }

  void choice(const ConfigNode& node, const std::string& path) {
    const ConfigNode &of = *node.find("one_of"), *weights = node.find("weights");
    if (!of.is_list() || of.items.empty()) return problem(of, path + ".one_of", "is not a list of values");
    for (std::size_t i = 0; i < of.items.size(); ++i) tree(of.items[i], fmt::format("{}.one_of[{}]", path, i));
    if (weights == nullptr) return;
    bool good = weights->is_list() && weights->items.size() == of.items.size();
    double sum = 0.0;
    for (const ConfigNode& item : weights->items) {
      const auto weight = item.is_scalar() ? parse_number(item.scalar) : std::nullopt;
      good = good && weight && std::isfinite(*weight) && *weight >= 0.0;
      if (good) sum += *weight;
    }
    if (!good || !(sum > 0.0))
      problem(*weights, path + ".weights",
              fmt::format("is not a list of {} numbers of 0 or more, one of them over 0", of.items.size()));
  }

  std::vector<ConfigProblem>& problems_;
};

/// Draws the values of a tree that Check has found good.
class Draw {
 public:
  Draw(const Counter& at, Values* values) : at_(at), values_(values) {}

  ConfigNode tree(const ConfigNode& node, const std::string& path) const {
    if (const std::string form = form_of(node); !form.empty()) {
      ConfigNode value = drawn(node, form, path);
      if (values_ != nullptr) values_->emplace_back(path, value);
      return value;
    }
    ConfigNode filled = node;
    for (auto& entry : filled.entries) entry.value = tree(entry.value, path + "." + entry.key);
    for (std::size_t i = 0; i < filled.items.size(); ++i)
      filled.items[i] = tree(node.items[i], fmt::format("{}[{}]", path, i));
    return filled;
  }

 private:
  double uniform(const random::Stream& stream, std::uint64_t number) const {
    return stream.uniform(at_.scene, at_.item, at_.attempt << 32U | number);
  }

  ConfigNode drawn(const ConfigNode& node, const std::string& form, const std::string& path) const {
    const random::Stream stream(at_.seed, "dataset/" + path);
    if (form == "one_of") {
      const std::size_t chosen = choice(node, uniform(stream, 0));
      return Draw(at_, nullptr).tree(node.find("one_of")->items[chosen], fmt::format("{}.one_of[{}]", path, chosen));
    }
    if (form == "by_split")
      return Draw(at_, nullptr).tree(*node.find(form)->find(at_.split), path + ".by_split." + at_.split);
    const auto [a, b] = *two_numbers(node.find(form));
    double value = 0.0;
    if (form == "uniform") {
      value = a + (b - a) * uniform(stream, 0);
    } else if (form == "log_uniform") {
      value = std::clamp(a * std::exp(std::log(b / a) * uniform(stream, 0)), a, b);
    } else if (form == "integer") {
      value = std::min(b, a + std::floor((b - a + 1.0) * uniform(stream, 0)));
    } else {
      const auto within = *two_numbers(node.find("within"));
      value = std::clamp(a, within[0], within[1]);  // when all tries are outside
      for (std::uint64_t i = 0; i < kNormalTries; ++i) {
        const double x = a + b * stream.normal(at_.scene, at_.item, at_.attempt << 32U | i);
        if (x < within[0] || x > within[1]) continue;
        value = x;
        break;
      }
    }
    return ConfigNode::text(shortest_number(value), node.place);
  }

  static std::size_t choice(const ConfigNode& node, double uniform) {
    const std::size_t count = node.find("one_of")->items.size();
    const ConfigNode* weights = node.find("weights");
    std::vector<double> sums(count);
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i)
      sums[i] = sum += weights == nullptr ? 1.0 : *parse_number(weights->items[i].scalar);
    for (std::size_t i = 0; i < count; ++i) {
      if (uniform * sum < sums[i]) return i;
    }
    return count - 1;
  }

  const Counter& at_;
  Values* values_;
};

}  // namespace

Drawn::Drawn(const std::string& text) : tree(parse_config_value(text, {})) {}

bool Drawn::operator==(const Drawn& other) const { return to_json(tree) == to_json(other.tree); }

void Drawn::read(ConfigReader& from, const char* key) {
  const ConfigNode* node = from.node(key);
  if (node == nullptr || node->is_null()) return;
  std::vector<ConfigProblem> problems;
  Check(problems).tree(*node, from.problem_at(key, "").key);
  if (!problems.empty()) from.add(ConfigError(std::move(problems)));
  else tree = *node;
}

ConfigNode draw(const ConfigNode& tree, const std::string& path, const Counter& at, Values* values) {
  return Draw(at, values).tree(tree, path);
}

double draw_number(const Drawn& from, const std::string& path, const Counter& at, double lo, double hi) {
  const ConfigNode node = draw(from.tree, path, at);
  const auto number = node.is_scalar() ? parse_number(node.scalar) : std::nullopt;
  if (!number) throw ConfigError({{from.tree.place, path, "is not a number, nor a distribution of numbers"}});
  if (!(*number >= lo && *number <= hi))
    throw ConfigError({{from.tree.place, path,
                        fmt::format("{} is outside [{}, {}]", *number, shortest_number(lo), shortest_number(hi))}});
  return *number;
}

std::array<double, 2> even(std::uint64_t seed, std::uint64_t number) {
  constexpr double kFinest = 1e-12;
  const random::Stream orders(seed, "dataset/even");
  std::array<double, 2> place{};
  for (std::uint64_t i = 0; i < 2; ++i) {
    const std::uint64_t base = 2 + i;
    std::uint64_t block = number, depth = 0;  // its block at each size, smallest first
    for (double step = 1.0 / static_cast<double>(base); step > kFinest; step /= static_cast<double>(base), ++depth) {
      const std::uint64_t digit = block % base;
      block /= base;
      place[i] += step * static_cast<double>((digit + orders.bits(base, depth, block)[0]) % base);
    }
  }
  return place;
}

}  // namespace ensonify::dataset
