#include "report/verdict/numbers/numbers.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

namespace gaitlab::report {

namespace {

constexpr std::string_view kOfJoint = "per_joint.J.";

std::vector<SummaryNumber> all_numbers() {
  std::vector<SummaryNumber> all = run_numbers();
  for (const auto& part : {joint_numbers(), motion_numbers(), measured_numbers()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

nlohmann::ordered_json or_null(double value) { return std::isfinite(value) ? nlohmann::ordered_json(value) : nullptr; }

std::string SummaryNumber::pointer(const std::string& joint) const {
  nlohmann::json::json_pointer path;
  for (std::string_view rest = key; !rest.empty();) {
    const std::string_view part = rest.substr(0, rest.find('.'));
    path /= part == "J" ? joint : part == "x" ? "0" : part == "y" ? "1" : std::string(part);
    rest.remove_prefix(std::min(part.size() + 1, rest.size()));
  }
  return path.to_string();
}

std::string SummaryNumber::name(const std::string& joint) const {
  return of_joint == nullptr ? key : joint + "." + (key + kOfJoint.size());
}

std::string SummaryNumber::row(const std::string& joint) const {
  std::string words = of_joint == nullptr ? key : key + kOfJoint.size();
  std::replace_if(
      words.begin(), words.end(), [](char c) { return c == '_' || c == '.'; }, ' ');
  if (*unit != '\0') words += std::string(", ") + unit;
  if (compare.label != nullptr) words = compare.label;
  return of_joint == nullptr ? words : joint + " " + words;
}

const std::vector<SummaryNumber>& summary_numbers() {
  static const std::vector<SummaryNumber> kAll = all_numbers();
  return kAll;
}

bool has_motors(const RunData& run) { return run.scenario.actuator.entry != nullptr && !run.record.joints.empty(); }

bool has_motors(const Scenario& scenario) { return scenario.actuator.entry != nullptr && !scenario.robot->joints.empty(); }

}  // namespace gaitlab::report
