// The JSON Schema of a study file, for editors. It is derived from the declared fields, and written by hand for the other keys.
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
    "description": "List of numbers or words, instead of low and high."},
  "law": {"type": "object", "additionalProperties": false, "properties": {
    "normal": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2, "description": "Mean and deviation."},
    "low": {"type": "number", "description": "Lower end of a normal distribution: values below are drawn again."},
    "high": {"type": "number", "description": "Upper end of a normal distribution: values above are drawn again."},
    "uniform": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2, "description": "Its ends."},
    "values": {"$ref": "#/definitions/values"}},
    "oneOf": [{"required": ["normal"]},
      {"required": ["uniform"], "not": {"anyOf": [{"required": ["low"]}, {"required": ["high"]}]}},
      {"required": ["values"], "not": {"anyOf": [{"required": ["low"]}, {"required": ["high"]}]}}]},
  "variation": {"anyOf": [{"$ref": "#/definitions/law"},
    {"type": "object", "additionalProperties": false, "required": ["times"], "properties": {
      "times": {"$ref": "#/definitions/law", "description": "A multiple of the point's value."}}}]},
  "objective": {"type": "object", "additionalProperties": false, "minProperties": 1, "maxProperties": 1, "properties": {
    "maximize": {"$ref": "#/definitions/expression"}, "minimize": {"$ref": "#/definitions/expression"}}}
})json";

constexpr const char* kStudyHead = R"json({
  "gaitlab_study": {"const": 1, "description": "Format version; this key marks a file as a study."}
})json";

constexpr const char* kStudyRest = R"json({
  "scenarios": {"type": "object", "minProperties": 1, "maxProperties": 1000,
    "propertyNames": {"pattern": "^[A-Za-z0-9_.-]+$"}, "additionalProperties": {"$ref": "#/definitions/scalar"},
    "description": "Several scenarios by name instead of scenario: every point runs in each."},
  "parameters": {"type": "object", "minProperties": 1, "additionalProperties": {"$ref": "#/definitions/parameter"},
    "description": "Keys of the scenario, as for --set, that change from point to point."},
  "replicates": {"type": "object", "additionalProperties": false, "required": ["count"],
    "description": "Runs of each point that differ in their seed and in the values that vary draws.", "properties": {
      "count": {"type": "integer", "minimum": 1, "maximum": 1000000, "description": "Runs of each point."},
      "vary": {"type": "object", "additionalProperties": {"$ref": "#/definitions/variation"},
        "description": "Keys of the scenario that are drawn, with equal draws for every point."},
      "combine": {"anyOf": [{"enum": ["mean", "worst", "median"]}, {"type": "string", "pattern": "^(quantile|share)\\(.+\\)$"}],
        "default": "worst", "description": "Combination of the replicates of a point, in all its scenarios, into one value."}}},
  "objective": {"anyOf": [{"$ref": "#/definitions/objective"},
    {"type": "array", "minItems": 1, "maxItems": 3, "items": {"$ref": "#/definitions/objective"}}],
    "description": "Order of the points; two or three: the Pareto front, the points that no other point beats in all objectives."},
  "constraints": {"type": "array", "items": {"$ref": "#/definitions/scalar"}, "default": [],
    "description": "Conditions that a point must satisfy: a <= b, a >= b or a == b."},
  "guards": {"anyOf": [{"enum": ["verdict", "none", "gait"]}, {"$ref": "#/definitions/guards"}], "default": "verdict",
    "description": "Checks of the verdict that a point must pass. verdict: the verdict must be feasible; checks by id are added to it or change it."},
  "stop": {"anyOf": [{"const": "none"}, {"type": "array", "items": {"$ref": "#/definitions/scalar"}}],
    "description": "Rules that end a run early: hopeless (a guard is lost; default of searches), EXPRESSION, or EXPRESSION after SECONDS."},
  "start": {"type": "array", "items": {"type": "object", "additionalProperties": {"$ref": "#/definitions/scalar"}}, "default": [],
    "description": "Points of the first block of a search, by parameter; a parameter that is left out has the scenario's value."}
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
  properties["sets"] = {
      {"type", "object"},
      {"minProperties", 1},
      {"additionalProperties", {{"type", {"string", "number"}}}},
      {"description", "Keys of the scenario that are computed from this parameter of the study, by expressions."}};
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
  return object_schema(std::move(properties));
}

}  // namespace

std::string study_schema(std::span<const CheckOffer> checks) {
  Study study;
  std::string scenario;
  Json properties = Json::parse(kStudyHead);
  properties.update(properties_of(PlainKeys{study, scenario}));
  properties.update(Json::parse(kStudyRest));
  properties["method"] = group_of(MethodKeys{study}, "Choice of the points.");
  properties["budget"] = group_of(BudgetKeys{study.runs}, "Number of runs.");
  properties["budget"]["properties"]["runs"].erase("default");
  properties["verify"] = group_of(VerifyKeys{study.verify}, "Verification of the best points by gaitlab optimize.");
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
