// Quantities of a run by name: summary numbers, `feasible`, and margins of the verdict's checks.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/recording/word.h"
#include "report/verdict/numbers/quantities.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

/// A quantity that a table of runs can have as a column.
struct QuantityText {
  std::string name, unit, meaning;
};

/// Quantities that every run has: the summary numbers (quantities.h), `feasible`, `margin`, and `margin.ID` for each check.
std::vector<QuantityText> common_quantities();
/// Numbers per joint, whose names accept [JOINT].
std::vector<QuantityText> quantities_of_joints();

/// A summary number by its name, `torque.peak` or `torque.peak[m3/active]`. Nothing if the robot does not have it.
std::optional<SummaryQuantity> find_quantity(const std::string& name, const Robot& robot);
/// Text of a quantity of this robot: a summary number, `feasible`, `margin`, `margin.ID` or `margin.ID[LIMIT]`. Nothing if the
/// name is unknown.
std::optional<QuantityText> describe_quantity(const std::string& name, const Robot& robot);

/// Value of the quantity `margin.ID` or `margin.ID[LIMIT]` for this check, which has that id; NaN for another name.
double margin_quantity(const std::string& name, const Check& check);

/// Result of a run: its quantities (NaN if not known), the word of its verdict, the reason for that word as a sentence, and the
/// id of the deciding check with its part. The last two are empty if no check decides.
struct MeasuredRun {
  std::vector<double> quantities;
  Word verdict = Word::not_judged;
  std::string why, check, part;
};

/// Function that computes the named quantities of a run, and the parts of the recording that it reads. An unknown quantity is
/// NaN. Runs of another robot have the quantities of their own joints. Several threads may call it at once.
struct RunMeasure {
  std::function<MeasuredRun(const Scenario&, const Recording&)> measured;
  Records reads;
};
RunMeasure run_measure(const std::vector<std::string>& names, const Robot& robot);

}  // namespace gaitlab::report
