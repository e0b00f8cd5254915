#include "core/scenario/schema.h"

#include <optional>

#include "core/scenario/change_section.h"
#include "core/scenario/sections.h"
#include "core/settings/overlay.h"
#include "core/settings/schema_fields.h"

namespace gaitlab {
namespace {

// Schema of the parts that are not read through Fields: the parts of the robot and the head of the file.
constexpr const char* kParts = R"json({
  "vector": {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3},
  "source": {"type": ["string", "number", "boolean"], "description": "Origin of the values."},
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
  "shape": {"type": "object", "additionalProperties": false, "properties": {
    "box": {"$ref": "#/definitions/vector"},
    "cylinder": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2},
    "half_cylinder": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2},
    "sphere": {"type": "number"},
    "origin": {"$ref": "#/definitions/vector"}, "rpy": {"$ref": "#/definitions/vector"},
    "source": {"$ref": "#/definitions/source"}}},
  "contact": {"type": "object", "additionalProperties": false, "required": ["body"], "properties": {
    "body": {"type": "string"}, "point": {"$ref": "#/definitions/vector"}, "sphere": {"$ref": "#/definitions/vector"},
    "radius": {"type": "number"}, "source": {"$ref": "#/definitions/source"}}},
  "module_type": {"type": "object", "additionalProperties": false, "required": ["name", "bodies"], "properties": {
    "gaitlab_module": {"enum": [1, 2, 3], "description": "Format version."},
    "name": {"type": ["string", "number", "boolean"], "description": "Name of the type."},
    "lattice": {"type": "boolean", "description": "Bodies with faces fill cells of a cubic lattice."},
    "source": {"$ref": "#/definitions/source"},
    "bodies": {"type": "object", "minProperties": 1, "additionalProperties": {
      "type": "object", "additionalProperties": false, "properties": {
        "mass": {"type": "number", "minimum": 0, "description": "Mass; 0 only for a body between two hinges. [kg]"},
        "com": {"$ref": "#/definitions/vector"},
        "inertia": {"type": "array", "items": {"type": "number"}, "minItems": 6, "maxItems": 6,
                    "description": "xx, yy, zz, xy, xz, yz about the COM, body axes; in format 3 by default those of shape. [kg m^2]"},
        "shape": {"type": "array", "items": {"$ref": "#/definitions/shape"}},
        "source": {"$ref": "#/definitions/source"}}}},
    "hinges": {"type": "array", "items": {
      "type": "object", "additionalProperties": false, "required": ["name", "parent", "child", "axis", "range"], "properties": {
        "name": {"type": ["string", "number", "boolean"]}, "parent": {"type": "string"}, "child": {"type": "string"},
        "origin": {"$ref": "#/definitions/vector"}, "rpy": {"$ref": "#/definitions/vector"},
        "axis": {"$ref": "#/definitions/vector"},
        "range": {"description": "Smallest and largest angle, or free. [rad]", "anyOf": [{"const": "free"},
          {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}]},
        "drive": {"enum": ["motor", "none"], "default": "motor", "description": "motor, or none for a passive hinge."},
        "stiffness": {"type": "number", "minimum": 0, "description": "Stiffness of a spring; drive: none. [N m/rad]"},
        "rest": {"type": "number", "description": "Angle at which the spring has no torque. [rad]"},
        "damping": {"type": "number", "minimum": 0, "description": "Coefficient of a viscous damper; drive: none. [N m s/rad]"},
        "friction": {"type": "number", "minimum": 0, "description": "Dry friction; drive: none. [N m]"},
        "friction_speed": {"type": "number", "exclusiveMinimum": 0,
                           "description": "Speed below which dry friction is viscous. [rad/s]"},
        "actuator": {"type": "object", "description": "Keys of the motor that differ from the module type's actuator."},
        "controller": {"type": "object",
                       "description": "Keys of the controller that differ from the module type's controller."},
        "source": {"$ref": "#/definitions/source"}}}},
    "faces": {"type": "array", "items": {
      "type": "object", "additionalProperties": false,
      "required": ["id", "body", "gender", "origin", "normal", "reference"], "properties": {
        "id": {"type": "integer", "minimum": 0, "maximum": 1000, "description": "Number of the face in build files."},
        "body": {"type": "string"}, "gender": {"enum": ["active", "passive", "none"]},
        "connector": {"type": "string", "description": "Name of the connector; only faces with the same connector dock."},
        "turns": {"type": "array", "items": {"type": "integer", "minimum": 0, "maximum": 3}, "minItems": 1,
                  "description": "Orientations in which the face docks."},
        "origin": {"$ref": "#/definitions/vector"}, "normal": {"$ref": "#/definitions/vector"},
        "reference": {"$ref": "#/definitions/vector"}, "source": {"$ref": "#/definitions/source"}}}},
    "contacts": {"type": "object", "additionalProperties": false, "properties": {
      "feet": {"description": "Elements for contact.on: feet.", "anyOf": [{"const": "shapes"},
        {"type": "array", "items": {"$ref": "#/definitions/contact"}}]},
      "all": {"description": "Elements for contact.on: all.", "anyOf": [{"const": "shapes"},
        {"type": "array", "items": {"$ref": "#/definitions/contact"}}]},
      "source": {"$ref": "#/definitions/source"}}},
    "connectors": {"type": "object", "description": "Largest loads of the connectors, by name.", "additionalProperties": {
      "type": "object", "additionalProperties": false, "properties": {
        "tension": {"type": "number", "exclusiveMinimum": 0, "description": "Largest pull along the normal. [N]"},
        "shear": {"type": "number", "exclusiveMinimum": 0, "description": "Largest force in the plane of the face. [N]"},
        "bending": {"type": "number", "exclusiveMinimum": 0, "description": "Largest moment about axes in that plane. [N m]"},
        "torsion": {"type": "number", "exclusiveMinimum": 0, "description": "Largest moment about the normal. [N m]"},
        "source": {"$ref": "#/definitions/source"}}}},
    "actuator": {"type": "object", "description": "The default motor."},
    "controller": {"type": "object", "description": "The default controller."}}},
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
    "description": "Docks as rows of a build file, given here; without build and docks: one module."}
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
  /// `head` is the schema of the section, from which only the deciding key is kept. `preset` is the value of that key if it is
  /// absent; "" permits any value, and nothing means that the key is required.
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

}  // namespace

