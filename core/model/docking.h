// The rules of docking: which rows of a build file make a robot.
#pragma once
#include "core/model/robot.h"

namespace gaitlab {

/// The face with that id, or nullptr.
const FaceType* find_face(const ModuleType& type, int id);

/// Whether two faces of a type are one connector.
bool at_one_place(const FaceType& a, const FaceType& b);

/// The connectors of both faces by which a module is docked, its own first; empty: the face's type does not know it.
std::array<Connector, 2> connectors_at(const Robot& robot, std::size_t module);

/// Throws InputError with every row that breaks a rule (assemble lists them), but for overlapping cells.
void check_docks(const std::vector<ModuleType>& types, const std::vector<std::size_t>& type_of, const std::vector<Dock>& docks);

/// Throws InputError where two blocks of lattice types share a cell at zero angles.
void check_cells(const Robot& robot);

}  // namespace gaitlab
