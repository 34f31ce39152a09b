#include "messages/schema.h"

#include <algorithm>

#include "messages/all.h"

namespace ensonify::msg {

namespace {

using Kind = FieldInfo::Kind;

Value text(std::string_view words) { return {std::string(words)}; }

Value schema_of(const FieldInfo& field);

Value properties_of(const std::vector<FieldInfo>& fields) {
  Value::Map properties;
  for (const FieldInfo& field : fields) properties.emplace_back(field.name, schema_of(field));
  return {std::move(properties)};
}

/// A descriptor with the elements inside. JSON has no bytes; viewers take this for raw bytes.
void append_array_schema(Value::Map& schema, Dtype dtype) {
  const Value integer{Value::Map{{"type", text("integer")}}};
  schema.emplace_back("type", text("object"));
  schema.emplace_back(
      "properties",
      Value{Value::Map{{"dtype", Value{Value::Map{{"const", text(dtype_name(dtype))}}}},
                       {"shape", Value{Value::Map{{"type", text("array")}, {"items", integer}}}},
                       {"data", Value{Value::Map{{"type", text("string")}, {"contentEncoding", text("base64")}}}}}});
}

void append_list_schema(Value::Map& schema, const FieldInfo& field) {
  schema.emplace_back("type", text("array"));
  schema.emplace_back("items", schema_of(field.members.front()));
  if (field.kind != Kind::fixed_list) return;
  const Value length{static_cast<std::int64_t>(field.length)};
  schema.emplace_back("minItems", length);
  schema.emplace_back("maxItems", length);
}

Value schema_of(const FieldInfo& field) {
  Value::Map schema;
  if (!field.about.empty()) schema.emplace_back("description", text(field.about));
  if (!field.unit.empty()) schema.emplace_back("unit", text(field.unit));
  switch (field.kind) {
    case Kind::boolean: schema.emplace_back("type", text("boolean")); break;
    case Kind::integer: schema.emplace_back("type", text("integer")); break;
    case Kind::number: schema.emplace_back("type", text("number")); break;
    case Kind::text: schema.emplace_back("type", text("string")); break;
    case Kind::array: append_array_schema(schema, field.dtype); break;
    case Kind::fixed_list:
    case Kind::list: append_list_schema(schema, field); break;
    case Kind::map:
      schema.emplace_back("type", text("object"));
      schema.emplace_back("properties", properties_of(field.members));
      break;
  }
  return {std::move(schema)};
}

std::vector<TypeInfo> all_types() {
  std::vector<TypeInfo> types;
  for_each_message([&](const auto& message) { types.push_back(describe<std::remove_cvref_t<decltype(message)>>()); });
  return types;
}

void append_table(std::string& page, const std::vector<FieldInfo>& fields) {
  page += "| field | type | unit | meaning |\n|---|---|---|---|\n";
  for (const FieldInfo& field : fields) {
    page += "| `" + field.name + "` | " + type_in_words(field) + " | " + field.unit + " | " + field.about + " |\n";
  }
  for (const FieldInfo& field : fields) {
    if (field.kind != Kind::list || field.members.front().kind != Kind::map) continue;
    page += "\nEach of `" + field.name + "`:\n\n";
    append_table(page, field.members.front().members);
  }
}

}  // namespace

const std::vector<TypeInfo>& message_types() {
  static const std::vector<TypeInfo> types = all_types();
  return types;
}

const TypeInfo* find_type(std::string_view type) {
  const auto& types = message_types();
  const auto found = std::find_if(types.begin(), types.end(), [&](const TypeInfo& t) { return t.type == type; });
  return found == types.end() ? nullptr : &*found;
}

std::string mistake_in(std::string_view type, const Value& value) {
  std::string mistake;
  for_each_message([&](auto message) {
    if (type != message.kType) return;
    try {
      from_value(value, message, "");
      if (const std::string field = not_finite(message); !field.empty()) mistake = field + ": is not finite";
    } catch (const DecodeError& error) {
      mistake = error.what();
    }
  });
  return mistake;
}

std::string type_in_words(const FieldInfo& field) {
  switch (field.kind) {
    case Kind::boolean: return "boolean";
    case Kind::integer: return "integer";
    case Kind::number: return "number";
    case Kind::text: return "text";
    case Kind::array: return std::string(dtype_name(field.dtype)) + " array";
    case Kind::fixed_list: return type_in_words(field.members.front()) + " x " + std::to_string(field.length);
    case Kind::list: return "list of " + type_in_words(field.members.front());
    case Kind::map: break;
  }
  std::string names;
  for (const FieldInfo& member : field.members) names += (names.empty() ? "{" : ", ") + member.name;
  return names + "}";
}

std::string json_schema(const TypeInfo* type) {
  if (!type) return "";
  return to_json({Value::Map{{"$schema", text("https://json-schema.org/draft/2020-12/schema")},
                             {"title", text(type->type)},
                             {"description", text(type->about)},
                             {"type", text("object")},
                             {"properties", properties_of(type->fields)}}});
}

std::string reference_page() {
  std::string page =
      "# Messages\n\n"
      "Generated by `ensonify describe --reference` from the structs in `messages/`; a test compares. How they travel "
      "is\n"
      "in [wire.md](wire.md). Times in `stamp_ns` are sim time; arrays are little endian, C order.\n";
  for (const TypeInfo& type : message_types()) {
    page += "\n## " + type.type + "\n\n" + type.about + "\n\n";
    append_table(page, type.fields);
  }
  return page;
}

}  // namespace ensonify::msg
