#include "core/model/docking.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/model/kinematics.h"

namespace gaitlab {

const FaceType* find_face(const ModuleType& type, int id) {
  for (const FaceType& face : type.faces) {
    if (face.id == id) return &face;
  }
  return nullptr;
}

std::array<Connector, 2> connectors_at(const Robot& robot, std::size_t module) {
  const Module& child = robot.modules[module];
  std::array<Connector, 2> found;
  if (child.parent < 0) return found;
  const auto of = [&](std::size_t type, int id) {
    const FaceType* face = find_face(robot.types[type], id);
    const auto known = robot.types[type].connectors.find(face->connector);
    return known == robot.types[type].connectors.end() ? Connector() : known->second;
  };
  found[0] = of(child.type, child.dock.child_face);
  found[1] = of(robot.modules[static_cast<std::size_t>(child.parent)].type, child.dock.parent_face);
  return found;
}

namespace {

std::string face_list(const ModuleType& type, const Gender* only = nullptr) {
  std::string text;
  for (const FaceType& face : type.faces) {
    if (only == nullptr || face.gender == *only) text += (text.empty() ? "" : ", ") + std::to_string(face.id);
  }
  return text;
}

/// Faces of a type that dock with a face of gender `gender`.
std::string partners(const ModuleType& type, Gender gender) {
  const Gender other = gender == Gender::active ? Gender::passive : gender == Gender::passive ? Gender::active : Gender::none;
  return face_list(type, &other);
}

std::string in_marks(const std::string& name) { return name.empty() ? "none" : "'" + name + "'"; }

/// Allowed quarter turns of a face, as `0, 2`.
std::string turn_list(const FaceType& face) {
  std::string text;
  for (std::size_t turn = 0; turn < face.turns.size(); ++turn) {
    if (face.turns[turn]) text += (text.empty() ? "" : ", ") + std::to_string(turn);
  }
  return text;
}

/// Checks the rows of a build file, and reports one problem per row.
class DockRows {
 public:
  DockRows(const std::vector<ModuleType>& types, const std::vector<std::size_t>& type_of, const std::vector<Dock>& docks)
      : types_(types), type_of_(type_of), docks_(docks) {
    for (const Dock& dock : docks) children_.insert(dock.child_module);
  }

  void check() {
    for (const Dock& dock : docks_) check_row(dock);
    check_gaps();
    // Loops are checked only if there are no other problems, because a wrong row would look like a missing module or a loop.
    if (problems_.empty()) check_loops();
    problems_.raise();
  }

 private:
  [[nodiscard]] int modules() const { return static_cast<int>(type_of_.size()); }
  const ModuleType& type(int module) const { return types_[type_of_[static_cast<std::size_t>(module)]]; }

  const FaceType* check_face(const Dock& dock, int module, int face, const char* side) {
    if (module < 0 || module >= modules() || (module != 0 && !children_.contains(module))) {
      problems_.add(dock.place,
                    fmt::format("unknown {} module {}: it is neither module 0 nor the child of a row", side, module));
      return nullptr;
    }
    const FaceType* found = find_face(type(module), face);
    if (found == nullptr) {
      problems_.add(dock.place, fmt::format("module {} ({}) has no face {}: its faces are {}", module, type(module).name, face,
                                            face_list(type(module))));
    }
    return found;
  }

  void take_face(const Dock& dock, int module, int face) {
    const auto [at, fresh] = faces_.try_emplace({module, face}, &dock);
    if (fresh) return;
    problems_.add(dock.place, fmt::format("face {} of module {} is used twice: a face docks once", face, module))
        .notes.emplace_back(at->second->place, "this face is already docked here");
  }

  void check_row(const Dock& dock) {
    const FaceType* child = check_face(dock, dock.child_module, dock.child_face, "child");
    const FaceType* parent = check_face(dock, dock.parent_module, dock.parent_face, "parent");
    if (dock.orientation < 0 || dock.orientation > 3) {
      problems_.add(dock.place,
                    fmt::format("orientation {} is not a quarter turn: expected 0, 1, 2 or 3 (times pi/2)", dock.orientation));
    }
    if (child == nullptr || parent == nullptr) return;
    if (dock.child_module == dock.parent_module) {
      problems_.add(dock.place, fmt::format("loop: module {} is docked to itself", dock.child_module));
      return;
    }
    check_genders(dock, *child, *parent);
    check_connectors(dock, *child, *parent);
    take_face(dock, dock.child_module, dock.child_face);
    take_face(dock, dock.parent_module, dock.parent_face);
    if (dock.child_module == 0) {
      problems_.add(dock.place, closes_ring(dock)
                                    ? ring_text(dock)
                                    : "module 0 is the root and has no parent: number the root 0, or swap child and parent");
      return;
    }
    const auto [at, fresh] = parent_.try_emplace(dock.child_module, &dock);
    if (!fresh) {
      problems_
          .add(dock.place, closes_ring(dock) ? ring_text(dock)
                                             : fmt::format("module {} has two parents: {} and {}; docks form a tree",
                                                           dock.child_module, at->second->parent_module, dock.parent_module))
          .notes.emplace_back(at->second->place, "its first parent is given here");
    }
  }