std::string scenario_schema(const Catalog& catalog) {
  Scenario scenario;
  SectionFields sections(scenario, &catalog, nullptr, describe(Kind::actuator).default_type);
  for (PluginFields* plugin : {&sections.actuator, &sections.controller, &sections.cpg}) plugin->own_keys = false;
  SchemaFields fields;
  sections.fields(fields);
  const Json& heads = fields.properties();

  Json properties = Json::parse(kHead);
  properties["robot"] = robot_section();
  for (const auto& [key, value] : heads.items()) properties[key] = value;
  properties["physics"] = physics_section(heads["physics"], catalog);
  // A module type may name another motor than the default. Without `type`, the keys of any motor are therefore allowed.
  properties["actuator"] = plugin_section(sections.actuator, heads["actuator"], catalog, "");
  properties["controller"] =
      plugin_section(sections.controller, heads["controller"], catalog, describe(Kind::controller).default_type);
  properties["cpg"] = plugin_section(sections.cpg, heads["cpg"], catalog, describe(Kind::cpg).default_type);
  properties["duration"].erase("default");
  properties["sensors"] = sensors_section();
  properties["at"] = changes_section();

  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"},
              {"title", "gaitlab scenario"},
              {"description", "Written by `gaitlab schema`."}};
  schema.update(object_schema(std::move(properties)));
  schema["required"] = Json::array({"robot", "duration"});
  schema["definitions"] = Json::parse(kParts);
  schema["definitions"]["sensor"] = sensor_section(catalog);
  return schema.dump(1) + "\n";
}

}  // namespace gaitlab
