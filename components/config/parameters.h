#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

/// A struct of parameters has one list of them, as a message has of its fields:
///
///   struct SidescanParameters {
///     double swath_rad = 2.0;
///     template <class Self, class Visit>
///     static void parameters(Self& self, Visit&& visit) {
///       visit("swath_deg", "deg", in(10, 160), "width of the swath", self.swath_rad);
///       visit("trigger", "start of a ping: what transmissions follow", self.trigger);  // a section: its struct has a
///       list of its own
///     }
///     void check(const ConfigReader& from) const;  // optional: what no single range says; adds problems
///     void complete(ConfigReader& from);           // optional, after it: what is kept besides the list
///   };
///
/// The unit and the range are those of the file; the member holds SI (file_unit). The initialiser is the only home of a
/// default. Reading (read_parameters.h), writing, the default file, the table and the schema (parameter_info.h) follow
/// from the list.
namespace ensonify {

class ConfigReader;

/// A word of the file and the value that it stands for: of an enum, a bool or a whole number. A text parameter keeps
/// the word itself.
struct Word {
  Word(const char* word) : text(word) {}  // NOLINT(google-explicit-constructor): one_of({"a", "b"})
  template <class T>
  requires(std::is_enum_v<T> || std::is_integral_v<T>) Word(const char* word, T of)
      : text(word), value(static_cast<std::int64_t>(of)) {}

  std::string text;
  std::int64_t value = 0;
};

/// Values that a parameter may take, in the unit of the file.
struct Allowed {
  static constexpr double kHighest = std::numeric_limits<double>::max();
  enum class Text { kAny, kNotEmpty, kPath };

  double lo = -kHighest;
  double hi = kHighest;
  std::vector<Word> words = {};
  Text text = Text::kAny;
  std::string instead = {};  // a word for no value at all
  std::string called = {};   // what each of some whole numbers is, "a class"
  bool required = false;     // it has no default
  bool computed = false;     // left out it is computed, as its sentence says
  bool again = false;        // another key of the list has the same member

  bool bounded() const { return lo > -kHighest || hi < kHighest; }
};

// What stands in a list. Bounds are inclusive.
inline Allowed any() { return {}; }
inline Allowed in(double lo, double hi) { return {.lo = lo, .hi = hi}; }
inline Allowed one_of(std::initializer_list<Word> words) { return {.words = words}; }
/// A text of at least one character.
inline Allowed not_empty() { return {.text = Allowed::Text::kNotEmpty}; }
/// An existing file or folder, found as ConfigReader::required_path says.
inline Allowed path() { return {.text = Allowed::Text::kPath}; }
/// The same, of a parameter without a default.
inline Allowed must(Allowed allowed) {
  allowed.required = true;
  return allowed;
}
/// The same, of a parameter that is computed when it is left out.
inline Allowed computed(Allowed allowed) {
  allowed.computed = true;
  return allowed;
}

/// The same, of an optional member: `word` stands for no value.
inline Allowed or_word(const char* word, Allowed allowed = any()) {
  allowed.instead = word;
  return allowed;
}
/// The same, of whole numbers (in a list, or keys of a map) that have a name: called("a class", in(0, 255)).
inline Allowed called(const char* name, Allowed allowed) {
  allowed.called = name;
  return allowed;
}
/// The same, of a member that another key has already, such as a speed in knots. It is read, and never written.
inline Allowed again(Allowed allowed) {
  allowed.computed = allowed.again = true;
  return allowed;
}

/// The forms that a variant has in a file, as they are before one is read. One type may stand for several.
template <class T>
struct FormsOf;
template <class... Form>
struct FormsOf<std::variant<Form...>> {
  static std::vector<std::variant<Form...>> all() { return {Form{}...}; }
};

/// Stands in a list before a variant of structs with lists of their own: the keys of one of them stand among those of
/// the list. Which one, the first key of its list says.
///   visit(one_form("needs one of {}"), self.way);   // std::variant<FromFile, Bars, Wall>
struct Forms {
  std::string none;      // what is wrong where none of these keys, {}, is there; "": it is the last form then
  std::string beside;    // what to do where several are; "": a check() says so
  const char* key = "";  // of the word that says which, if one does
  const char* about = "";
  bool required = false;  // that word has no default
};
inline Forms one_form(std::string none = "", std::string beside = "give one or the other") {
  return {std::move(none), std::move(beside)};
}
/// The same where the word under `key` says which form is there: each form's kWord. `other` is what is wrong with a key
/// that only another form has.
///   visit(form_by("kind", "generated or imported", "is not used by this kind"), self.ground);
inline Forms form_by(const char* key, const char* about, std::string other, bool required = false) {
  return {"", std::move(other), key, about, required};
}
/// Those words.
template <class V>
Allowed words_of() {
  Allowed words;
  for (const V& form : FormsOf<V>::all()) {
    std::visit(
        [&](const auto& of) {
          using Form = std::decay_t<decltype(of)>;
          if constexpr (requires { Form::kWord; }) words.words.emplace_back(Form::kWord, words.words.size());
        },
        form);
  }
  return words;
}

/// Factor from a unit of files to SI: 1 for what is SI already. An unknown unit is a mistake of ours.
double file_unit(const char* unit);

/// The list of T: its own, or a specialisation's for structs that know nothing of files, such as those of kernels.
template <class T>
struct ParametersOf {
  template <class Self, class Visit>
  requires requires(Self& self, Visit& visit) { T::parameters(self, visit); }
  static void parameters(Self& self, Visit&& visit) { T::parameters(self, visit); }

