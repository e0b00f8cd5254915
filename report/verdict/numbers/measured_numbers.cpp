// Summary numbers of the comparison with a log of the real robot.
#include <fmt/format.h>

#include <cmath>
#include <deque>
#include <nlohmann/json.hpp>
#include <string>

#include "report/verdict/numbers/number_texts.h"
#include "report/verdict/numbers/numbers.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;
using R = const RunData&;
using Share = std::optional<double> JointLogErrors::*;

struct ErrorMeasure {
  double LogError::*number;
  const char* definition;
};
constexpr std::array<ErrorMeasure, kErrorNumbers.size()> kMeasures{
    {{&LogError::mae, "Mean magnitude of simulated - measured"},
     {&LogError::rms, "RMS of simulated - measured"},
     {&LogError::peak, "Largest magnitude of simulated - measured"}}};

struct LimitShare {
  Share share;
  const char* definition;
};
constexpr std::array<LimitShare, kLimitNumbers.size()> kShares{
    {{&JointLogErrors::at_limit,
      "Share of the rows of the log in which the simulated motor gets its whole supply, whatever its current"},
     {&JointLogErrors::measured_at_limit, "Share of the rows of the log with a duty of at least 0.999"}}};

Json known(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

double of_joint(R run, std::size_t joint, const std::function<std::optional<double>(const JointLogErrors&)>& of) {
  const JointLogErrors* const errors = run.summary.log ? run.summary.log->of(joint) : nullptr;
  return errors == nullptr ? std::nan("") : of(*errors).value_or(std::nan(""));
}

}  // namespace

std::vector<SummaryNumber> measured_numbers() {
  static std::deque<std::string> texts;  // keys and definitions, to which every list points
  const auto text = [](std::string one) { return texts.emplace_back(std::move(one)).c_str(); };
  std::vector<SummaryNumber> all;
  const auto add = [&](const std::string& key, const char* unit, const std::string& definition, auto value, auto of) {
    all.push_back({.key = text("measured." + key),
                   .unit = unit,
                   .definition = text(definition + "; mean of all joints that the log has."),
                   .value = value,
                   .if_known = true,
                   .compare = {static_cast<int>(260 + all.size())}});
    all.push_back({.key = text("per_joint.J.measured." + key),
                   .unit = unit,
                   .definition = text(definition + "."),
                   .of_joint = [of](R run, std::size_t joint) { return of_joint(run, joint, of); },
                   .if_known = true});
  };
  for (const LoggedKind& kind : logged_kinds()) {
    for (std::size_t i = 0; i < kMeasures.size(); ++i) {
      const ErrorMeasure& measure = kMeasures[i];
      add(
          fmt::format("{}.{}", kind.key, kErrorNumbers[i]), kind.unit,
          fmt::format("{} of the {}, over the rows of the log", measure.definition, kind.key),
          [of = kind.kind, number = measure.number](R run) {
            return run.summary.log ? known(run.summary.log->mean(of, number)) : Json();
          },
          [of = kind.kind, number = measure.number](const JointLogErrors& joint) {
            return joint.of(of) ? std::optional(*joint.of(of).*number) : std::nullopt;
          });
    }
  }
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    const LimitShare& one = kShares[i];
    add(
        kLimitNumbers[i], "", one.definition,
        [share = one.share](R run) { return run.summary.log ? known(run.summary.log->mean(share)) : Json(); },
        [share = one.share](const JointLogErrors& joint) { return joint.*share; });
  }
  return all;
}

}  // namespace gaitlab::report
