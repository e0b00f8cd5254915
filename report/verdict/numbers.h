// The list of summary numbers, from which summary.json, the terminal, `compare`, `swap`, goldens and the table in
// docs/conventions.md are generated. A new number is one entry.
#pragma once
#include <algorithm>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "report/analysis/summary.h"

namespace gaitlab::report {

/// Input of summary numbers: a run that has ended, and its summary.
struct RunData {
  const Scenario& scenario;
  const Recording& record;
  const Summary& summary;
};

/// A summary number. The terminal, `compare`, goldens and `swap` show those whose `place` there is above 0, in ascending order
/// of `place`, which differs from the list's.
struct SummaryNumber {
  /// Path in summary.json, separated by `.`: `J` represents the name of every joint; `x` and `y` are the elements of an array.
  const char* key = "";
  const char* unit = "";        ///< "": a share, a count, a name
  const char* definition = "";  ///< as in docs/conventions.md
  bool words = false;           ///< a text, or possibly one: not for calculations
  /// null: not known. A group (`torque_error`) with a null number is null.
  std::function<nlohmann::ordered_json(const RunData&)> value = {};
  std::function<double(const RunData&, std::size_t joint)> of_joint = {};  ///< replaces `value` for numbers of every joint
  bool list = false;                                                       ///< an array or an object: not for a cell of a table
  bool clock = false;                                                      ///< depends on the clock: differs between equal runs

  struct Line {
    int place = 0;
    const char* title = nullptr;                                     ///< nullptr: flush left
    std::vector<std::string> (*text)(const RunData& run) = nullptr;  ///< one per line; empty: not printed
  } line = {};
  struct Compare {
    int place = 0;                ///< a number of every joint is compared for the most loaded joint
    bool if_different = false;    ///< left out if A and B are equal
    const char* label = nullptr;  ///< with unit; nullptr: made from key and unit
  } compare = {};
  struct Golden {
    int place = 0;
    bool needs_motor = false;   ///< left out if no joint has a motor
    bool needs_travel = false;  ///< left out if the robot does not travel: a share of noise
  } golden = {};
  struct Swap {
    int place = 0;
    const char *head = "", *under = "";  ///< the two lines above the column
    int width = 0;                       ///< negative: flush left
    std::string (*cell)(const RunData& run) = nullptr;
  } swap = {};

  /// JSON pointer to the number in summary.json. joint: a name, for a number of every joint.
  [[nodiscard]] std::string pointer(const std::string& joint = "") const;
  /// Name in a golden: the key, or `m0/active.torque.peak`.
  [[nodiscard]] std::string name(const std::string& joint = "") const;
  /// Row title in `compare`: `distance, m`, or `m0/active torque peak, N m`.
  [[nodiscard]] std::string row(const std::string& joint = "") const;
};

/// All numbers, in the order of summary.json.
const std::vector<SummaryNumber>& summary_numbers();

/// The object of summary.json.
nlohmann::ordered_json numbers_json(const RunData& run);

/// Numbers with a place in one output, in its order: placed(&SummaryNumber::golden).
template <class Shown>
std::vector<const SummaryNumber*> placed(Shown SummaryNumber::*shown) {
  std::vector<const SummaryNumber*> found;
  for (const SummaryNumber& number : summary_numbers()) {
    if ((number.*shown).place > 0) found.push_back(&number);
  }
  std::stable_sort(found.begin(), found.end(),
                   [&](const auto* a, const auto* b) { return (a->*shown).place < (b->*shown).place; });
  return found;
}

/// Whether any joint has a motor: otherwise torque, cost and tracking error have no meaning.
bool has_motors(const Scenario& scenario);
/// The same for a run, and whether its statistics are known.
bool has_motors(const RunData& run);

}  // namespace gaitlab::report