  static void check(const ConfigReader& from, const T& values) {
    if constexpr (requires { values.check(from); }) values.check(from);
  }
};

struct IgnoreParameter {
  void operator()(auto&&...) const {}
};

template <class T>
concept HasParameters = requires(T& values, IgnoreParameter visit) {
  ParametersOf<T>::parameters(values, visit);
};

/// One of several structs with lists.
template <class T>
struct IsForms : std::false_type {};
template <class... Form>
struct IsForms<std::variant<Form...>> : std::bool_constant<(HasParameters<Form> && ...)> {};

/// A variant is the list of whichever form is there, in a list of maps or under a key of its own.
template <class... Form>
requires(HasParameters<Form>&&...) struct ParametersOf<std::variant<Form...>> {
  static void parameters(auto& self, auto&& visit) { visit(one_form(), self); }
};

/// A struct with `static constexpr const char* kShort = "path";`: where a file has a single value instead of the map,
/// it is short for the map with this key alone.
template <class T>
constexpr const char* short_key() {
  if constexpr (requires { T::kShort; }) return T::kShort;
  else return "";
}

/// Entries of a map from names that the user chooses: a struct that says which member holds its name,
/// `static constexpr auto kNamedBy = &OtherHead::process;`. A vector of them is such a map, in the order of the file.
template <class T>
concept NamedParameters = HasParameters<T> && requires {
  T::kNamedBy;
};

// clang-format off
template <class T> struct IsOptional : std::false_type {};
template <class T> struct IsOptional<std::optional<T>> : std::true_type {};
template <class T> struct IsVector : std::false_type {};
template <class T> struct IsVector<std::vector<T>> : std::true_type {};
template <class T> struct IsNumbers : std::false_type {};
template <class T> struct IsMap : std::false_type {};
template <class K, class T> struct IsMap<std::map<K, T>> : std::bool_constant<HasParameters<T>> {};
template <class T> struct IsWholes : std::false_type {};
template <class T> struct IsWholes<std::vector<T>> : std::bool_constant<std::is_integral_v<T> && !std::is_same_v<T, bool>> {};
template <std::size_t N> struct IsNumbers<std::array<double, N>> : std::true_type {};
// clang-format on
/// A vector of fixed length such as Eigen's, in a file a list of numbers.
template <class T>
concept FixedVector = requires(T& vector) {
  requires static_cast<int>(T::SizeAtCompileTime) > 0;
  { vector.data() } -> std::same_as<double*>;
};
/// A vector of such vectors, in a file a list of lists.
template <class T>
concept FixedVectors = IsVector<T>::value && FixedVector<typename T::value_type>;
/// A member whose form in the file no other kind has: it reads itself and says what it takes.
///   void read(const ConfigReader& from, const char* key);
///   ConfigNode in_file() const;            the default
///   static std::string schema();           JSON Schema of the value
template <class T>
concept ReadsItself = requires(T& member) {
  { T::schema() } -> std::convertible_to<std::string>;
};

/// A map from texts, or from whole numbers where its key is one, to structs.
template <class T>
concept MapOfParameters = IsMap<T>::value;

template <class T>
concept ListOfParameters = IsVector<T>::value && HasParameters<typename T::value_type>;

/// What has keys of its own.
template <class T>
concept Structure = HasParameters<T> || ListOfParameters<T> || MapOfParameters<T>;

template <class T>
bool equal_parameters(const T& a, const T& b);

namespace detail {

template <class T>
bool equal_members(const T& a, const T& b) {
  if constexpr (IsForms<T>::value) {
    return a.index() == b.index() &&
           std::visit(
               [&](const auto& form) { return equal_parameters(form, std::get<std::decay_t<decltype(form)>>(b)); }, a);
  } else if constexpr (HasParameters<T>) {
    return equal_parameters(a, b);
  } else if constexpr (IsOptional<T>::value) {
    return a.has_value() == b.has_value() && (!a || equal_members(*a, *b));
  } else if constexpr (ListOfParameters<T>) {
    bool equal = a.size() == b.size();
    for (std::size_t i = 0; equal && i < a.size(); ++i) equal = equal_members(a[i], b[i]);
    return equal;
  } else if constexpr (MapOfParameters<T>) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
      return x.first == y.first && equal_members(x.second, y.second);
    });
  } else {
    return a == b;
  }
}

struct CollectMembers {
  std::vector<const void*>& members;
  void operator()(const char*, const char*, const Allowed&, const char*, const auto& m) const { members.push_back(&m); }
  void operator()(const char*, const char*, const auto& m) const { members.push_back(&m); }
  void operator()(const Forms&, const auto& m) const { members.push_back(&m); }
};

struct CompareMembers {
  const std::vector<const void*>& others;
  std::size_t next = 0;
  bool equal = true;
  template <class T>
  void operator()(const char*, const char*, const Allowed&, const char*, const T& member) {
    (*this)("", "", member);
  }
  template <class T>
  void operator()(const Forms&, const T& member) {
    (*this)("", "", member);
  }
  template <class T>
  void operator()(const char*, const char*, const T& member) {
    equal = equal_members(member, *static_cast<const T*>(others[next++])) && equal;
  }
};

}  // namespace detail

/// Equality of all that is listed, whatever else the structs hold.
template <class T>
bool equal_parameters(const T& a, const T& b) {
  std::vector<const void*> others;
  ParametersOf<T>::parameters(b, detail::CollectMembers{others});
  detail::CompareMembers compare{others};
  ParametersOf<T>::parameters(a, compare);
  if constexpr (NamedParameters<T>) compare.equal = compare.equal && a.*T::kNamedBy == b.*T::kNamedBy;
  return compare.equal;
}

}  // namespace ensonify
