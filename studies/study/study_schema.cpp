// The JSON Schema of a study file, for editors: from the same walks as its reader, and what that reads piece by piece.
#include "core/settings/schema_fields.h"
#include "studies/study/guards.h"
#include "studies/study/study_file.h"
#include "studies/study/study_keys.h"

namespace gaitlab::studies {

namespace {

constexpr const char* kStudyParts = R"json({
  "scalar": {"type": ["string", "number", "boolean"]},
  "expression": {"type": ["string", "number"], "description": "An expression over quantities, as summary.json names them."},
  "values": {"type": "array", "minItems": 1, "uniqueItems": true, "items": {"$ref": "#/definitions/scalar"},
    "description": "Instead of low and high: numbers or words, one by one."},
  "law": {"type": "object", "additionalProperties": false, "properties": {
    "normal": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2, "description": "Mean and deviation."},
    "low": {"type": "number", "description": "Of normal: what is drawn below is drawn again."},
    "high": {"type": "number", "description": "Of normal: what is drawn above is drawn again."},
    "uniform": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2, "description": "Its ends."},
    "values": {"$ref": "#/definitions/values"}},
    "oneOf": [{"required": ["normal"]},
      {"required": ["uniform"], "not": {"anyOf": [{"required": ["low"]}, {"required": ["high"]}]}},
      {"required": ["values"], "not": {"anyOf": [{"required": ["low"]}, {"required": ["high"]}]}}]},
  "variation": {"anyOf": [{"$ref": "#/definitions/law"},
    {"type": "object", "additionalProperties": false, "required": ["times"], "properties": {
      "times": {"$ref": "#/definitions/law", "description": "A multiple of the value that the point has."}}}]},
  "objective": {"type": "object", "additionalProperties": false, "minProperties": 1, "maxProperties": 1, "properties": {
    "maximize": {"$ref": "#/definitions/expression"}, "minimize": {"$ref": "#/definitions/expression"}}}
})json";

constexpr const char* kStudyHead = R"json({
  "gaitlab_study": {"const": 1, "description": "Format version; by this key a file is known as a study."}
})json";

constexpr const char* kStudyRest = R"json({
  "scenarios": {"type": "object", "minProperties": 1, "maxProperties": 1000,
    "propertyNames": {"pattern": "^[A-Za-z0-9_.-]+$"}, "additionalProperties": {"$ref": "#/definitions/scalar"},
    "description": "Instead of scenario: several by name, in each of which every point runs."},
  "parameters": {"type": "object", "minProperties": 1, "additionalProperties": {"$ref": "#/definitions/parameter"},
    "description": "Keys of the scenario, as for --set, that change from point to point."},
  "replicates": {"type": "object", "additionalProperties": false, "required": ["count"],
    "description": "Runs of each point that differ in their seed and in what vary draws.", "properties": {
      "count": {"type": "integer", "minimum": 1, "maximum": 1000000, "description": "Runs of each point."},
      "vary": {"type": "object", "additionalProperties": {"$ref": "#/definitions/variation"},
        "description": "Keys of the scenario that are drawn, the same way for every point."},
      "combine": {"anyOf": [{"enum": ["mean", "worst", "median"]}, {"type": "string", "pattern": "^quantile\\(.+\\)$"}],
        "default": "worst", "description": "What the replicates of a point, in all its scenarios, count for together."}}},
  "objective": {"anyOf": [{"$ref": "#/definitions/objective"},
    {"type": "array", "minItems": 1, "maxItems": 3, "items": {"$ref": "#/definitions/objective"}}],
    "description": "What points are ordered by; of two or three, the points that no other is better than in all."},
  "constraints": {"type": "array", "items": {"$ref": "#/definitions/scalar"}, "default": [],
    "description": "What a point must keep: a <= b, a >= b or a == b."},
  "guards": {"anyOf": [{"enum": ["verdict", "none", "gait"]}, {"$ref": "#/definitions/guards"}], "default": "verdict",
    "description": "Checks of the verdict that a point must keep. verdict: the word feasible; checks by id are asked for beside it, or otherwise than it."},
  "stop": {"type": "array", "items": {"$ref": "#/definitions/scalar"}, "default": [],
    "description": "Rules that end a run early: EXPRESSION, or EXPRESSION after SECONDS."}
})json";

template <class Keys>
Json properties_of(Keys&& keys) {
  SchemaFields fields;
  keys.fields(fields);
  return fields.properties();
}

template <class Keys>
Json group_of(Keys&& keys, const char* about) {
  Json group = object_schema(properties_of(keys));
  group["description"] = about;
  return group;
}

Json parameter_schema() {
  Parameter parameter;
  Json properties = properties_of(RangeKeys{parameter, parameter.log});
  for (const char* key : {"low", "high", "count"}) properties[key].erase("default");
  properties["values"] = {{"$ref", "#/definitions/values"}};
  properties["sets"] = {{"type", "object"},
                        {"minProperties", 1},
                        {"additionalProperties", {{"type", {"string", "number"}}}},
                        {"description", "Keys of the scenario that follow this number of the study's own, by expressions."}};
  const auto needs = [](const char* key) { return Json{{"required", Json::array({key})}}; };
  Json schema = object_schema(std::move(properties));
  schema["oneOf"] = Json::array({{{"required", {"low", "high"}}, {"not", needs("values")}},
                                 {{"required", {"values"}}, {"not", {{"anyOf", {needs("low"), needs("high")}}}}}});
  return schema;
}

Json guards_schema(std::span<const CheckOffer> checks) {
  Json properties = Json::object();
  const Json margin{{"type", "object"},
                    {"additionalProperties", false},
                    {"required", {"margin"}},
                    {"properties", {{"margin", {{"type", "number"}}}}}};
  for (const CheckOffer& check : checks) {
    Json& schema = properties[check.id];
    schema["anyOf"] = Json::array({{{"type", "boolean"}}, margin});
    if (check.limited) schema["anyOf"].push_back({{"type", "number"}});
    schema["description"] = check.definition + (check.limited && !check.unit.empty() ? " (" + check.unit + ")" : "");
  }
  for (const std::string& old : old_guards()) properties[old] = {{"type", "number"}, {"description", "An old name."}};
  return object_schema(std::move(properties));
}

}  // namespace

std::string study_schema(std::span<const CheckOffer> checks) {
  Study study;
  std::string scenario;
  Json properties = Json::parse(kStudyHead);
  properties.update(properties_of(PlainKeys{study, scenario}));
  properties.update(Json::parse(kStudyRest));
  properties["figures"] = properties["quantities"];
  properties["figures"]["description"] = "Old name of quantities.";
  properties["method"] = group_of(MethodKeys{study}, "How points are chosen.");
  properties["budget"] = group_of(BudgetKeys{study.runs}, "How much is run.");
  properties["budget"]["properties"]["runs"].erase("default");
  properties["verify"] = group_of(VerifyKeys{study.verify}, "How gaitlab optimize tries the best points again.");
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"},
              {"title", "gaitlab study"},
              {"description", "Written by `gaitlab schema --study`."}};
  schema.update(object_schema(std::move(properties)));
  schema["required"] = Json::array({"gaitlab_study", "parameters"});
  schema["oneOf"] = Json::array({{{"required", {"scenario"}}}, {{"required", {"scenarios"}}}});
  schema["definitions"] = Json::parse(kStudyParts);
  schema["definitions"]["parameter"] = parameter_schema();
  schema["definitions"]["guards"] = guards_schema(checks);
  return schema.dump(1) + "\n";
}

}  // namespace gaitlab::studies
