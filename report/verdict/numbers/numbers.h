// The list of summary numbers, from which summary.json, terminal output, `compare`, `swap`, goldens and the table in
// docs/numbers.md are generated. A new number requires one entry.
#pragma once
#include <algorithm>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "report/analysis/summary.h"

namespace gaitlab::report {

/// Data from which a summary number is computed: a completed run and its summary.
struct RunData {
  const Scenario& scenario;
  const Recording& record;
  const Summary& summary;
};

/// A summary number. Each output has a member here: `line` for the terminal, `compare`, `golden`, `swap`. It shows the numbers
/// whose `place` in this member is above 0, in ascending order of `place`, which differs from the order of the list.
struct SummaryNumber {
  /// Path in summary.json, separated by `.`. `J` represents the name of a joint; `x` and `y` are the elements of an array.
  const char* key = "";
  const char* unit = "";        ///< "" for a share, a count or a name
  const char* definition = "";  ///< sentence printed in docs/numbers.md
  bool words = false;           ///< the value is or can be a text, which calculations cannot use
  /// Computes the value, or null if it is not known. If one number of a group such as `torque_error` is null, the whole group
  /// is null.
  std::function<nlohmann::ordered_json(const RunData&)> value = {};
  std::function<double(const RunData&, std::size_t joint)> of_joint = {};  ///< replaces `value` for a number of each joint
  bool if_known = false;                                                   ///< left out of summary.json if it is not known
  bool list = false;                                                       ///< array or object, left out of tables
  bool clock = false;                                                      ///< measured by the clock, differs between runs

  struct Line {
    int place = 0;
    const char* title = nullptr;                                     ///< nullptr: the line starts at the left margin
    std::vector<std::string> (*text)(const RunData& run) = nullptr;  ///< lines of text; if empty, nothing is printed
  } line = {};
  struct Compare {
    int place = 0;                ///< position in the output; numbers of every joint are shown for the most loaded joint
    bool if_different = false;    ///< left out if runs A and B have equal values
    const char* label = nullptr;  ///< row title with unit; if nullptr, it is made from key and unit
  } compare = {};
  struct Golden {
    int place = 0;
    bool needs_motor = false;   ///< left out if no joint has a motor
    bool needs_travel = false;  ///< left out if the robot does not travel, because the number is then noise
  } golden = {};
  struct Swap {
    int place = 0;
    const char *head = "", *under = "";  ///< the two lines above the column
    int width = 0;                       ///< width of the column; negative if the text is aligned left
    std::string (*cell)(const RunData& run) = nullptr;
  } swap = {};

  /// JSON pointer to the number in summary.json. `joint` is the joint's name for a number of every joint, else empty.
  [[nodiscard]] std::string pointer(const std::string& joint = "") const;
  /// Name in a golden: the key, or for a joint `m0/active.torque.peak`.
  [[nodiscard]] std::string name(const std::string& joint = "") const;
  /// Row title in `compare`: `distance, m`, or `m0/active torque peak, N m`.
  [[nodiscard]] std::string row(const std::string& joint = "") const;
};

/// All summary numbers, in the order of summary.json.
const std::vector<SummaryNumber>& summary_numbers();
/// Sections of that list, in its order.
std::vector<SummaryNumber> run_numbers();
std::vector<SummaryNumber> joint_numbers();
std::vector<SummaryNumber> motion_numbers();
std::vector<SummaryNumber> measured_numbers();

/// JSON number, or null for NaN and infinity.
nlohmann::ordered_json or_null(double value);

/// Content of summary.json as a JSON object.
nlohmann::ordered_json numbers_json(const RunData& run);

/// Summary numbers that have a place in one output, in the order of that output: placed(&SummaryNumber::golden).
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

/// True if the robot has joints and an actuator. Otherwise torque, cost and tracking error are meaningless.
bool has_motors(const Scenario& scenario);
/// True if the scenario has an actuator and the recording contains joint statistics.
bool has_motors(const RunData& run);

}  // namespace gaitlab::report
