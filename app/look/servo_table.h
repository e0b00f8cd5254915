// Manual of a servo: a table of its numbers with their sources.
#pragma once
#include <string>

#include "core/plugin/catalog.h"

namespace gaitlab::app {

/// Line, friction, rotor and firmware of the servo in a file. Each number has the word `data sheet`, `identified` or `chosen`,
/// and the number of its source in the list below the table. `about`: text above the table. Throws InputError if the file is
/// wrong, and PluginError.
std::string servo_table(const std::string& path, const std::string& about, const Catalog& catalog);

/// Line of a servo in lists: `head`, the origin of its numbers, and their error. Throws InputError if the file is wrong.
std::string servo_row(const std::string& path, const std::string& head);

}  // namespace gaitlab::app
