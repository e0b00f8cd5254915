// Many runs of a scenario as one table.
#pragma once
#include <pybind11/pybind11.h>

#include <vector>

#include "python/native/scenario.h"

namespace gaitlab::python {

/// Settings for simulating rollouts.
struct RolloutSettings {
  int threads = 1;
  std::size_t lanes = 0;            ///< as BatchSettings::lanes
  std::size_t estimate_every = 16;  ///< one in this number of rows has an estimate of the torque error, beginning with row 0;
                                    ///< 0: none
};

/// Simulates the scenario under each of `overrides`, with the bits of `gaitlab sweep`. `quantities` are the columns; the common
/// ones if empty. As in a study, rows without an estimate count as equally accurate; with fewer than three estimates all rows
/// are estimated, and if more than one estimate in ten is above 5 %, a warning is given. `progress` is None or is called with
/// the numbers of ended and of all rollouts. The result has the names, units and values (rows x columns, float64, NaN for
/// unknown), and lists of the outcome, verdict and message of each row. If the call was interrupted, `raised` is the exception,
/// and rows that have not ended have the outcome `not run`.
pybind11::dict roll_out(const PyScenario& scenario, const std::vector<Texts>& overrides, const Texts& quantities,
                        const RolloutSettings& settings, const pybind11::object& progress);

/// Names, units and meanings of the quantities that every run has (false) and of those that accept [JOINT] (true).
std::vector<std::vector<std::string>> quantity_texts(bool of_joints);

}  // namespace gaitlab::python
