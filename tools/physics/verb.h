#pragma once

#include <cmath>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ensonify::physics {

/// One verb of `ensonify physics`: inputs, each a number or a sweep, and what a kernel makes of them.
///
/// The file of a verb binds each input to a variable, whose value at that time is the default. print() goes through all
/// combinations of the sweeps, the input declared last varying fastest, sets the variables and prints a row: the
/// inputs, then the results. A column's name carries its unit; the option is the same name with hyphens (--depth-m of
/// depth_m).
class Verb {
 public:
  using Row = std::vector<double>;

  Verb(CLI::App& parent, const std::string& name, const std::string& about);

  /// A number in [low, high]. The variable must live as long as the verb; so must those of choice().
  void number(const std::string& column, double& value, double low, double high, const std::string& about);

  /// One of some names.
  template <class Enum>
  void choice(const std::string& column, Enum& value, const std::vector<std::pair<std::string, Enum>>& allowed,
              const std::string& about) {
    std::vector<Name> names;
    std::string chosen;
    for (const auto& [name, meant] : allowed) {
      names.push_back({name, [&value, meant = meant] { value = meant; }});
      if (meant == value) chosen = name;
    }
    add_choice(column, std::move(names), chosen, about);
  }

  /// Chooses this name of a choice whatever was given for it: for an option that stands instead of it.
  void choose(const std::string& column, const std::string& name);

  /// Value computed from the variables as they are set. std::invalid_argument is the user's mistake.
  void results(std::vector<std::string> columns, std::function<Row()> compute);

  /// A flag or option of another kind goes here.
  CLI::App& options() { return *app_; }

  bool asked_for() const;

  /// Prints all rows: as CSV with a header, or with --json as a list of objects. ExitError for wrong input, and then
  /// nothing is printed.
  void print();

 private:
  struct Name {
    std::string name;
    std::function<void()> choose;
  };
  struct Choice {
    std::string column;
    std::vector<Name> names;
    std::string given;
  };
  struct Number {
    std::string column;
    double* value;
    double low, high;
    std::string given;
    std::vector<double> sweep;
  };

  void add_choice(const std::string& column, std::vector<Name> names, const std::string& chosen,
                  const std::string& about);
  void read_input();
  std::vector<std::string> columns() const;
  std::string row_text(const std::vector<std::string>& columns, bool first);

  CLI::App* app_;
  bool json_ = false;
  std::deque<Choice> choices_;  // deques: the command line is bound to their elements
  std::deque<Number> numbers_;
  std::vector<std::string> result_columns_;
  std::function<Row()> compute_;
};

/// The verbs of the program.
using Verbs = std::deque<Verb>;

/// 10 log10 of a ratio of intensities; -inf of 0.
inline double db(double ratio) { return 10.0 * std::log10(ratio); }

void add_absorption(CLI::App& app, Verbs& verbs);
void add_backscatter(CLI::App& app, Verbs& verbs);
void add_disturbance(CLI::App& app, Verbs& verbs);
void add_level(CLI::App& app, Verbs& verbs);
void add_material(CLI::App& app, Verbs& verbs);
void add_multipath(CLI::App& app, Verbs& verbs);
void add_noise(CLI::App& app, Verbs& verbs);
void add_pattern(CLI::App& app, Verbs& verbs);
void add_receiver(CLI::App& app, Verbs& verbs);  // pulse, gain, flattening
void add_ray(CLI::App& app, Verbs& verbs);
void add_relief(CLI::App& app, Verbs& verbs);
void add_sound_speed(CLI::App& app, Verbs& verbs);
void add_stabilisation(CLI::App& app, Verbs& verbs);
void add_statistics(CLI::App& app, Verbs& verbs);
void add_surface(CLI::App& app, Verbs& verbs);
void add_tide(CLI::App& app, Verbs& verbs);

}  // namespace ensonify::physics
