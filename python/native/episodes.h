// Simulations that Python steps.
#pragma once
#include <pybind11/pybind11.h>

namespace gaitlab::python {

/// Adds the class Episodes and the function start.
void add_episodes(pybind11::module_& m);

}  // namespace gaitlab::python
