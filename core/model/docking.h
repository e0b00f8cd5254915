// The rules of docking: which rows of a build file make a robot.
#pragma once
#include "core/model/robot.h"

namespace gaitlab {

/// The face with that id, or nullptr.
const FaceType* find_face(const ModuleType& type, int id);

/// Throws InputError with every row that breaks a rule (assemble lists them), but for overlapping cells.
void check_docks(const std::vector<ModuleType>& types, const std::vector<std::size_t>& type_of, const std::vector<Dock>& docks);

/// Throws InputError where two blocks of lattice types share a cell at zero angles.
void check_cells(const Robot& robot);

}  // namespace gaitlab
