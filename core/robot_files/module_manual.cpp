#include "core/robot_files/module_manual.h"

#include <fmt/format.h>

#include "core/robot_files/module_keys.h"
#include "core/settings/explainer.h"
#include "core/settings/schema_fields.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

/// Form and range of a value other than words.
std::string form_of(const ModuleKey& key) {
  Spec spec = key.spec;
  spec.unit = "";
  std::string range = range_text(spec);
  const std::string limited = range.empty() ? "" : ", " + range;
  switch (key.form) {
    case ModuleForm::text:
      return "text";
    case ModuleForm::number:
      return range.empty() ? "number" : range;
    case ModuleForm::integer:
      return range;
    case ModuleForm::flag:
      return "true | false";
    case ModuleForm::vector:
      return fmt::format("{} numbers{}", key.size, limited);
    case ModuleForm::integers:
      return "list of integers" + limited;
    case ModuleForm::list:
      return "list";
    case ModuleForm::pairs:
      return "list of pairs";
    case ModuleForm::map:
      return key.by_name ? "map by name" : "map";
    case ModuleForm::word:
      break;
  }
  return "";
}

std::string range_of(const ModuleKey& key) {
  const std::string form = form_of(key);
  const std::string words = fmt::format("{}", fmt::join(key.words, " | "));
  const std::string either = form + (form.empty() || words.empty() ? "" : " | ") + words;
  return key.required ? "required; " + either : either;
}

std::string about(const ModuleKey& key) { return key.spec.about + std::string(key.passive ? " Only with drive: none." : ""); }

/// Default as the manual prints it: a word without the quotes of JSON.
std::string preset_of(const ModuleKey& key) {
  const std::string text = key.preset;
  return text.starts_with('"') ? text.substr(1, text.size() - 2) : text;
}

void add_rows(const ModuleMap& map, const std::string& indent, Explainer& rows) {
  for (const ModuleKey& key : map.keys) {
    const std::string end = key.map == nullptr ? "" : key.form == ModuleForm::list ? "[]" : key.by_name ? ".NAME" : "";
    std::vector<std::string> words(key.words.begin(), key.words.end());
    if (key.form == ModuleForm::flag) words = {"true", "false"};
    rows.row(indent + key.key + end, key.spec.unit, preset_of(key), range_of(key), about(key), std::move(words));
    // Elements for feet are those for all; their keys are listed once.
    const bool listed = key.map != nullptr && &key + 1 != map.keys.data() + map.keys.size() && (&key + 1)->map == key.map;
    if (key.map != nullptr && !listed) add_rows(*key.map, indent + "  ", rows);
  }
}

Json map_schema(const ModuleMap& map);

/// Schema of a value other than words.
Json form_schema(const ModuleKey& key) {
  Json inner = key.map == nullptr ? Json{{"type", "object"}} : map_schema(*key.map);
  switch (key.form) {
    case ModuleForm::text:
      return scalar_schema();
    case ModuleForm::number:
      return number_schema("number", key.spec);
    case ModuleForm::integer:
      return number_schema("integer", key.spec);
    case ModuleForm::flag:
      return {{"type", "boolean"}};
    case ModuleForm::vector:
      return {{"type", "array"}, {"items", number_schema("number", key.spec)}, {"minItems", key.size}, {"maxItems", key.size}};
    case ModuleForm::integers:
      return {{"type", "array"}, {"items", number_schema("integer", key.spec)}, {"minItems", 1}};
    case ModuleForm::list:
      return {{"type", "array"}, {"items", inner}};
    case ModuleForm::pairs:
      return {{"type", "array"},
              {"items", {{"type", "array"}, {"items", {{"type", "string"}}}, {"minItems", 2}, {"maxItems", 2}}}};
    case ModuleForm::map:
      if (!key.by_name) return inner;
      return {{"type", "object"}, {"minProperties", key.required ? 1 : 0}, {"additionalProperties", inner}};
    case ModuleForm::word:
      break;
  }
  return Json::object();
}

Json key_schema(const ModuleKey& key) {
  Json json = form_schema(key);
  if (!key.words.empty()) {
    Json words = Json::array();
    for (const char* word : key.words) words.push_back(word);
    json = key.form == ModuleForm::word ? Json{{"enum", words}} : Json{{"anyOf", {json, {{"enum", words}}}}};
  }
  json["description"] = about(key) + (*key.spec.unit == '\0' ? "" : " [" + std::string(key.spec.unit) + "]");
  if (*key.preset != '\0') json["default"] = Json::parse(key.preset);
  return json;
}

Json map_schema(const ModuleMap& map) {
  Json properties = Json::object();
  Json required = Json::array();
  Json one_of = Json::array();
  for (const ModuleKey& key : map.keys) {
    properties[key.key] = key_schema(key);
    if (key.required) required.push_back(key.key);
  }
  for (const char* key : map.one_of) one_of.push_back({{"required", {key}}});
  Json schema = object_schema(std::move(properties));
  if (!required.empty()) schema["required"] = required;
  if (!one_of.empty()) schema["oneOf"] = one_of;
  return schema;
}

}  // namespace

std::vector<KeyRow> module_rows() {
  Explainer rows;
  add_rows(kModuleMap, "", rows);
  return rows.rows();
}

std::string explain_module_file() {
  return wrapped(
             "A module file describes a type of module: a tree of bodies and revolute hinges, with docking faces, contact "
             "elements, a motor and a controller. `gaitlab new module NAME` writes one to start from; `gaitlab explain module "
             "NAME` prints the parts of a module, a file or one of `gaitlab list module`.") +
         "\n" + table(module_rows());
}

std::string module_page() {
  return "# The module file\n\n"
         "<!-- Written by `tests/gates/reference.sh build/release --renew`; CI fails where it is stale. -->\n\n"
         "Every key, as `gaitlab explain module` prints it; their use: [modules](../modules.md). `gaitlab new module NAME` "
         "writes "
         "a\nfile to start from. For editors: the JSON Schema `scenarios/gaitlab-module.schema.json`, by `gaitlab schema "
         "--module`.\n\n" +
         markdown_table(module_rows());
}

Json module_type_schema() { return map_schema(kModuleMap); }

}  // namespace gaitlab
