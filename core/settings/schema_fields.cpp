#include "core/settings/schema_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gaitlab {
namespace {

/// Adds a description, which an editor shows first: the sentence and the unit.
Json described(Json json, const char* about, const char* unit = "") {
  std::string text = about;
  if (*unit != '\0') text += (text.empty() ? "[" : " [") + std::string(unit) + "]";
  if (!text.empty()) json["description"] = text;
  return json;
}

Json preset(Json json, Json value) {
  json["default"] = std::move(value);
  return json;
}

Json names_of(std::span<const char* const> names) {
  Json json = Json::array();
  for (const char* name : names) json.push_back(name);
  return json;
}

}  // namespace

Json scalar_schema() { return {{"type", {"string", "number", "boolean"}}}; }

Json number_schema(const char* type, const Spec& spec) {
  Json json{{"type", type}};
  // Ranges use the smallest number above 0 to mean "more than 0".
  if (spec.min == kPositive) {
    json["exclusiveMinimum"] = 0;
  } else if (std::isfinite(spec.min)) {
    json["minimum"] = spec.min;
  }
  if (std::isfinite(spec.max)) json["maximum"] = spec.max;
  return json;
}

Json object_schema(Json properties) {
  return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

void SchemaFields::visit(const Field& field) {
  need_ = field.need;
  std::visit([&](const auto& value) { on(field.key, field.about, value); }, field.value);
  Json& json = properties_[field.key];
  if (field.need != Need::preset) json.erase("default");
  if (field.need == Need::required) required_.push_back(field.key);
  if (field.need == Need::one_of) one_of_.push_back({{"required", {field.key}}});
  if (field.word == nullptr) return;
  const Json about = json["description"];
  json.erase("description");
  json = {{"anyOf", {json, {{"enum", {field.word}}}}}, {"description", about}};
}

Json SchemaFields::object() {
  Json json = object_schema(std::move(properties_));
  if (!required_.empty()) json["required"] = std::move(required_);
  if (!one_of_.empty()) json["oneOf"] = std::move(one_of_);
  return json;
}

void SchemaFields::on(const char* key, const char* about, const field::Number& field) {
  properties_[key] = preset(described(number_schema("number", field.spec), about, field.spec.unit), field.value);
}

void SchemaFields::on(const char* key, const char* about, const field::NumberOr& field) {
  const Json either{{"anyOf", {number_schema("number", field.spec), {{"const", field.word}}}}};
  properties_[key] = preset(described(either, about, field.spec.unit), field.value > 0 ? Json(field.value) : Json(field.word));
}

void SchemaFields::on(const char* key, const char* about, const field::Integer& field) {
  properties_[key] = preset(described(number_schema("integer", field.spec), about, field.spec.unit), field.value);
}

void SchemaFields::on(const char* key, const char* about, const field::Flag& field) {
  properties_[key] = preset(described({{"type", "boolean"}}, about), field.value);
}

void SchemaFields::on(const char* key, const char* about, const field::Text& field) {
  properties_[key] = described(field.value.empty() ? scalar_schema() : preset(scalar_schema(), field.value), about);
}

void SchemaFields::on(const char* key, const char* about, const field::File&) {
  properties_[key] = described(scalar_schema(), (std::string(about) + " A file, or its text.").c_str());
}

void SchemaFields::on(const char* key, const char* about, const field::OneOf& field) {
  Json json = described({{"enum", names_of(field.names)}}, about);
  if (std::find(field.names.begin(), field.names.end(), field.value) != field.names.end()) json["default"] = field.value;
  properties_[key] = std::move(json);
}

void SchemaFields::on(const char* key, const char* about, const field::EachJoint& field) {
  const Json one = number_schema("number", field.spec);
  Json json = one;  // each rule below applies only to values of the type in the rule
  json["type"] = {"number", "array", "object"};
  json["items"] = one;
  json["additionalProperties"] = one;
  const std::string text =
      std::string(about) + (field.of_modules ? " One number, a list, or {default: x, MODULE: y}, such as m3."
                                             : " One number, a list, or {default: x, JOINT: y}; JOINT may be a pattern: "
                                               "\"*/active\".");
  properties_[key] = described(std::move(json), text.c_str(), field.spec.unit);
  if (field.role == field::Role::required || not_stated(field)) return;
  properties_[key] =
      preset(std::move(properties_[key]), field.value.each.empty() ? Json(field.value.common) : Json(field.value.each));
}

void SchemaFields::on(const char* key, const char* about, const field::Joint&) {
  properties_[key] = described({{"type", {"string", "integer"}}}, (std::string(about) + " A joint's name or number.").c_str());
}

void SchemaFields::on(const char* key, const char* about, const field::Vector& field) {
  Json json{{"type", "array"},
            {"items", number_schema("number", field.spec)},
            {"minItems", field.value.size()},
            {"maxItems", field.value.size()}};
  properties_[key] =
      preset(described(std::move(json), about, field.spec.unit), std::vector<double>(field.value.begin(), field.value.end()));
}

void SchemaFields::on(const char* key, const char* about, const field::Numbers& field) {
  Json json{{"type", "array"}, {"items", number_schema(field.whole ? "integer" : "number", field.spec)}};
  if (field.whole) json["minItems"] = 1;
  properties_[key] = preset(described(std::move(json), about, field.spec.unit), field.value);
}

void SchemaFields::on(const char* key, const char* about, const field::Rows& field) {
  const Json row{{"type", "array"}, {"items", number_schema("number", field.spec)}};
  properties_[key] = described({{"type", "array"}, {"items", row}}, about, field.spec.unit);
}

void SchemaFields::on(const char* key, const char* about, const field::Texts& field) {
  properties_[key] = preset(described({{"type", "array"}, {"items", scalar_schema()}}, about), field.value);
}

void SchemaFields::on(const char* key, const char* about, const field::Names& field) {
  if (field.one) {
    properties_[key] = described(scalar_schema(), about);
    return;
  }
  const Json one = field.words.empty() ? scalar_schema() : Json{{"enum", names_of(field.words)}};
  Json either{{"anyOf", {one, {{"type", "array"}, {"items", one}}}}};
  properties_[key] =
      preset(described(std::move(either), about), field.value.size() == 1 ? Json(field.value.front()) : Json(field.value));
}

void SchemaFields::on(const char* key, const char* about, const field::Periods& field) {
  const Json one = number_schema("number", field.spec);
  const Json range{{"type", "array"}, {"items", one}, {"minItems", 2}, {"maxItems", 2}};
  Json json = field.most == nullptr ? one : Json{{"anyOf", {one, range}}};
  properties_[key] = preset(described(std::move(json), about, field.spec.unit), field.value);
}

void SchemaFields::on(const char* key, const char* about, const field::Map& field) {
  Json one = scalar_schema();
  if (field.kind == NamedValues::texts_or_numbers) {  // a number may be given per joint
    one["type"] = {"string", "number", "boolean", "array", "object"};
    one["items"] = {{"type", "number"}};
    one["additionalProperties"] = {{"type", "number"}};
  }
  Json map = Json::object();
  for (const Named& value : field.value) map[value.name] = value.text.empty() ? Json(value.number.common) : Json(value.text);
  properties_[key] = preset(described({{"type", "object"},
                                       {"propertyNames", {{"pattern", "^[A-Za-z][A-Za-z0-9_]*$"}}},
                                       {"additionalProperties", std::move(one)}},
                                      about),
                            std::move(map));
}

namespace {

Json column_schema() {
  LogColumn column;
  SchemaFields inner;
  column.fields(inner);
  return {{"anyOf", {scalar_schema(), inner.object()}}};
}

}  // namespace

void SchemaFields::on(const char* key, const char* about, const field::Column&) {
  properties_[key] = described(column_schema(), about);
}

void SchemaFields::on(const char* key, const char* about, const field::Columns&) {
  properties_[key] = described({{"type", "object"}, {"additionalProperties", column_schema()}}, about);
}

void SchemaFields::on(const char* key, const char* about, const field::List& field) {
  const std::size_t size = field.size(field.self);
  if (size == 0) field.resize(field.self, 1);  // one element with its defaults, for the list of keys
  SchemaFields element;
  field.visit(field.self, 0, element);
  if (size == 0) field.resize(field.self, 0);
  Json json{{"type", "array"}, {"items", element.object()}};
  if (field.name != nullptr)
    json = {{"type", "object"}, {"minProperties", need_ == Need::required ? 1 : 0}, {"additionalProperties", json["items"]}};
  properties_[key] = described(std::move(json), about);
}

void SchemaFields::on(const char* key, const char* about, const field::RuleOrList& field) {
  on(key, "", field.list);
  Json json{{"anyOf", {{{"enum", names_of(field.names)}}, properties_[key]}}};
  if (!field.rule.empty()) json["default"] = field.rule;
  properties_[key] = described(std::move(json), about);
}

void SchemaFields::on(const char* key, const char* about, const field::Group& field) {
  SchemaFields inner;
  field.visit(field.self, inner);
  properties_[key] = described(inner.object(), about);
}

void SchemaFields::on(const char* key, const char* about, const field::Other& field) {
  Json json = described(Json::parse(field.schema), about);
  properties_[key] = *field.preset == '\0' ? json : preset(json, Json::parse(field.preset));
}

}  // namespace gaitlab
