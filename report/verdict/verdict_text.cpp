// Writer of verdict.json, the file of a verdict.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/verdict/verdict.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;

Json json_number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json json_of(const Check& c) {
  return {{"id", c.id},
          {"group", name_of(c.group)},
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
          {"text", c.text}};
}

Json json_of(const Draw& draw) {
  Json json{{"seed", draw.seed},
            {"verdict", name_of(draw.word)},
            {"torque_peak", json_number(draw.torque_peak)},
            {"torque_rms", json_number(draw.torque_rms)},
            {"distance", json_number(draw.distance)},
            {"margin", json_number(draw.margin)},
            {"fails", Json::array()}};
  for (const FailedCheck& failed : draw.failing)
    json["fails"].push_back({{"check", failed.check}, {"worst", failed.part.empty() ? Json() : Json(failed.part)}});
  return json;
}

Json draws_of(const Verdict& verdict) {
  Json draws{{"text", verdict.draws_text}, {"count", verdict.draws.size()}};
  draws["feasible"] = std::ranges::count(verdict.draws, Word::feasible, &Draw::word);
  for (const Draw& draw : verdict.draws) draws["each"].push_back(json_of(draw));
  return draws;
}

/// The failing checks by the time when a part was first beyond its limit.
Json events_of(const Verdict& verdict) {
  std::vector<const Check*> order;
  for (const Check* const check : verdict.failures()) {
    if (std::isfinite(check->first)) order.push_back(check);
  }
  std::ranges::stable_sort(order, {}, &Check::first);
  Json events = Json::array();
  for (const Check* const check : order) {
    const std::string& part = check->first_part.empty() ? check->worst : check->first_part;
    events.push_back({{"time", check->first}, {"check", check->id}, {"part", part.empty() ? Json() : Json(part)}});
  }
  return events;
}

Json demand_of(const Verdict& verdict) {
  Json demand;
  demand["doubt"] = verdict.demand_doubt;
  demand["joints"] = Json::array();
  for (const JointDemand& d : verdict.demands) {
    demand["joints"].push_back({{"joint", d.joint},
                                {"voltage", json_number(d.voltage)},
                                {"current", json_number(d.current)},
                                {"torque", json_number(d.torque)},
                                {"speed", json_number(d.speed)}});
  }
  if (const std::optional<SupplyDemand>& of = verdict.supply_demand) {
    demand["supply"] = {{"voltage", json_number(of->voltage)},
                        {"current_peak", json_number(of->current_peak)},
                        {"current_rms", json_number(of->current_rms)},
                        {"energy", json_number(of->energy)},
                        {"duration", json_number(of->duration)}};
  }
  return demand;
}

}  // namespace

std::string to_json(const Verdict& verdict) {
  Json json;
  json["format"] = 1;
  json["verdict"] = name_of(verdict.word);
  json["reason"] = verdict.reason.text;
  if (verdict.reason.code != ReasonCode::none) json["reason_code"] = name_of(verdict.reason.code);
  if (!verdict.reason.check.empty()) json["reason_check"] = verdict.reason.check;
  json["failures"] = Json::array();
  for (const Check* const check : verdict.failures()) json["failures"].push_back(check->id);
  if (!verdict.unstable.empty()) json["unstable"] = verdict.unstable;
  if (!verdict.retry.empty()) json["retry"] = verdict.retry;
  const Check* const tightest = verdict.tightest();
  json["decided_by"] = verdict.decided_by.empty() ? Json() : Json(verdict.decided_by);
  json["tightest"] = tightest == nullptr ? Json() : Json(tightest->id);
  json["rests_on"] = verdict.rests_on;
  json["chosen_motors"] = verdict.chosen_motors;
  json["chosen_docks"] = verdict.chosen_docks;
  json["figures"] = verdict.figures;
  json["window"] = {{"from", verdict.from}, {"to", verdict.to}};
  json["first"] = verdict.first_joint.empty() ? Json() : Json{{"joint", verdict.first_joint}, {"time", verdict.first_time}};
  json["events"] = events_of(verdict);
  Json counts;
  for (const CheckStatus status :
       {CheckStatus::pass, CheckStatus::warn, CheckStatus::fail, CheckStatus::too_close, CheckStatus::not_judged})
    counts[name_of(status)] = verdict.count(status);
  json["counts"] = counts;
  for (const Check& c : verdict.checks) {
    if (c.concerns) json["checks"].push_back(json_of(c));
  }
  if (!verdict.faults.empty()) json["faults"] = verdict.faults;
  if (!verdict.demands.empty() || !verdict.demand_doubt.empty() || verdict.supply_demand) json["demand"] = demand_of(verdict);
  if (verdict.without_friction) json["without_chosen_friction"] = name_of(*verdict.without_friction);
  if (!verdict.draws.empty()) json["draws"] = draws_of(verdict);
  return json.dump(2) + "\n";
}

}  // namespace gaitlab::report
