// Keys of a study that are declared as fields, from which reader, manual and schema are derived.
#pragma once
#include <array>
#include <string>

#include "core/plugin/fields.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// Top-level keys of a study file.
struct PlainKeys {
  Study& study;
  std::string& scenario;
  void fields(Fields& f) const {
    f.text("name", study.name, "Name of the study; default: the file's name.");
    f.text("scenario", scenario,
           "Scenario file, relative to this file, or a name of `gaitlab list scenarios`; or `scenarios`.");
    f.texts("set", study.sets, "Settings of all runs, as for --set: physics.step=0.001.");
    f.integer("seed", study.seed, {"", 0, 9e15, "Seed of the random numbers: points and replicates."});
    f.flag("robust", study.robust,
           "Run every point as it is and in the worlds of `verify`, as replicates; at least three quarters of these runs must "
           "break no limit.");
    f.integer("estimate_every", study.estimate_every,
              {"", 0, 1e9,
               "The torque error is estimated for one point in this number, drawn by the seed, in additional lanes; 1: for all "
               "points, 0: for none. The best points, which `gaitlab optimize` verifies, always have an estimate."});
    f.texts("quantities", study.quantities,
            "Quantities of a run that tables and figures show, by name with * and ?; default: the speed. A quantity of one "
            "joint, torque.peak[m3/*], becomes a column.");
  }
};

/// Manual of `method.type`.
inline const std::string kMethodsText =
    methods_text() +
    ". Default of `gaitlab optimize`: scbo for one objective, up to 10 parameters and a budget up to 2000; cma_gp above; nsga2 "
    "for several objectives.";

struct MethodKeys {
  Study& study;
  void fields(Fields& f) {
    f.choice("type", study.method, enum_names<Method>(), kMethodsText.c_str());
    f.integer("trajectories", study.trajectories,
              {"", 2, 1e6, "Trajectories of morris; each has one point more than there are parameters."});
    f.integer(
        "samples", study.samples,
        {"", 2, 1e7, "Samples of sobol_indices, preferably a power of 2; each has two points more than there are parameters."});
    f.integer("population", study.search.population,
              {"", 0, 10000,
               "Points of a generation, at least 5 (scbo 1, sade 7; nsga2: a multiple of 4, at least 8). 0: 4 + 3 ln n for n "
               "parameters, rounded up to a multiple of 8, at least 16."});
    f.integer("instances", study.search.instances, {"", 1, 1000, "Searches side by side, which share the budget."});
    f.integer("restarts", study.search.restarts,
              {"", 0, 10, "Restarts of a search that has converged, each with twice the population."});
    f.number("sigma", study.search.sigma,
             {"", 1e-3, 1, "Initial step of cma_gp, cma and xnes, as a share of the parameter ranges."});
  }
};

struct VerifyKeys {
  Verify& verify;
  void fields(Fields& f) {
    f.integer(
        "best", verify.best,
        {"", 1, 100,
         "Number of best points to verify. If none is verified, the next best points follow, up to four times this number."});
    f.flag("halve_step", verify.halve_step,
           "Simulate the best points again with half the step (with half of physics.accuracy if the integrator chooses its "
           "steps).");
    f.text("engine", verify.engine,
           "Simulate the best points again in this engine, with its default step; `none`: in no other engine.");
    f.number("change", verify.change,
             {"", 1e-6, 10, "Largest relative change of an objective for which a point counts as verified."});
    f.flag(
        "worlds", verify.worlds,
        "Simulate the best points again in up to 20 worlds: friction, R, Kt, mass, supply, and gear friction and rotor inertia "
        "where they are chosen, changed one by one to an end of their usual errors, then all drawn within tolerances; gears "
        "always `directional`.");
    f.number("share", verify.share, {"", 0, 1, "Least share of the worlds in which a verified point breaks no limit."});
    static constexpr std::array kFaults{"none", "each"};
    f.choice(
        "faults", verify.faults, kFaults,
        "`each`: simulate the winner again with each joint dead in turn, from t = 0; the results are printed, not ranked.");
  }
};

struct BudgetKeys {
  std::int64_t& runs;
  void fields(Fields& f) {
    f.integer("runs", runs, {"", 1, 1e9, "Runs of methods that draw or search points, including replicates."});
  }
};

inline constexpr std::array<const char*, 2> kScales{"linear", "log"};
inline constexpr double kAny = 1e300;

/// Keys of a parameter with a range.
struct RangeKeys {
  Parameter& parameter;
  bool& log;
  void fields(Fields& f) {
    f.number("low", parameter.low, {"", -kAny, kAny, "Least value, in the unit of the scenario's key."});
    f.number("high", parameter.high, {"", -kAny, kAny, "Largest value."});
    int scale = log ? 1 : 0;
    f.choice("scale", scale, kScales, "Spacing of the values: even (linear), or even in their logarithm (log).");
    log = scale == 1;
    f.integer("count", parameter.count, {"", 2, 1e9, "Number of values of a grid from low to high, both included."});
  }
};

}  // namespace gaitlab::studies
