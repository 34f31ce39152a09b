#include "tools/topic/pretty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace ensonify::topic_tool {
namespace {

using msg::FieldInfo;
using msg::RawArray;
using msg::Value;

constexpr std::size_t kShown = 3;  // elements at each end of an array

std::string with_unit(std::string text, const std::string& unit) {
  return unit.empty() || unit == "1" ? text : text + " " + unit;
}

/// "f4 [2, 400]: 0.1 0.2 0.3 ... 7.9 8 8.1 uPa (0.1 to 8.1)"; the range is that of what is not NaN.
std::string array_text(const RawArray& array, const std::string& unit) {
  const std::size_t count = array.bytes.size / msg::dtype_size(array.dtype);
  std::string text = fmt::format("{} [{}]", msg::dtype_name(array.dtype), fmt::join(array.shape, ", "));
  if (count == 0) return text;
  text += ":";
  double low = INFINITY;
  double high = -INFINITY;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = array.number(i);
    low = std::fmin(low, value);
    high = std::fmax(high, value);
    if (i < kShown || i + kShown >= count) text += fmt::format(" {:.6g}", value);
    else if (i == kShown) text += " ...";
  }
  text = with_unit(text, unit);
  return count > 2 * kShown && low <= high ? text + fmt::format(" ({:.6g} to {:.6g})", low, high) : text;
}

bool is_struct(const Value& value) { return value.as<Value::Map>() != nullptr; }

const FieldInfo* member(const std::vector<FieldInfo>& fields, std::string_view name) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const FieldInfo& f) { return f.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

void append_map(std::string& out, const Value::Map& map, const std::vector<FieldInfo>* fields, std::size_t indent);

void append_field(std::string& out, const std::string& name, const Value& value, const FieldInfo* info,
                  std::size_t indent) {
  out += std::string(indent, ' ') + name + ":";
  if (const auto* map = value.as<Value::Map>()) {
    out += "\n";
    append_map(out, *map, info != nullptr ? &info->members : nullptr, indent + 2);
    return;
  }
  const auto* list = value.as<Value::List>();
  if (list == nullptr || list->empty() || !is_struct(list->front())) {
    out += " " + value_text(value, info != nullptr ? info->unit : "") + "\n";
    return;
  }
  out += "\n";
  const FieldInfo* element = info != nullptr && !info->members.empty() ? &info->members.front() : nullptr;
  for (std::size_t i = 0; i < list->size(); ++i)
    append_field(out, fmt::format("[{}]", i), (*list)[i], element, indent + 2);
}

void append_map(std::string& out, const Value::Map& map, const std::vector<FieldInfo>* fields, std::size_t indent) {
  for (const auto& [name, value] : map) {
    append_field(out, name, value, fields != nullptr ? member(*fields, name) : nullptr, indent);
  }
}

}  // namespace

std::string value_text(const Value& value, const std::string& unit) {
  if (const auto* array = value.as<RawArray>()) return array_text(*array, unit);
  if (const auto* text = value.as<std::string>()) return *text;
  if (const auto* number = value.as<double>()) return with_unit(fmt::format("{:.9g}", *number), unit);
  if (const auto* list = value.as<Value::List>();
      list != nullptr && !std::any_of(list->begin(), list->end(), is_struct)) {
    std::string text;
    for (const Value& item : *list) text += (text.empty() ? "" : ", ") + value_text(item, "");
    return with_unit("[" + text + "]", unit);
  }
  return with_unit(msg::to_json(value), unit);
}

std::string message_text(const Value& message, const msg::TypeInfo* type) {
  std::string out;
  if (const auto* map = message.as<Value::Map>()) append_map(out, *map, type != nullptr ? &type->fields : nullptr, 2);
  return out;
}

const FieldInfo* find_field(const msg::TypeInfo* type, std::string_view path) {
  if (type == nullptr) return nullptr;
  const std::vector<FieldInfo>* fields = &type->fields;
  const FieldInfo* here = nullptr;
  while (!path.empty()) {
    const std::size_t dot = path.find('.');
    const std::string_view step = path.substr(0, dot);
    path = dot == std::string_view::npos ? std::string_view{} : path.substr(dot + 1);
    const bool in_list =
        here != nullptr && (here->kind == FieldInfo::Kind::list || here->kind == FieldInfo::Kind::fixed_list);
    if (in_list) {  // an index: the unit stays with the list
      if (here->members.front().kind == FieldInfo::Kind::map) here = &here->members.front();
    } else {
      here = member(*fields, step);
      if (here == nullptr) return nullptr;
    }
    fields = &here->members;
  }
  return here;
}

std::string bytes_text(double bytes) {
  for (const auto& [unit, size] : {std::pair{"GB", 1e9}, {"MB", 1e6}, {"kB", 1e3}}) {
    if (bytes >= size) return fmt::format("{:.3g} {}", bytes / size, unit);
  }
  return fmt::format("{:.0f} B", bytes);
}

std::string rate_text(Rate rate) {
  return rate.num > 0 ? fmt::format("{:g} Hz", rate.hz()) : "at most 10 Hz on average";
}

}  // namespace ensonify::topic_tool
