// A study as written by the user: the points of a scenario to run, the number of runs, and the objectives.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/names.h"
#include "core/plugin/fields.h"
#include "studies/study/formula.h"
#include "studies/study/method.h"

namespace gaitlab {

namespace studies {

/// A key of the scenario that is computed from a free parameter of the study.
struct Follower {
  std::string key;
  FormulaText expression;  ///< expression over the parameters
  SourceLocation place = {};
};

/// A quantity that varies from point to point: a key of the scenario, or a free parameter from which keys are computed.
struct Parameter {
  std::string key;                  ///< key in the form of --set, or the name of a free parameter
  std::vector<std::string> values;  ///< listed values; empty if the values range from low to high
  bool words = false;               ///< true if the values are not numbers
  double low = 0, high = 0;
  bool log = false;        ///< true if values are evenly spaced in their logarithm
  std::int64_t count = 0;  ///< number of grid values from low to high; 0 if values are drawn
  SourceLocation place = {};
  std::vector<Follower> sets = {};  ///< keys computed from a free parameter; empty if `key` is a key of the scenario
  std::vector<SourceLocation> value_places = {};  ///< places of the listed values

  [[nodiscard]] bool in_grid() const { return !values.empty() || count > 0; }
};

/// A key of the scenario that is drawn anew for each replicate. Every point has the same draws.
struct Variation {
  enum class Law { normal, uniform, values };
  std::string key;
  Law law = Law::uniform;
  double a = 0, b = 0;              ///< mean and standard deviation of a normal law, or ends of a uniform law
  std::optional<double> low, high;  ///< limits of a draw; a draw outside is repeated
  bool times = false;               ///< true if the draw multiplies the point's value
  std::vector<std::string> values = {};
  bool words = false;  ///< true if the values are not numbers
  SourceLocation place = {};
};

/// `robust` is `share` with a further condition: the nominal run of each scenario breaks no limit. Only the key `robust: true`
/// selects it.
enum class Combine { mean, worst, median, quantile, share, robust };

struct Replicates {
  std::int64_t count = 0;  ///< 0 means one run with the seed of the scenario
  std::vector<Variation> vary;
  Combine combine = Combine::worst;
  double quantile = 0.5;  ///< argument of `quantile`, `share` and `robust`
  [[nodiscard]] bool has_argument() const { return combine >= Combine::quantile; }
  /// True if a point is kept only if none of its runs breaks a limit.
  [[nodiscard]] bool every_run_counts() const { return combine <= Combine::worst; }
  [[nodiscard]] std::uint64_t number() const { return count == 0 ? 1 : static_cast<std::uint64_t>(count); }
};

struct Objective {
  FormulaText expression;  ///< empty for the first quantity shown
  bool maximize = true;
};
inline constexpr std::size_t kMostObjectives = 3;

/// A guard named by the study: a check of the verdict by its id.
struct Guard {
  enum class Asks { limit, margin, kept, nothing };
  std::string check;
  /// With `limit`, `number` replaces the limit of the check. With `margin`, the least margin is `number`; with `kept` it is 0.
  /// With `nothing`, the check is not guarded.
  Asks asks = Asks::kept;
  double number = 0;
  SourceLocation place = {};
};

/// A rule that ends a run: `when` is an expression, or kHopeless, that is tested from `after` seconds on.
struct StopText {
  FormulaText when;
  double after = 0;  ///< s
};
/// The rule that ends a run which has lost a guard before its end; the default of searches.
inline constexpr const char* kHopeless = "hopeless";

}  // namespace studies

template <>
struct EnumNames<studies::Combine> {
  using enum studies::Combine;
  static constexpr EnumName<studies::Combine> kTable[] = {{mean, "mean"},         {worst, "worst"}, {median, "median"},
                                                          {quantile, "quantile"}, {share, "share"}, {robust, "robust"}};
};

namespace studies {

/// Settings of a search method.
struct SearchKeys {
  std::int64_t population = 0;  ///< 0 selects a size by the number of parameters
  std::int64_t instances = 1;   ///< number of searches side by side
  std::int64_t restarts = 3;    ///< largest number of restarts per search
  double sigma = 0.25;          ///< first step of methods with a step, as a share of each parameter's range
};

/// A point in the first block of a search, by values of parameters.
struct StartPoint {
  std::vector<std::pair<std::string, std::string>> values;  ///< parameter, and value in the form of --set
  SourceLocation place = {};
};

/// Faults in repeated runs of the winner: `none`, or `each` joint with a motor dead in turn.
enum class VerifyFaults { none, each };

/// Settings for the verification of the best points.
struct Verify {
  std::int64_t best = 3;  ///< number of points to verify
  bool halve_step = true;
  std::string engine = "none";
  double change = 0.02;  ///< largest relative change of an objective for which a point is verified
  bool worlds = true;    ///< true to run points in the worlds (studies/plan/worlds.h)
  double share = 0.75;   ///< least share of the worlds in which a verified point stands
  VerifyFaults faults = VerifyFaults::none;
  SourceLocation place = {};
};

/// One of several scenarios of a study. Every point runs in each of them.
struct NamedScenario {
  std::string name, file;
  SourceLocation place = {};  ///< place at which the study names the file
};

struct Study {
  std::string name, file;  ///< name of the study, and path of its file; the path is empty for a study from the command line
  std::string scenario;    ///< file of the scenario, if there is only one
  SourceLocation place;    ///< place for problems of the whole study: its file, or the option that changes it
  SourceLocation scenario_place = {};    ///< place at which the study names the scenario; empty if the command line names it
  std::vector<NamedScenario> scenarios;  ///< scenarios, if there are several
  std::vector<std::string> sets;
  std::vector<SourceLocation> set_places;  ///< places of settings that a study file contains
  std::int64_t seed = 1;
  std::vector<Parameter> parameters;
  Replicates replicates;
  bool robust = false;                   ///< true if the replicates of a point are its nominal run and its runs in the worlds
  std::vector<Objective> objectives{1};  ///< one, or several for a Pareto front
  std::vector<FormulaText> constraints;
  bool guarded = true;         ///< true if the checks of the verdict are guards; false for no guards
  std::vector<Guard> guards;   ///< guards that the study adds, or that replace checks of the verdict
  std::vector<Problem> notes;  ///< notes on files that hide shipped scenarios
  std::vector<StopText> stops;
  SourceLocation quantities_place{"--show"};
  std::vector<std::string> quantities;  ///< patterns for the names of the quantities to show
  Method method = Method::grid;
  SearchKeys search;
  std::vector<StartPoint> starts;
  Verify verify;
  std::int64_t runs = 0;  ///< budget of runs for methods that draw or search points: points times replicates
  std::int64_t trajectories = 20, samples = 1024;  ///< trajectories of morris, samples of sobol_indices
  /// True if the points are those of a sensitivity study.
  [[nodiscard]] bool of_sensitivity() const { return method == Method::morris || method == Method::sobol_indices; }
  /// Runs per point: replicates times scenarios.
  [[nodiscard]] std::uint64_t runs_of_point() const { return std::max<std::size_t>(1, scenarios.size()) * replicates.number(); }
  std::int64_t estimate_every = 16;  ///< the torque error is estimated for one point in this number; 0 disables the estimate
  bool asked = false;                ///< true if another program chooses the points (`gaitlab evaluate`)
  bool told = false;                 ///< true if another program gives the results (`gaitlab optimize --ask`)
};

}  // namespace studies
}  // namespace gaitlab
