// Rules of docking, which the rows of a build file must satisfy.
#pragma once
#include "core/model/robot.h"

namespace gaitlab {

/// Face with the id `id`, or nullptr.
const FaceType* find_face(const ModuleType& type, int id);

/// Connectors of the two faces at the dock of a module, first the face of the module. A connector is empty if the type of the
/// module has no data for it.
std::array<Connector, 2> connectors_at(const Robot& robot, std::size_t module);

/// Throws InputError with every row that breaks a rule. assemble() lists the rules; check_cells() checks for overlapping cells.
void check_docks(const std::vector<ModuleType>& types, const std::vector<std::size_t>& type_of, const std::vector<Dock>& docks);

/// Throws InputError if two blocks of lattice types share a cell at zero angles.
void check_cells(const Robot& robot);

}  // namespace gaitlab
