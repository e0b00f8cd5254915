// Rules of docking: conditions for rows of a build file to form a robot.
#pragma once
#include "core/model/robot.h"

namespace gaitlab {

/// Face with that id, or nullptr.
const FaceType* find_face(const ModuleType& type, int id);

/// Whether two faces of a type are one connector.
bool at_one_place(const FaceType& a, const FaceType& b);

/// Connectors of both faces by which a module is docked, first the module's; empty: the face's type has no connector data.
std::array<Connector, 2> connectors_at(const Robot& robot, std::size_t module);

/// Throws InputError with every row that breaks a rule (assemble lists them), overlapping cells excepted.
void check_docks(const std::vector<ModuleType>& types, const std::vector<std::size_t>& type_of, const std::vector<Dock>& docks);

/// Throws InputError if two blocks of lattice types share a cell at zero angles.
void check_cells(const Robot& robot);

}  // namespace gaitlab
