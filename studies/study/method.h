// Methods of a study, which choose its points.
#pragma once
#include <cstdint>
#include <string>

#include "core/names.h"

namespace gaitlab {

namespace studies {

enum class Method { grid, random, sobol, morris, sobol_indices, scbo, cma_gp, cma, xnes, sade, pso, nsga2 };

/// Name and properties of a method.
struct MethodRow {
  Method value;
  const char* text;
  const char* about;            ///< text after the name in the manual
  bool searches = false;        ///< true if the method chooses points by previous results (`gaitlab optimize`)
  std::int64_t population = 0;  ///< least population of a search
  std::int64_t most = 10000;    ///< largest population
  std::int64_t multiple = 1;    ///< the population is a multiple of this number
  bool several = false;         ///< true for several objectives, false for one
  bool of_pagmo = true;         ///< true if the method is part of the library pagmo
  bool sigma = false;           ///< true if the method has a first step
};

}  // namespace studies

template <>
struct EnumNames<studies::Method> {
  using enum studies::Method;
  static constexpr studies::MethodRow kTable[] = {
      {grid, "grid", "every combination of values"},
      {random, "random", "points drawn at random"},
      {sobol, "sobol", "points drawn evenly by a Sobol sequence"},
      {morris, "morris", "importance of the parameters by elementary effects"},
      {sobol_indices, "sobol_indices", "importance of the parameters by shares of the variance"},
      {scbo, "scbo", "search by Gaussian processes in a trust region", true, 1, 1000, 1, false, false},
      {cma_gp, "cma_gp", "CMA-ES, whose points Gaussian processes choose from six times as many candidates", true, 5, 1000, 1,
       false, false, true},
      {cma, "cma", "CMA-ES", true, 5, 10000, 1, false, true, true},
      {xnes, "xnes", "exponential natural evolution strategy", true, 5, 10000, 1, false, true, true},
      {sade, "sade", "self-adaptive differential evolution", true, 7},
      {pso, "pso", "particle swarm", true, 5},
      {nsga2, "nsga2", "Pareto front of two or three objectives", true, 8, 10000, 4, true}};
};

namespace studies {

constexpr bool is_search(Method method) { return enum_row(method).searches; }

/// Names of all methods with their texts: `grid: every combination of values; random: ...`.
std::string methods_text();
/// Names of the searches for several objectives, or for one: `scbo, cma_gp, cma, xnes, sade or pso`.
std::string searches_text(bool several);

}  // namespace studies
}  // namespace gaitlab
