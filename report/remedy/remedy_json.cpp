#include <cmath>
#include <nlohmann/json.hpp>

#include "core/files/shallow_json.h"
#include "report/remedy/remedy_text.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json json_of(const RemedyRun& run) {
  if (!run.refused.empty()) return {{"verdict", "failed"}, {"margin", {}}, {"speed", {}}, {"weakest", run.refused}};
  return {{"verdict", name_of(run.word)},
          {"margin", number(run.margin)},
          {"speed", number(run.speed)},
          {"weakest", run.weakest},
          {"hardly_moves", run.still}};
}

Json json_of(const RemedyAnswer& answer, const RemedySettings& settings) {
  const double now = settings.value(*answer.key);
  Json json{{"setting", settings.name(*answer.key)},
            {"keys", settings.paths(*answer.key)},
            {"unit", answer.key->unit},
            {"direction", answer.up ? "up" : "down"},
            {"now", number(now)},
            {"changes_verdict", answer.crosses}};
  json["until"] = {{"factor", answer.until}, {"value", number(now * answer.until)}};
  if (!answer.refused.empty()) json["refused"] = answer.refused;
  if (answer.stopped) json["interrupted"] = true;
  if (!answer.crosses) return json;
  json["confirmed"] = answer.confirmed;
  json["factor"] = answer.factor;
  json["value"] = number(now * answer.factor);
  if (answer.run.simulated) json["run"] = json_of(answer.run);
  if (answer.beyond.simulated) json["beyond"] = json_of(answer.beyond);
  json["set"] = answer.sets;
  return json;
}

Json json_of(const RatingNeeded& rating) {
  return {{"check", rating.check}, {"part", rating.part}, {"setting", rating.setting}, {"rating", rating.rating},
          {"now", rating.now},     {"unit", rating.unit}, {"parts", rating.parts},     {"same", rating.same}};
}

Json json_of(const RemedyMap& map, const RemedySettings& settings) {
  Json json{{"factors", map.factors}};
  for (const RemedyKey& key : remedy_keys()) {
    const std::string name = key.name;
    if (name == "frequency" || name == "amplitude") json[name] = {{"now", number(settings.value(key))}, {"unit", key.unit}};
  }
  json["cells"] = Json::array();
  for (const RemedyRun& run : map.runs) json["cells"].push_back(json_of(run));
  return json;
}

// ---- remedy.json read, which may be damaged or forged

/// The value as a number, or null. Throws Json::type_error for another type.
Json number_or_null(const Json& json) { return json.is_null() ? Json() : Json(json.get<double>()); }

[[noreturn]] void refuse(const char* what) { throw Json::type_error::create(302, what, nullptr); }

Json shown_axis(const Json& axis) {
  return {{"now", number_or_null(axis.at("now"))}, {"unit", axis.at("unit").get<std::string>()}};
}

Json shown_cell(const Json& cell) {
  const std::string word = cell.at("verdict");
  if (!named<Word>(word)) refuse("verdict");
  return {{"verdict", word},
          {"margin", number_or_null(cell.at("margin"))},
          {"speed", number_or_null(cell.at("speed"))},
          {"weakest", cell.at("weakest").get<std::string>()}};
}

Json shown_map(const Json& map) {
  const std::vector<double> factors = map.at("factors");
  const Json& cells = map.at("cells");
  if (factors.empty() || cells.size() != factors.size() * factors.size()) refuse("cells");
  Json shown{
      {"factors", factors}, {"frequency", shown_axis(map.at("frequency"))}, {"amplitude", shown_axis(map.at("amplitude"))}};
  for (const Json& cell : cells) shown["cells"].push_back(shown_cell(cell));
  return shown;
}

}  // namespace

std::string to_json(const Remedy& remedy) {
  Json json{{"format", kFormat},
            {"scenario", remedy.scenario},
            {"verdict", name_of(remedy.finer.empty() ? remedy.word : Word::not_judged)},
            {"engine", remedy.engine},
            {"runs", remedy.runs},
            {"interrupted", remedy.interrupted}};
  if (!remedy.finer.empty()) json["finer"] = {{"set", remedy.finer}, {"verdict", name_of(remedy.word)}};
  json["text"] = Json::array();
  json["tones"] = Json::array();
  for (const ScreenLine& line : remedy_lines(remedy)) {
    json["text"].push_back(line.text);
    json["tones"].push_back(name_of(line.tone));
  }
  json["answers"] = Json::array();
  for (const RemedyAnswer& answer : remedy.answers) json["answers"].push_back(json_of(answer, remedy.settings));
  json["ratings"] = Json::array();
  for (const RatingNeeded& rating : remedy.ratings) json["ratings"].push_back(json_of(rating));
  json["ratings_suffice"] = remedy.ratings_suffice;
  json["not_tried"] = Json::array();
  for (const RemedyLack& lack : remedy.lacking)
    json["not_tried"].push_back({{"setting", remedy.settings.name(*lack.key)}, {"reason", lack.reason}});
  if (remedy.map) json["map"] = json_of(*remedy.map, remedy.settings);
  if (remedy.pair) {
    json["pair"] = {{"frequency", remedy.pair->frequency},
                    {"amplitude", remedy.pair->amplitude},
                    {"run", json_of(remedy.pair->run)},
                    {"set", remedy.pair->sets}};
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string shown_remedy(const std::string& text, const std::string& scenario_hash, Word word) try {
  const Json json = shallow_json(text);
  if (!json.is_object() || json.at("format") != kFormat || json.at("scenario") != scenario_hash ||
      json.at("verdict") != name_of(word))
    return "";
  Json shown{{"verdict", name_of(word)}, {"runs", json.at("runs").get<std::size_t>()}};
  shown["text"] = json.at("text").get<std::vector<std::string>>();
  shown["tones"] = Json::array();
  for (const std::string& tone : json.at("tones").get<std::vector<std::string>>()) {
    if (!named<Tone>(tone)) refuse("tones");
    shown["tones"].push_back(tone);
  }
  if (shown["tones"].size() != shown["text"].size()) refuse("tones");
  if (json.contains("map")) shown["map"] = shown_map(json["map"]);
  return shown.dump(-1, ' ', false, Json::error_handler_t::replace);
} catch (const Json::exception&) {
  return "";
}

}  // namespace gaitlab::report