  void check_genders(const Dock& dock, const FaceType& child, const FaceType& parent) {
    const bool alike = child.gender == parent.gender;
    if (child.gender == Gender::none || parent.gender == Gender::none ? alike : !alike) return;
    const std::string able = partners(type(dock.child_module), parent.gender);
    const std::string genders =
        alike ? fmt::format("face {} of module {} and face {} of module {} are both {}; active docks on passive",
                            dock.child_face, dock.child_module, dock.parent_face, dock.parent_module, name_of(child.gender))
              : fmt::format(
                    "face {} of module {} has gender {}, but face {} of module {} has gender {}; active docks on passive, and "
                    "none on none",
                    dock.child_face, dock.child_module, name_of(child.gender), dock.parent_face, dock.parent_module,
                    name_of(parent.gender));
    problems_.add(dock.place, fmt::format("wrong gender: {}, so module {} {}", genders, dock.child_module,
                                          able.empty() ? "has no face that fits" : fmt::format("could take face {}", able)));
  }

  void check_connectors(const Dock& dock, const FaceType& child, const FaceType& parent) {
    if (child.connector != parent.connector) {
      problems_.add(
          dock.place,
          fmt::format("face {} of module {} has connector {}, but face {} of module {} has {}; only faces with the same "
                      "connector dock",
                      dock.child_face, dock.child_module, in_marks(child.connector), dock.parent_face, dock.parent_module,
                      in_marks(parent.connector)));
    }
    if (dock.orientation < 0 || dock.orientation > 3) return;
    const auto turn = static_cast<std::size_t>(dock.orientation);
    for (const auto& [face, module] : {std::pair(&child, dock.child_module), std::pair(&parent, dock.parent_module)}) {
      if (face->turns[turn]) continue;
      problems_.add(dock.place, fmt::format("orientation {} is not one of the turns of face {} ({}): {}", dock.orientation,
                                            face->id, type(module).name, turn_list(*face)));
      break;
    }
  }

  static std::string ring_text(const Dock& dock) {
    return fmt::format(
        "this dock closes a ring: module {} and module {} are already connected by other docks; docks must form a tree, closed "
        "chains are not supported",
        dock.child_module, dock.parent_module);
  }

  /// True if docks between other pairs of modules, anywhere in the list, connect the two modules of `dock`. Only the first few
  /// calls test this, because a list that is wrong throughout is not a ring.
  [[nodiscard]] bool closes_ring(const Dock& dock) {
    constexpr int kAsked = 8;
    if (rings_asked_++ >= kAsked) return false;
    std::multimap<int, int> beside;
    for (const Dock& other : docks_) {
      if (std::minmax(other.child_module, other.parent_module) == std::minmax(dock.child_module, dock.parent_module)) continue;
      beside.emplace(other.child_module, other.parent_module);
      beside.emplace(other.parent_module, other.child_module);
    }
    std::set<int> reached{dock.child_module};
    std::vector<int> next{dock.child_module};
    while (!next.empty()) {
      const auto [from, to] = beside.equal_range(next.back());
      next.pop_back();
      for (auto at = from; at != to; ++at) {
        if (reached.insert(at->second).second) next.push_back(at->second);
      }
    }
    return reached.contains(dock.parent_module);
  }

  void check_gaps() {
    std::vector<int> missing;
    const int last = children_.empty() ? 0 : *children_.rbegin();
    for (int module = 1; module < last && missing.size() < 4; ++module) {
      if (!children_.contains(module)) missing.push_back(module);
    }
    if (missing.empty()) return;
    const auto row = std::find_if(docks_.begin(), docks_.end(), [&](const Dock& d) { return d.child_module == last; });
    problems_.add(row->place, fmt::format("gap in the numbering: there is a module {} but no module {}; modules are numbered "
                                          "0 to n-1",
                                          last, fmt::join(missing, ", ")));
  }

