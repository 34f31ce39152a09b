#include "tools/physics/verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "components/errors/exit_error.h"
#include "tools/physics/sweep.h"

namespace ensonify::physics {
namespace {

std::string option_of(const std::string& column) {
  std::string option = "--" + column;
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

/// Ten digits: more than any model is worth, and 0.1 stays 0.1 where a sweep has added it up.
std::string text_of(double value) { return fmt::format("{:.10g}", value); }

/// The number that the text says; null where it is not finite.
nlohmann::json json_of(double value) {
  return std::isfinite(value) ? nlohmann::json::parse(text_of(value)) : nlohmann::json();
}

}  // namespace

Verb::Verb(CLI::App& parent, const std::string& name, const std::string& about)
    : app_(parent.add_subcommand(name, about)) {
  app_->add_flag("--json", json_, "a list of JSON objects instead of CSV; what is not finite is null");
}

void Verb::number(const std::string& column, double& value, double low, double high, const std::string& about) {
  Number& added = numbers_.emplace_back(Number{column, &value, low, high, fmt::format("{:g}", value), {}});
  app_->add_option(option_of(column), added.given, fmt::format("{}; {:g} to {:g}", about, low, high))
      ->type_name("NUMBER|FROM:TO:STEP")
      ->capture_default_str();
}

void Verb::add_choice(const std::string& column, std::vector<Name> names, const std::string& chosen,
                      const std::string& about) {
  std::vector<std::string> allowed;
  for (const Name& name : names) allowed.push_back(name.name);
  Choice& added = choices_.emplace_back(Choice{column, std::move(names), chosen});
  app_->add_option(option_of(column), added.given, about)
      ->type_name(fmt::format("{}", fmt::join(allowed, "|")))
      ->capture_default_str();
}

void Verb::choose(const std::string& column, const std::string& name) {
  for (Choice& choice : choices_) {
    if (choice.column == column) choice.given = name;
  }
}

void Verb::results(std::vector<std::string> columns, std::function<Row()> compute) {
  result_columns_ = std::move(columns);
  compute_ = std::move(compute);
}

bool Verb::asked_for() const { return app_->parsed(); }

void Verb::read_input() {
  for (Choice& choice : choices_) {
    const auto chosen = std::find_if(choice.names.begin(), choice.names.end(),
                                     [&](const Name& name) { return name.name == choice.given; });
    if (chosen == choice.names.end()) {
      std::vector<std::string> allowed;
      for (const Name& name : choice.names) allowed.push_back(name.name);
      throw UserError(
          fmt::format("{}: '{}' is none of {}", option_of(choice.column), choice.given, fmt::join(allowed, ", ")));
    }
    chosen->choose();
  }
  double rows = 1.0;
  for (Number& number : numbers_) {
    try {
      number.sweep = sweep(number.given, number.low, number.high);
    } catch (const std::invalid_argument& error) {
      throw UserError(option_of(number.column) + ": " + error.what());
    }
    rows *= static_cast<double>(number.sweep.size());
  }
  if (rows > kMostRows) {
    throw UserError(fmt::format("the sweeps make {:g} rows; at most {:.0f} are allowed", rows, kMostRows));
  }
}

std::vector<std::string> Verb::columns() const {
  std::vector<std::string> columns;
  for (const Choice& choice : choices_) columns.push_back(choice.column);
  for (const Number& number : numbers_) columns.push_back(number.column);
  columns.insert(columns.end(), result_columns_.begin(), result_columns_.end());
  return columns;
}

std::string Verb::row_text(const std::vector<std::string>& columns, bool first) {
  std::vector<double> values;
  for (const Number& number : numbers_) values.push_back(*number.value);
  for (const double result : compute_()) values.push_back(result);
  if (json_) {
    nlohmann::ordered_json row;
    for (const Choice& choice : choices_) row[choice.column] = choice.given;
    for (std::size_t i = 0; i < values.size(); ++i) row[columns[choices_.size() + i]] = json_of(values[i]);
    return (first ? "[\n  " : ",\n  ") + row.dump();
  }
  std::vector<std::string> cells;
  for (const Choice& choice : choices_) cells.push_back(choice.given);
  for (const double value : values) cells.push_back(text_of(value));
  return fmt::format("{}\n", fmt::join(cells, ","));
}

void Verb::print() try {
  read_input();
  const std::vector<std::string> columns = this->columns();
  std::string text;  // nothing is printed unless the kernel takes every row
  if (!json_) text = fmt::format("{}\n", fmt::join(columns, ","));

  std::vector<std::size_t> at(numbers_.size(), 0);  // an odometer over the sweeps
  for (bool first = true, more = true; more; first = false) {
    for (std::size_t i = 0; i < at.size(); ++i) *numbers_[i].value = numbers_[i].sweep[at[i]];
    text += row_text(columns, first);
    std::size_t turned = at.size();
    while (turned > 0 && ++at[turned - 1] == numbers_[turned - 1].sweep.size()) at[--turned] = 0;
    more = turned > 0;
  }
  if (json_) text += "\n]\n";
  std::fwrite(text.data(), 1, text.size(), stdout);
} catch (const std::invalid_argument& error) {
  throw UserError(error.what());
}

}  // namespace ensonify::physics
