#include "core/scenario/schema.h"

#include <optional>

#include "core/robot_files/module_manual.h"
#include "core/scenario/change_section.h"
#include "core/scenario/group_section.h"
#include "core/scenario/sections.h"
#include "core/settings/overlay.h"
#include "core/settings/schema_fields.h"
#include "core/settings/shipped_files.h"

namespace gaitlab {
namespace {

// Schema of the parts that are not read through Fields: docks and the head of the file.
constexpr const char* kParts = R"json({
  "dock": {"anyOf": [
    {"type": "array", "items": {"type": "integer", "minimum": 0}, "minItems": 5, "maxItems": 5,
     "description": "child_face, child_module, parent_face, parent_module, orientation"},
    {"type": "object", "additionalProperties": false,
     "required": ["child_face", "child_module", "parent_face", "parent_module", "orientation"], "properties": {
      "child_face": {"type": "integer", "minimum": 0, "description": "Face of the child."},
      "child_module": {"type": "integer", "minimum": 0, "description": "Module that is docked."},
      "parent_face": {"type": "integer", "minimum": 0, "description": "Face of the parent."},
      "parent_module": {"type": "integer", "minimum": 0, "description": "Module to which the child is docked."},
      "orientation": {"type": "integer", "minimum": 0, "description": "Quarter turns about the child's face normal, 0 to 3."}}}]},
  "module_choice": {"anyOf": [{"type": "string"}, {"$ref": "#/definitions/module_type"}]}
})json";

constexpr const char* kRobot = R"json({
  "modules": {"description": "Module type (a name, a file, or the type itself), or {0: mtran, 5: ./foot.yaml, default: mtran}.",
    "default": "mtran", "anyOf": [{"$ref": "#/definitions/module_choice"},
      {"type": "object", "additionalProperties": false, "properties": {"default": {"$ref": "#/definitions/module_choice"}},
       "patternProperties": {"^(0|[1-9][0-9]*)$": {"$ref": "#/definitions/module_choice"}}}]},
  "types": {"type": "object", "additionalProperties": {"$ref": "#/definitions/module_type"},
    "description": "Module types defined here, by name."},
  "build": {"type": "string",
    "description": "Build file, rows child_face child_module parent_face parent_module orientation."},
  "docks": {"type": "array", "items": {"$ref": "#/definitions/dock"},
    "description": "Docks as rows of a build file, given here; without build and docks: one module."},
  "may_overlap": {"type": "array", "default": [], "items": {"type": "array", "items": {"type": "string"}, "minItems": 2,
    "maxItems": 2}, "description": "Pairs [BODY, BODY] that the check collision leaves out, by names or patterns: [[m0/trunk, \"m[1-4]/leg\"]]."},
  "legs": {"description": "Legs with their last bodies, {front_left: m0/shin}, in place of the legs that are found; or none.",
    "anyOf": [{"const": "none"}, {"type": "object", "minProperties": 1, "additionalProperties": {"type": "string"}}]}
})json";

constexpr const char* kHead = R"json({
  "gaitlab": {"const": 1, "description": "Format version."},
  "name": {"type": ["string", "number", "boolean"], "description": "Name of the run folder; default: the file's name."},
  "plugins": {"type": "array", "default": [], "description": "Plugin libraries, relative to this file; commands that do not run the scenario load them with --plugins-from-scenario.", "items": {"anyOf": [
    {"type": "string"},
    {"type": "object", "additionalProperties": false, "required": ["path"], "properties": {
      "path": {"type": "string", "description": "The library."},
      "hash": {"type": ["string", "number"],
               "description": "FNV-1a hash of the file; a file with another hash is refused."}}}]}}
})json";

std::string first_line(std::string_view text) { return std::string(text.substr(0, text.find('\n'))); }

/// A section whose keys depend on the value of one of its keys.
class Alternatives {
 public:
  /// `head` is the schema of the section; only its deciding key is kept. `preset` is the default of the deciding key. With "",
  /// the key may be absent, and the keys of every value are then allowed. The key is required if `preset` is std::nullopt.
  Alternatives(const Json& head, std::string key, std::optional<std::string> preset)
      : key_(std::move(key)), preset_(std::move(preset)) {
    json_ = {{"type", "object"}, {"description", head["description"]}};
    json_["properties"][key_] = head["properties"][key_];
    json_["allOf"] = Json::array();
  }

