// A study as the user wrote it: which points of a scenario are run, how often, and by what they are judged.
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

/// A key of the scenario that follows a number of the study's own.
struct Follower {
  std::string key;
  Text expression;  ///< over the parameters
  SourceLocation place = {};
};

/// What changes from point to point: a key of the scenario, or a number of the study's own, which keys follow.
struct Parameter {
  std::string key;                  ///< as for --set; of one's own: its name
  std::vector<std::string> values;  ///< given one by one; empty: low to high
  bool words = false;               ///< values that are not numbers
  double low = 0, high = 0;
  bool log = false;        ///< even in the logarithm
  std::int64_t count = 0;  ///< of a grid, from low to high; 0: drawn
  SourceLocation place = {};
  std::vector<Follower> sets = {};  ///< keys that follow it; none: it is one itself

  [[nodiscard]] bool in_grid() const { return !values.empty() || count > 0; }
};

/// A key of the scenario that changes from replicate to replicate, the same way for every point.
struct Variation {
  enum class Law { normal, uniform, values };
  std::string key;
  Law law = Law::uniform;
  double a = 0, b = 0;              ///< mean and deviation, or the ends
  std::optional<double> low, high;  ///< what is drawn beyond is drawn again
  bool times = false;               ///< of the value that the point has
  std::vector<std::string> values = {};
  bool words = false;  ///< values that are not numbers
  SourceLocation place = {};
};

enum class Combine { mean, worst, median, quantile };

struct Replicates {
  std::int64_t count = 0;  ///< 0: one, with the scenario's own seed
  std::vector<Variation> vary;
  Combine combine = Combine::worst;
  double quantile = 0.5;
  [[nodiscard]] std::uint64_t number() const { return count == 0 ? 1 : static_cast<std::uint64_t>(count); }
};

struct Objective {
  Text expression;  ///< empty: the first quantity that is shown
  bool maximize = true;
};
inline constexpr std::size_t kMostObjectives = 3;

/// A guard that the study names: a check of the verdict by its id.
struct Guard {
  enum class Asks { limit, margin, kept, nothing };
  std::string check;
  Asks asks = Asks::kept;  ///< limit: that `number` replaces the check's own; margin: of at least `number`; kept: of 0
  double number = 0;
  SourceLocation place = {};
};

/// A rule that ends a hopeless run: once this is true after so many s.
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

/// Whether it chooses points by what came out before (`gaitlab optimize`).
constexpr bool is_search(Method method) { return enum_row(method).searches; }

/// Of methods that are searches.
struct SearchKeys {
  std::int64_t population = 0;  ///< 0: by the number of parameters
  std::int64_t instances = 1;   ///< searches side by side
  std::int64_t restarts = 3;    ///< at most, of each
  double sigma = 0.25;          ///< first step of cma and xnes, as a share of the box
};

/// How the best points are tried again.
struct Verify {
  std::int64_t best = 3;  ///< how many
  bool halve_step = true;
  std::string engine = "none";
  double change = 0.02;  ///< of the objective, as a share: beyond it the point is not verified
  SourceLocation place = {};
};

/// One of several scenarios in which every point runs.
struct NamedScenario {
  std::string name, file;
};

struct Study {
  std::string name, file;                ///< file: of the study; empty: of the command line
  std::string scenario;                  ///< its file, where there is one
  std::vector<NamedScenario> scenarios;  ///< instead of it
  std::vector<std::string> sets;
  std::vector<SourceLocation> set_places;  ///< of a file
  std::int64_t seed = 1;
  std::vector<Parameter> parameters;
  Replicates replicates;
  std::vector<Objective> objectives{1};  ///< several: none is worth another
  std::vector<Text> constraints;
  bool guarded = true;         ///< by the verdict; false: by nothing
  std::vector<Guard> guards;   ///< beside the verdict, or otherwise than it
  std::vector<Problem> notes;  ///< old names, with what to write
  std::vector<StopText> stops;
  SourceLocation quantities_place{"--show"};
  std::vector<std::string> quantities;  ///< patterns: what is shown
  Method method = Method::grid;
  SearchKeys search;
  Verify verify;
  std::int64_t runs = 0;                           ///< budget of random and sobol; points times replicates
  std::int64_t trajectories = 20, samples = 1024;  ///< of morris; of sobol_indices
  /// Whether its points are those of a sensitivity study.
  [[nodiscard]] bool of_sensitivity() const { return method == Method::morris || method == Method::sobol_indices; }
  /// Runs of a point: its replicates in every scenario.
  [[nodiscard]] std::uint64_t runs_of_point() const { return std::max<std::size_t>(1, scenarios.size()) * replicates.number(); }
  std::int64_t estimate_every = 16;  ///< one point in so many has its torque error estimated; 0: none
  bool asked = false;                ///< points come from another program (`gaitlab evaluate`) instead of the method
};

}  // namespace studies
}  // namespace gaitlab
