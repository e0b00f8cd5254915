// A study as written by the user: the points of a scenario to run, their number of runs, and their objectives.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/names.h"
#include "core/plugin/fields.h"
#include "studies/study/formula.h"

namespace gaitlab {

namespace studies {

/// A key of the scenario that is computed from a free parameter of the study.
struct Follower {
  std::string key;
  Text expression;  ///< over the parameters
  SourceLocation place = {};
};

/// A quantity that varies from point to point: a key of the scenario, or a free parameter from which keys are computed.
struct Parameter {
  std::string key;                  ///< as for --set; of a free parameter: its name
  std::vector<std::string> values;  ///< listed values; empty: low to high
  bool words = false;               ///< values that are not numbers
  double low = 0, high = 0;
  bool log = false;        ///< evenly spaced in the logarithm
  std::int64_t count = 0;  ///< number of values in a grid, from low to high; 0: drawn
  SourceLocation place = {};
  std::vector<Follower> sets = {};  ///< keys computed from it; empty: it is a key itself

  [[nodiscard]] bool in_grid() const { return !values.empty() || count > 0; }
};

/// A key of the scenario that is drawn anew for each replicate, with the same draws for every point.
struct Variation {
  enum class Law { normal, uniform, values };
  std::string key;
  Law law = Law::uniform;
  double a = 0, b = 0;              ///< mean and deviation, or the ends
  std::optional<double> low, high;  ///< draws outside are repeated
  bool times = false;               ///< as a factor on the point's value
  std::vector<std::string> values = {};
  bool words = false;  ///< values that are not numbers
  SourceLocation place = {};
};

enum class Combine { mean, worst, median, quantile };

struct Replicates {
  std::int64_t count = 0;  ///< 0: one, with the scenario's seed
  std::vector<Variation> vary;
  Combine combine = Combine::worst;
  double quantile = 0.5;
  [[nodiscard]] std::uint64_t number() const { return count == 0 ? 1 : static_cast<std::uint64_t>(count); }
};

struct Objective {
  Text expression;  ///< empty: the first quantity shown
  bool maximize = true;
};
inline constexpr std::size_t kMostObjectives = 3;

/// A guard named by the study: a check of the verdict by its id.
struct Guard {
  enum class Asks { limit, margin, kept, nothing };
  std::string check;
  Asks asks = Asks::kept;  ///< limit: `number` replaces the check's limit; margin: at least `number`; kept: at least 0
  double number = 0;
  SourceLocation place = {};
};

/// A rule that ends a hopeless run: if this is true after `after` seconds.
struct StopText {
  Text when;
  double after = 0;  ///< s
};

enum class Method { grid, random, sobol, morris, sobol_indices, cma, xnes, sade, pso, nsga2 };

}  // namespace studies

template <>
struct EnumNames<studies::Combine> {
  using enum studies::Combine;
  static constexpr EnumName<studies::Combine> kTable[] = {
      {mean, "mean"}, {worst, "worst"}, {median, "median"}, {quantile, "quantile"}};
};

template <>
struct EnumNames<studies::Method> {
  struct Row {
    studies::Method value;
    const char* text;
    bool searches;
  };
  using enum studies::Method;
  static constexpr Row kTable[] = {{grid, "grid", false},
                                   {random, "random", false},
                                   {sobol, "sobol", false},
                                   {morris, "morris", false},
                                   {sobol_indices, "sobol_indices", false},
                                   {cma, "cma", true},
                                   {xnes, "xnes", true},
                                   {sade, "sade", true},
                                   {pso, "pso", true},
                                   {nsga2, "nsga2", true}};
};

namespace studies {

/// Whether the method chooses points by previous results (`gaitlab optimize`).
constexpr bool is_search(Method method) { return enum_row(method).searches; }

/// Keys of methods that are searches.
struct SearchKeys {
  std::int64_t population = 0;  ///< 0: depends on the number of parameters
  std::int64_t instances = 1;   ///< searches side by side
  std::int64_t restarts = 3;    ///< largest number, per search
  double sigma = 0.25;          ///< first step of cma and xnes, as a share of the box
};

/// Settings for the verification of the best points.
struct Verify {
  std::int64_t best = 3;  ///< number of points
  bool halve_step = true;
  std::string engine = "none";
  double change = 0.02;  ///< of the objective, relative: with a larger change the point is not verified
  SourceLocation place = {};
};

/// One of several scenarios; every point runs in each.
struct NamedScenario {
  std::string name, file;
};

struct Study {
  std::string name, file;                ///< file: of the study; empty: from the command line
  std::string scenario;                  ///< file of the only scenario
  std::vector<NamedScenario> scenarios;  ///< several scenarios instead
  std::vector<std::string> sets;
  std::vector<SourceLocation> set_places;  ///< of settings in a file
  std::int64_t seed = 1;
  std::vector<Parameter> parameters;
  Replicates replicates;
  std::vector<Objective> objectives{1};  ///< several: for a Pareto front
  std::vector<Text> constraints;
  bool guarded = true;         ///< by the verdict; false: no guards
  std::vector<Guard> guards;   ///< in addition to the verdict, or replacing its checks
  std::vector<Problem> notes;  ///< old names, with their replacements
  std::vector<StopText> stops;
  SourceLocation quantities_place{"--show"};
  std::vector<std::string> quantities;  ///< patterns of the quantities to show
  Method method = Method::grid;
  SearchKeys search;
  Verify verify;
  std::int64_t runs = 0;                           ///< budget of random and sobol: points times replicates
  std::int64_t trajectories = 20, samples = 1024;  ///< of morris; of sobol_indices
  /// Whether the points are those of a sensitivity study.
  [[nodiscard]] bool of_sensitivity() const { return method == Method::morris || method == Method::sobol_indices; }
  /// Runs per point: its replicates in every scenario.
  [[nodiscard]] std::uint64_t runs_of_point() const { return std::max<std::size_t>(1, scenarios.size()) * replicates.number(); }
  std::int64_t estimate_every = 16;  ///< the torque error is estimated for one point in this number; 0: none
  bool asked = false;                ///< points come from another program (`gaitlab evaluate`) instead of the method
};

}  // namespace studies
}  // namespace gaitlab