  void add(const std::string& name, Json properties, const std::string& about) {
    properties[key_] = {{"const", name}};
    Json when{{"properties", {{key_, {{"const", name}}}}}};
    if (name != preset_) when["required"] = Json::array({key_});
    Json then{{"properties", std::move(properties)}, {"additionalProperties", false}};
    if (!about.empty()) then["description"] = about;
    any_.push_back(then);
    json_["allOf"].push_back({{"if", std::move(when)}, {"then", std::move(then)}});
  }

  Json take() {
    if (!preset_) json_["required"] = Json::array({key_});
    if (preset_ == "")
      json_["allOf"].push_back({{"if", {{"not", {{"required", Json::array({key_})}}}}}, {"then", {{"anyOf", any_}}}});
    return std::move(json_);
  }

 private:
  std::string key_;
  std::optional<std::string> preset_;
  Json json_, any_ = Json::array();
};

Json plugin_section(const PluginFields& section, const Json& head, const Catalog& catalog,
                    const std::optional<std::string>& preset) {
  Alternatives all(head, "type", preset);
  for (const std::string& name : catalog.names(section.kind)) {
    PluginSelection selection;
    PluginFields one{section.kind, selection, name, &catalog, section.host};
    SchemaFields fields;
    one.fields(fields);
    all.add(name, std::move(fields.properties()), first_line(selection.entry->manual));
  }
  if (describe(section.kind).may_be_none) all.add("none", Json::object(), "No motor: the joints are free.");
  return all.take();
}

/// Allows a CPG file beside the names of the CPGs: a path, or the name of a shipped file. Its keys are not restricted.
void allow_files(Json& type) {
  Json names = Json::array();
  for (const auto& [name, path] : shipped_files("cpg")) names.push_back(name);
  Json all = Json::array({{{"enum", type.at("enum")}}, {{"pattern", "/|[.]yaml$"}}});
  if (!names.empty()) all.push_back({{"enum", names}});
  type.erase("enum");
  type["anyOf"] = std::move(all);
}

/// Schema of one sensor.
Json sensor_section(const Catalog& catalog) {
  const PluginKind& kind = describe(Kind::sensor);
  PluginSelection selection;
  PluginFields section{kind.kind, selection, kind.default_type, &catalog};
  section.own_keys = false;
  SchemaFields fields;
  section.fields(fields);
  return plugin_section(section, {{"description", kind.about}, {"properties", fields.properties()}}, catalog, std::nullopt);
}

/// Schema of the section `sensors`: one sensor, sensors by name, or an empty list.
Json sensors_section() {
  const Json one{{"$ref", "#/definitions/sensor"}};
  return {{"description", "Sensors by name, each with a type; a map with a key type is a single one."},
          {"type", {"object", "array"}},
          {"maxItems", 0},
          {"default", Json::object()},
          {"if", {{"type", "object"}, {"required", {"type"}}}},
          {"then", one},
          {"else", {{"additionalProperties", one}}}};
}

/// Schema of the section `at`.
Json changes_section() {
  JointFault fault;
  SchemaFields of_fault;
  FaultKeys{fault, true}.fields(of_fault);
  for (auto& [key, value] : of_fault.properties().items()) value.erase("default");
  Json one = object_schema(std::move(of_fault.properties()));
  one["required"] = Json::array({"joint", "kind"});
  Change change;
  SchemaFields keys;
  ChangeKeys{change}.fields(keys);
  Json properties = std::move(keys.properties());
  properties["t"].erase("default");
  properties["set"] = {{"description", kAboutSet},
                       {"type", "object"},
                       {"minProperties", 1},
                       {"propertyNames", {{"pattern", "^(cpg|controller)\\."}}}};
  properties["fault"] = {{"description", kAboutFault}, {"anyOf", {one, {{"type", "array"}, {"minItems", 1}, {"items", one}}}}};
  Json each = object_schema(std::move(properties));
  each["required"] = Json::array({"t"});
  each["anyOf"] = Json::array({{{"required", {"set"}}}, {{"required", {"fault"}}}});
  return {{"description", kAboutChanges}, {"default", Json::array()}, {"type", "array"}, {"items", each}};
}