  void check_loops() {
    std::set<int> seen{0};
    for (const int module : children_) {
      std::vector<int> path;
      int at = module;
      for (; seen.insert(at).second; at = parent_.at(at)->parent_module) path.push_back(at);
      const auto loop = std::find(path.begin(), path.end(), at);
      if (loop == path.end()) continue;  // the path ended at module 0, or at modules seen before
      path.push_back(at);
      problems_.add(parent_.at(at)->place,
                    fmt::format("loop: modules {} are docked in a ring, but none of them to module 0",
                                fmt::join(std::vector<int>(std::find(path.begin(), path.end(), at), path.end()), " - ")));
    }
  }

  const std::vector<ModuleType>& types_;
  const std::vector<std::size_t>& type_of_;
  const std::vector<Dock>& docks_;
  int rings_asked_ = 0;
  std::map<std::pair<int, int>, const Dock*> faces_;  ///< occupied faces by module and face
  std::map<int, const Dock*> parent_;
  std::set<int> children_;
  Problems problems_;
};

/// Half of the cell size of a lattice type, from two faces of one body with different normals. Faces are half a cell from the
/// centre of the body.
double half_cell(const ModuleType& type) {
  for (const FaceType& a : type.faces) {
    for (const FaceType& b : type.faces) {
      const Vec3 n = a.normal - b.normal;
      if (a.body == b.body && n.squaredNorm() > 0.5) return (a.origin - b.origin).dot(n) / n.squaredNorm();
    }
  }
  return 0;
}

/// Half of the cell size of each type; 0 without a lattice.
std::vector<double> half_cells(const Robot& robot) {
  std::vector<double> half;
  for (const ModuleType& type : robot.types) half.push_back(type.lattice ? half_cell(type) : 0);
  return half;
}

/// Lattice of every module, identified by the first module of the lattice. This is the farthest module towards the root to
/// which all docks have equal cell sizes.
std::vector<std::size_t> lattices(const Robot& robot, const std::vector<double>& half) {
  const std::size_t unknown = robot.modules.size();
  std::vector<std::size_t> first(robot.modules.size(), unknown);
  std::vector<std::size_t> path;
  for (std::size_t module = 0; module < first.size(); ++module) {
    std::size_t at = module;
    for (path.clear(); first[at] == unknown; at = static_cast<std::size_t>(robot.modules[at].parent)) {
      path.push_back(at);
      const Module& own = robot.modules[at];
      const bool goes_on = own.parent >= 0 && half[robot.modules[static_cast<std::size_t>(own.parent)].type] == half[own.type];
      if (goes_on) continue;
      first[at] = at;
      break;
    }
    for (const std::size_t below : path) first[below] = first[at];
  }
  return first;
}

}  // namespace

void check_docks(const std::vector<ModuleType>& types, const std::vector<std::size_t>& type_of,
                 const std::vector<Dock>& docks) {
  DockRows(types, type_of, docks).check();
}

void check_cells(const Robot& robot) {
  const Kinematics kinematics = at_zero(robot);
  const std::vector<double> half_of_type = half_cells(robot);
  const std::vector<std::size_t> lattice_of = lattices(robot, half_of_type);
  Problems problems;
  std::map<std::pair<std::size_t, std::array<long, 3>>, const Body*> cells;
  for (const Body& body : robot.bodies) {
    const Module& module = robot.modules[body.module];
    const ModuleType& type = robot.types[module.type];
    const double half = half_of_type[module.type];
    const auto face =
        std::find_if(type.faces.begin(), type.faces.end(), [&](const FaceType& f) { return f.body == body.type; });
    if (face == type.faces.end() || !(half > 0)) continue;
    // Cells are counted from a block of the first module of the lattice, along the axes of the block.
    const std::size_t lattice = lattice_of[body.module];
    const FaceType& zero = robot.types[robot.modules[lattice].type].faces.front();
    const Body& origin = robot.bodies[robot.modules[lattice].first_body + zero.body];
    const Pose from{kinematics.R[origin.link] * origin.in_link.R,
                    kinematics.point(origin.link, origin.in_link * (zero.origin - half * zero.normal))};
    const Vec3 offset = from.inverse() * kinematics.point(body.link, body.in_link * (face->origin - half * face->normal));
    std::array<long, 3> cell{};
    for (int i = 0; i < 3; ++i) cell[static_cast<std::size_t>(i)] = std::lround(offset[i] / (2 * half));
    const auto [at, fresh] = cells.try_emplace({lattice, cell}, &body);
    if (fresh) continue;
    problems.add(module.dock.place, fmt::format("overlapping cells: {} and {} are in the same lattice cell at zero angles",
                                                at->second->name, body.name));
    break;  // further errors may result from this row, which also displaces all later modules
  }
  problems.raise();
}

}  // namespace gaitlab
