// Pattern generators and controllers whose class is written in Python.
#pragma once
#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "core/plugin/catalog.h"

namespace gaitlab::python {

/// A number among the settings of a class.
struct NumberSetting {
  std::string key, unit, about;
  double value = 0, low = 0, high = 0;
};

/// Registers a class of kind cpg or controller for the catalogs that are made afterwards. `unit` is that of a controller's
/// command. A class with the same kind and name is replaced; scenarios that were read before keep it. Throws InputError if the
/// name is not that of a plugin, or belongs to a built-in plugin. Needs the interpreter's lock.
void add_class(Kind kind, const std::string& name, const std::string& unit, const pybind11::object& type,
               std::vector<NumberSetting> settings);

/// Number of calls of add_class so far.
std::size_t classes_added();

/// Adds all registered classes to a catalog, and returns classes_added(). Needs no lock of the interpreter.
std::size_t register_classes(Catalog& catalog);

}  // namespace gaitlab::python