Json groups_section() {
  const Json joint{{"type", "string"}};
  const Json joints{{"type", "array"}, {"minItems", 1}, {"items", joint}};
  return {{"description", kAboutGroups},
          {"type", "object"},
          {"default", Json::object()},
          {"propertyNames", {{"pattern", "^[A-Za-z][A-Za-z0-9_-]*$"}}},
          {"additionalProperties", {{"anyOf", {joint, joints}}}}};
}

Json physics_section(const Json& head, const Catalog& catalog) {
  Alternatives all(head, "engine", "bullet");
  for (const std::string& name : catalog.engines()) {
    Physics physics;
    physics.engine = catalog.engine(name);
    PhysicsFields one{physics, &catalog};
    SchemaFields fields;
    one.fields(fields);
    all.add(name, std::move(fields.properties()), first_line(physics.engine->manual));
  }
  return all.take();
}

Json robot_section() {
  Scenario scenario;
  SchemaFields base;
  BaseFields{scenario}.fields(base);
  Json properties = Json::parse(kRobot);
  properties.update(base.properties());
  properties["position"]["minItems"] = 2;
  properties["position"]["maxItems"] = 3;
  Json robot = object_schema(std::move(properties));
  robot["description"] = "The robot; required.";
  return robot;
}

/// Properties of the sections after the robot, without the keys of plugins.
Json section_heads(SectionFields& sections) {
  for (PluginFields* plugin : {&sections.actuator, &sections.controller, &sections.cpg}) plugin->own_keys = false;
  SchemaFields fields;
  sections.fields(fields);
  return std::move(fields.properties());
}

Json titled(const char* title, const char* command) {
  return {{"$schema", "http://json-schema.org/draft-07/schema#"},
          {"title", title},
          {"description", std::string("Written by `") + command + "`."}};
}

}  // namespace

std::string module_schema(const Catalog& catalog) {
  Scenario scenario;
  SectionFields sections(scenario, &catalog, nullptr, describe(Kind::actuator).default_type);
  const Json heads = section_heads(sections);
  Json type = module_type_schema();
  std::string source;
  std::string model;
  Identification identified;
  for (PluginFields* plugin : {&sections.actuator, &sections.controller}) {
    plugin->host = [&](Fields& f) {
      f.text("model", model, "Name of a servo (gaitlab list servo), whose keys stand for those that are not stated.");
      f.text("source", source, "Origin of the values.");
      f.group(kIdentified, identified, "Logs to which the values were fitted; a servo file states them.");
    };
    const PluginKind& kind = describe(plugin->kind);
    Json& section = type["properties"][kind.section];
    Json head{{"description", section["description"]}, {"properties", heads[kind.section]["properties"]}};
    section = plugin_section(*plugin, head, catalog, kind.default_type);
  }
  Json schema = titled("gaitlab module", "gaitlab schema --module");
  schema.update(type);
  schema["required"].insert(schema["required"].begin(), "gaitlab_module");
  return schema.dump(1) + "\n";
}

std::string scenario_schema(const Catalog& catalog) {
  Scenario scenario;
  SectionFields sections(scenario, &catalog, nullptr, describe(Kind::actuator).default_type);
  const Json heads = section_heads(sections);

  Json properties = Json::parse(kHead);
  properties["robot"] = robot_section();
  for (const auto& [key, value] : heads.items()) properties[key] = value;
  properties["physics"] = physics_section(heads["physics"], catalog);
  // A module type may name another motor than the default. Without `type`, the keys of any motor are therefore allowed.
  properties["actuator"] = plugin_section(sections.actuator, heads["actuator"], catalog, "");
  properties["controller"] =
      plugin_section(sections.controller, heads["controller"], catalog, describe(Kind::controller).default_type);
  properties["cpg"] = plugin_section(sections.cpg, heads["cpg"], catalog, describe(Kind::cpg).default_type);
  allow_files(properties["cpg"]["properties"]["type"]);
  properties["duration"].erase("default");
  properties["sensors"] = sensors_section();
  properties["at"] = changes_section();
  properties[kGroupsSection] = groups_section();

  Json schema = titled("gaitlab scenario", "gaitlab schema");
  schema.update(object_schema(std::move(properties)));
  schema["required"] = Json::array({"robot", "duration"});
  schema["definitions"] = Json::parse(kParts);
  schema["definitions"]["module_type"] = module_type_schema();
  schema["definitions"]["sensor"] = sensor_section(catalog);
  return schema.dump(1) + "\n";
}

}  // namespace gaitlab
