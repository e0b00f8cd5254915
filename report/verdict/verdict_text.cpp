// The verdict as a file and as lines.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/settings/wording.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

namespace {

nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

}  // namespace

const char* name_of(CheckStatus status) {
  switch (status) {
    case CheckStatus::pass:
      return "pass";
    case CheckStatus::warn:
      return "warn";
    case CheckStatus::fail:
      return "fail";
    case CheckStatus::too_close:
      return "too close";
    default:
      return "not judged";
  }
}

const char* name_of(CheckSpan span) { return span == CheckSpan::window ? "window" : "whole run"; }

const char* name_of(Part part) {
  switch (part) {
    case Part::joint:
      return "joint";
    case Part::body:
      return "body";
    case Part::dock:
      return "dock";
    case Part::foot:
      return "foot";
    default:
      return "none";
  }
}

const char* name_of(Word word) {
  switch (word) {
    case Word::feasible:
      return "feasible";
    case Word::infeasible:
      return "infeasible";
    case Word::failed:
      return "failed";
    default:
      return "not judged";
  }
}

std::string to_json(const Verdict& verdict) {
  using Json = nlohmann::ordered_json;
  Json json;
  json["format"] = 2;
  json["verdict"] = name_of(verdict.word);
  json["reason"] = verdict.reason;
  const Check* const tightest = verdict.tightest();
  json["tightest"] = tightest == nullptr ? Json() : Json(tightest->id);
  json["rests_on"] = verdict.rests_on;
  json["chosen_motors"] = verdict.chosen_motors;
  json["chosen_docks"] = verdict.chosen_docks;
  json["statistics"] = verdict.of_rows.empty() ? "all steps" : "rows";
  if (!verdict.of_rows.empty()) json["statistics_text"] = verdict.of_rows;
  json["window"] = {{"from", verdict.from}, {"to", verdict.to}};
  json["first"] = verdict.first_joint.empty() ? Json() : Json{{"joint", verdict.first_joint}, {"time", verdict.first_time}};
  Json counts;
  for (const CheckStatus status :
       {CheckStatus::pass, CheckStatus::warn, CheckStatus::fail, CheckStatus::too_close, CheckStatus::not_judged})
    counts[name_of(status)] = verdict.count(status);
  json["counts"] = counts;
  for (const Check& c : verdict.checks) {
    json["checks"].push_back({{"id", c.id},
                              {"group", c.group},
                              {"title", c.title},
                              {"status", name_of(c.status)},
                              {"span", name_of(c.span)},
                              {"can_fail", c.can_fail},
                              {"value", json_number(c.value)},
                              {"limit", json_number(c.limit)},
                              {"least", c.least},
                              {"unit", c.unit},
                              {"margin", json_number(c.margin)},
                              {"error", json_number(c.error)},
                              {"part", name_of(c.part)},
                              {"worst", c.worst.empty() ? Json() : Json(c.worst)},
                              {"parts", c.parts},
                              {"from", json_number(c.from)},
                              {"to", json_number(c.to)},
                              {"first", json_number(c.first)},
                              {"first_part", c.first_part.empty() ? Json() : Json(c.first_part)},
                              {"remedy", c.remedy},
                              {"missing", c.missing},
                              {"definition", c.definition},
                              {"source", c.source},
                              {"text", c.text}});
  }
  if (!verdict.demands.empty() || !verdict.demand_doubt.empty()) {
    Json& demand = json["demand"];
    demand["doubt"] = verdict.demand_doubt;
    demand["joints"] = Json::array();
    for (const JointDemand& d : verdict.demands) {
      demand["joints"].push_back({{"joint", d.joint},
                                  {"voltage", json_number(d.voltage)},
                                  {"current", json_number(d.current)},
                                  {"torque", json_number(d.torque)},
                                  {"speed", json_number(d.speed)}});
    }
  }
  return json.dump(2) + "\n";
}

std::vector<std::string> to_lines(const Verdict& verdict) {
  constexpr std::size_t kWidth = 64;
  const auto names = [&](CheckStatus status) {
    std::vector<std::string> ids;
    for (const Check& c : verdict.checks) {
      if (c.status == status) ids.push_back(c.id);
    }
    return fmt::format("{}", fmt::join(ids, ", "));
  };
  std::string text = name_of(verdict.word);
  if (const std::string why = verdict.why(); !why.empty()) text += ": " + why;
  if (verdict.word == Word::feasible) {
    text += " with these motors";
    if (!verdict.rests_on.empty()) text += ", over " + verdict.rests_on;
  }
  std::vector<std::string> lines;
  const auto wrap = [&](const std::string& whole) {
    const std::string broken = wrapped(whole, 0, kWidth);
    for (std::size_t at = 0; at < broken.size();) {
      const std::size_t end = std::min(broken.find('\n', at), broken.size());
      lines.push_back(broken.substr(at, end - at));
      at = end + 1;
    }
  };
  wrap(text);
  if (!verdict.demand_doubt.empty()) wrap("demand: " + verdict.demand_doubt);
  if (!verdict.of_rows.empty()) wrap(verdict.of_rows);
  if (verdict.chosen_motors) wrap("rests on chosen figures of the motors, not on a maker's");
  if (verdict.chosen_docks) wrap("rests on chosen figures of what docks hold");
  if (verdict.count(CheckStatus::fail) > 1) wrap("fails: " + names(CheckStatus::fail));
  if (verdict.count(CheckStatus::too_close) > 0) wrap("too close: " + names(CheckStatus::too_close));
  if (verdict.count(CheckStatus::warn) > 0) wrap("warns: " + names(CheckStatus::warn));
  if (verdict.count(CheckStatus::not_judged) > 0) wrap("not judged: " + names(CheckStatus::not_judged));
  return lines;
}

}  // namespace gaitlab::report
