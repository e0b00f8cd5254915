// Number of a scenario or module type whose plausibility is judged: its measurement, its usual range, and the units in which a
// number outside the range may have been given.
#pragma once
#include <functional>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/model/solid.h"
#include "core/scenario/scenario.h"
#include "report/analysis/cpg_alone.h"

namespace gaitlab::report {

/// Largest Kt / Ks or Ks / Kt without a warning. The two are one constant in SI units, and values measured on one motor agree
/// within 10 %.
inline constexpr double kConstantsApart = 1.3;

struct Warning {
  SourceLocation place;
  std::string text;
  bool severe = true;    ///< false: a note
  bool of_gait = false;  ///< the warning is on the scenario's own gait, which a study varies
};

/// A scenario, with results that several rows need and that take time to compute.
struct Subject {
  explicit Subject(const Scenario& s);
  const Scenario& scenario;
  /// Size of a body, by which its numbers are judged.
  struct Size {
    std::vector<Shape> shapes;  ///< shapes of the body, or a box about its points; empty if it has neither
    bool of_points = false;     ///< true for a box about contact elements, faces and hinges
    Solid solid = {};           ///< union of the shapes; volume 0 for a body without mass, or with too many shapes, and no
                                ///< moments if the body's inertia is that of its shapes
    [[nodiscard]] double largest_edge() const;
  };
  std::vector<std::vector<Size>> sizes;  ///< sizes by type and body
  /// Set points of the CPG alone, computed at the first call.
  [[nodiscard]] const std::vector<SetPointRange>& set_points() const;

 private:
  mutable std::optional<std::vector<SetPointRange>> set_points_ = {};
};

/// A mistake that may explain a number, such as a unit.
struct Slip {
  const char* question;               ///< `is the mass in g`
  double (*corrected)(double given);  ///< the given number without the mistake
  std::size_t input = 0;              ///< index in Finding::inputs of the number that was given
};

/// A number that was given, with its unit. Without a unit it is not shown.
struct GivenNumber {
  double value = 0;
  const char* unit = nullptr;
};

/// One measured number.
struct Finding {
  SourceLocation place;  ///< place of the value that is likely wrong
  /// Body `emerge/head`, joint `m0/hinge` or section `cpg` with the number, for PlausibleNumber::unless.
  std::vector<std::string> parts;
  std::string text;  ///< what was found, with the number
  double value = 0;  ///< the number that is compared with the range
  /// Measures the number again without a mistake. Empty if `corrected` applies to the number itself.
  std::function<double(const Slip&)> again = {};
  /// False for a mistake whose correction gives another implausible number, such as a length far below all others.
  std::function<bool(const Slip&)> sensible = {};
  std::vector<GivenNumber> inputs = {};
  std::string remedy = {};  ///< text that replaces the questions
};

/// A number that no robot can have.
struct Impossible {
  double times;      ///< the number over the largest possible one, above 1
  std::string text;  ///< the number, its part, and the reason why it is impossible
};

/// A row of the list of plausible numbers.
struct PlausibleNumber {
  const char* name;      ///< name of the row, for `unless`
  double least, most;    ///< the usual range
  const char* expected;  ///< the range and its reason in words
  std::vector<Slip> slips;
  /// Names or questions of rows above. A part is not judged if such a row was reported, or such a question printed, for it.
  std::vector<std::string_view> unless;
  std::vector<Finding> (*measure)(const Subject&);
  bool of_gait = false;  ///< a number of the scenario's own gait, which a study varies
  double likely = 0;     ///< least number that a correction may give; a smaller number is as implausible as the given one
  /// Numbers beyond a second, wider range, which prevent a verdict until they are corrected or accepted (kAcceptable). Null for
  /// a row with only one range.
  std::vector<Impossible> (*impossible)(const Scenario&) = nullptr;
};

/// Corrections of numbers that were given in thousandths, in hundredths, with the opposite sign, and so on.
inline double of_milli(double value) { return value * 1e-3; }
inline double of_centi(double value) { return value * 1e-2; }
inline double turned_round(double value) { return -value; }
inline double of_square_cm(double value) { return value * 1e-4; }       ///< for numbers in kg cm^2
inline double of_gram_square_cm(double value) { return value * 1e-7; }  ///< for numbers in g cm^2
inline double of_degrees(double value) { return value * std::numbers::pi / 180; }

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

inline constexpr double kGravity = 9.81;  ///< m/s^2, for ratios to a weight, regardless of physics.gravity

/// Least length that a correction may give, relative to a body's largest edge. A shorter length is as implausible as the given
/// one.
inline constexpr double kLeastShare = 0.02;

/// Least and largest coordinates of the contact elements, faces and hinges of a body, body frame, m. Least above largest if it
/// has none.
std::pair<Vec3, Vec3> box_of_points(const ModuleType& type, std::size_t body);

/// True if the robot can fall onto a ground that its contact elements touch.
bool stands(const Scenario& s);

/// The map of the joint's hinge in the text of its module type; nullptr if the text is not known.
const Node* hinge_map(const Scenario& s, std::size_t joint);
/// The entry of the list `key` of a module type whose `name` or `id` is `name`; nullptr if there is none.
const Node* entry_map(const Node& document, const char* key, const char* by, const std::string& name);

/// Rows on the bodies and faces of module types.
std::vector<PlausibleNumber> plausible_bodies();
/// Rows on motors and their modules.
std::vector<PlausibleNumber> plausible_motors();
/// Rows on docks and contacts with the ground.
std::vector<PlausibleNumber> plausible_contacts();
/// Rows on the sections of the scenario.
std::vector<PlausibleNumber> plausible_scenario();

}  // namespace gaitlab::report
