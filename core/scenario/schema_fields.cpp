#include "core/scenario/schema_fields.h"

#include <cmath>
#include <limits>

namespace gaitlab {
namespace {

/// Any scalar: a text need not be quoted, so that 8 and true are texts, too.
Json scalar() { return {{"type", {"string", "number", "boolean"}}}; }

Json bounded(const char* type, const Spec& spec) {
  Json json{{"type", type}};
  // The smallest number above 0 stands for "more than 0".
  if (spec.min == std::numeric_limits<double>::denorm_min()) {
    json["exclusiveMinimum"] = 0;
  } else if (std::isfinite(spec.min)) {
    json["minimum"] = spec.min;
  }
  if (std::isfinite(spec.max)) json["maximum"] = spec.max;
  return json;
}

/// The first line of what an editor shows: the sentence and the unit.
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

Json object_schema(Json properties) {
  return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

void SchemaFields::number(const char* key, double& value, Spec spec) {
  properties_[key] = preset(described(bounded("number", spec), spec.about, spec.unit), value);
}

void SchemaFields::number_or(const char* key, double& value, const char* word, Spec spec) {
  const Json either{{"anyOf", {bounded("number", spec), {{"const", word}}}}};
  properties_[key] = preset(described(either, spec.about, spec.unit), value > 0 ? Json(value) : Json(word));
}

void SchemaFields::integer(const char* key, std::int64_t& value, Spec spec) {
  properties_[key] = preset(described(bounded("integer", spec), spec.about, spec.unit), value);
}

void SchemaFields::flag(const char* key, bool& value, const char* about) {
  properties_[key] = preset(described({{"type", "boolean"}}, about), value);
}

void SchemaFields::text(const char* key, std::string& value, const char* about) {
  properties_[key] = described(value.empty() ? scalar() : preset(scalar(), value), about);
}

void SchemaFields::file(const char* key, std::string&, const char* about) {
  properties_[key] = described(scalar(), (std::string(about) + " A file, or its text.").c_str());
}

void SchemaFields::choice(const char* key, int& value, std::span<const char* const> names, const char* about) {
  Json json = described({{"enum", names_of(names)}}, about);
  if (value >= 0 && static_cast<std::size_t>(value) < names.size()) json["default"] = names[static_cast<std::size_t>(value)];
  properties_[key] = std::move(json);
}

void SchemaFields::per_joint(const char* key, PerJoint& value, Spec spec) {
  const Json one = bounded("number", spec);
  Json json = one;  // each rule below holds for values of its own type only
  json["type"] = {"number", "array", "object"};
  json["items"] = one;
  json["additionalProperties"] = one;
  const std::string about = std::string(spec.about) + " One number, a list, or {default: x, JOINT: y}.";
  properties_[key] =
      preset(described(std::move(json), about.c_str(), spec.unit), value.each.empty() ? Json(value.common) : Json(value.each));
}

void SchemaFields::joint(const char* key, std::int64_t&, const char* about) {
  properties_[key] = described({{"type", {"string", "integer"}}}, (std::string(about) + " A joint's name or number.").c_str());
}

void SchemaFields::vector(const char* key, std::span<double> value, Spec spec) {
  Json json{{"type", "array"}, {"items", bounded("number", spec)}, {"minItems", value.size()}, {"maxItems", value.size()}};
  properties_[key] = preset(described(std::move(json), spec.about, spec.unit), std::vector<double>(value.begin(), value.end()));
}

void SchemaFields::numbers(const char* key, std::vector<double>& value, Spec spec) {
  properties_[key] = preset(described({{"type", "array"}, {"items", bounded("number", spec)}}, spec.about, spec.unit), value);
}

void SchemaFields::rows(const char* key, std::vector<std::vector<double>>&, Spec spec) {
  const Json row{{"type", "array"}, {"items", bounded("number", spec)}};
  properties_[key] = described({{"type", "array"}, {"items", row}}, spec.about, spec.unit);
}

void SchemaFields::texts(const char* key, std::vector<std::string>& value, const char* about) {
  properties_[key] = preset(described({{"type", "array"}, {"items", scalar()}}, about), value);
}

void SchemaFields::named(const char* key, std::vector<Named>& values, NamedValues kind, const char* about) {
  Json one = scalar();
  if (kind == NamedValues::texts_or_numbers) {  // a number may be one a joint
    one["type"] = {"string", "number", "boolean", "array", "object"};
    one["items"] = {{"type", "number"}};
    one["additionalProperties"] = {{"type", "number"}};
  }
  Json map = Json::object();
  for (const Named& value : values) map[value.name] = value.text.empty() ? Json(value.number.common) : Json(value.text);
  properties_[key] = preset(described({{"type", "object"},
                                       {"propertyNames", {{"pattern", "^[A-Za-z][A-Za-z0-9_]*$"}}},
                                       {"additionalProperties", std::move(one)}},
                                      about),
                            std::move(map));
}

void SchemaFields::list(const char* key, const char* about, List list) {
  const std::size_t size = list.size(list.self);
  if (size == 0) list.resize(list.self, 1);  // an element with its defaults, to look at
  SchemaFields element;
  list.visit(list.self, 0, element);
  if (size == 0) list.resize(list.self, 0);
  properties_[key] = described({{"type", "array"}, {"items", object_schema(std::move(element.properties_))}}, about);
}

void SchemaFields::rule_or_list(const char* key, int& rule, std::span<const char* const> names, const char* about,
                                List elements) {
  list(key, "", elements);
  Json json{{"anyOf", {{{"enum", names_of(names)}}, properties_[key]}}};
  if (rule >= 0) json["default"] = names[static_cast<std::size_t>(rule)];
  properties_[key] = described(std::move(json), about);
}

void SchemaFields::group(const char* key, const char* about, Group group) {
  SchemaFields inner;
  group.visit(group.self, inner);
  properties_[key] = described(object_schema(std::move(inner.properties_)), about);
}

}  // namespace gaitlab
