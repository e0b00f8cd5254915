#include "core/robot_files/module_check.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "core/model/docking.h"
#include "core/model/possible_inertia.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

constexpr double kRelative = 1e-6;  // relative tolerance of hand-written numbers, for right angles

const SourceLocation& place_of(const Node& map, const char* key) {
  const Node* value = map.find(key);
  return value == nullptr ? map.place : value->place;
}

/// Normalises a direction. Returns false, with a problem, for a zero vector.
bool normalise(Vec3& v, const Node& map, const char* key, Problems& problems) {
  const double norm = v.stableNorm();
  if (!(norm > 0)) {
    problems.add(place_of(map, key), fmt::format("{} has length 0; expected a direction", key));
    return false;
  }
  v /= norm;
  return true;
}

/// True if two faces of a type are the same connector: one body, origin and normal.
bool at_one_place(const FaceType& a, const FaceType& b) {
  constexpr double kSame = 1e-9;  // in m, or for unit vectors; far above the rounding of written numbers
  return a.body == b.body && (a.origin - b.origin).squaredNorm() < kSame * kSame &&
         (a.normal - b.normal).squaredNorm() < kSame * kSame;
}

class ModuleCheck {
 public:
  ModuleCheck(ModuleType& type, const ModulePlaces& places, Problems& problems)
      : type_(type), places_(places), problems_(problems) {}

  void run() {
    check_tree();
    for (std::size_t i = 0; i < type_.bodies.size(); ++i) check_body(i);
    check_hinges();
    check_faces();
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  [[nodiscard]] const std::string& body(std::size_t index) const { return type_.bodies[index].name; }

  void check_tree() {
    parent_.assign(type_.bodies.size(), kNone);
    is_parent_.assign(type_.bodies.size(), false);
    for (std::size_t i = 0; i < type_.hinges.size(); ++i) add_edge(i);
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < parent_.size(); ++i) {
      if (parent_[i] == kNone) roots.push_back(i);
    }
    if (roots.empty()) {
      problems_.add(places_.bodies[0],
                    "every body is the child of a hinge, so that the hinges form a loop; expected one root body");
      return;
    }
    type_.root = roots[0];
    for (std::size_t i = 1; i < roots.size(); ++i) {
      Problem& problem = problems_.add(
          places_.bodies[roots[i]],
          fmt::format("body '{}' is not connected to '{}' by a hinge; expected one tree", body(roots[i]), body(roots[0])));
      problem.notes.emplace_back(places_.bodies[roots[0]], fmt::format("'{}' is the root: no hinge's child", body(roots[0])));
    }
    check_loops();
  }

  void add_edge(std::size_t index) {
    const HingeType& hinge = type_.hinges[index];
    const Node& map = places_.hinges[index];
    if (hinge.parent == hinge.child) {
      problems_.add(place_of(map, "child"), fmt::format("hinge '{}' joins body '{}' to itself", hinge.name, body(hinge.child)));
      return;
    }
    is_parent_[hinge.parent] = true;
    if (parent_[hinge.child] == kNone) {
      parent_[hinge.child] = index;
      return;
    }
    const std::size_t first = parent_[hinge.child];
    Problem& problem = problems_.add(place_of(map, "child"),
                                     fmt::format("body '{}' is the child of two hinges, '{}' and '{}'; expected one tree",
                                                 body(hinge.child), type_.hinges[first].name, hinge.name));
    problem.notes.emplace_back(place_of(places_.hinges[first], "child"), "the first is here");
  }

  /// Reports bodies in a loop, without a chain of hinges to the root.
  void check_loops() {
    enum class State : char { unknown, walking, rooted, looping };
    std::vector<State> state(parent_.size(), State::unknown);
    for (std::size_t start = 0; start < parent_.size(); ++start) {
      std::vector<std::size_t> path;
      std::size_t i = start;
      while (state[i] == State::unknown) {
        state[i] = State::walking;
        path.push_back(i);
        if (parent_[i] == kNone) break;
        i = type_.hinges[parent_[i]].parent;
      }
      const bool fresh_loop = state[i] == State::walking && parent_[i] != kNone;
      const State end = fresh_loop || state[i] == State::looping ? State::looping : State::rooted;
      for (const std::size_t step : path) state[step] = end;
      if (fresh_loop)
        problems_.add(places_.bodies[i], fmt::format("body '{}' is part of a loop of hinges; expected one tree", body(i)));
    }
  }

  void check_body(std::size_t index) {
    const BodyType& b = type_.bodies[index];
    const SourceLocation& place = places_.bodies[index];
    if (b.mass > 0) {
      check_inertia(b, place);
    } else if (parent_[index] == kNone || !is_parent_[index]) {
      problems_.add(place, fmt::format("body '{}' has no mass; only a body between two hinges may have mass 0", b.name));
    } else if (!b.inertia.isZero(0)) {
      problems_.add(place, fmt::format("body '{}' has inertia but no mass", b.name));
    }
  }

  void check_inertia(const BodyType& b, const SourceLocation& place) {
    const Principal own = principal(b.inertia);
    const Vec3& moments = own.moments;
    const auto text = [&] { return fmt::format("{:.6g}, {:.6g}, {:.6g}", moments[0], moments[1], moments[2]); };
    if (!own.positive()) {
      problems_.add(place, fmt::format("the inertia of body '{}' is not positive definite; its principal moments are {} kg m^2",
                                       b.name, text()));
    } else if (!own.triangle()) {
      problems_.add(place, fmt::format("the inertia of body '{}' is not possible: its principal moments are {} kg m^2, but the "
                                       "largest must not exceed the sum of the other two",
                                       b.name, text()));
    }
  }

  void check_hinges() {
    std::map<std::string, std::size_t> names;
    for (std::size_t i = 0; i < type_.hinges.size(); ++i) {
      HingeType& hinge = type_.hinges[i];
      const Node& map = places_.hinges[i];
      const auto [first, fresh] = names.emplace(hinge.name, i);
      if (!fresh) {
        duplicate(place_of(map, "name"), fmt::format("duplicate hinge name '{}'", hinge.name),
                  place_of(places_.hinges[first->second], "name"));
      }
      normalise(hinge.axis, map, "axis", problems_);
      if (!(hinge.lo < hinge.hi)) {
        problems_.add(place_of(map, "range"), fmt::format("range is {} to {} rad; expected the smaller angle first",
                                                          number_text(hinge.lo), number_text(hinge.hi)));
      } else if (hinge.play.width >= hinge.hi - hinge.lo) {
        problems_.add(place_of(map, "play"),
                      fmt::format("play is {} rad, and the range of hinge '{}' {} rad; expected less play than range",
                                  number_text(hinge.play.width), hinge.name, number_text(hinge.hi - hinge.lo)));
      }
    }
  }

  void check_faces() {
    std::map<int, std::size_t> ids;
    for (std::size_t i = 0; i < type_.faces.size(); ++i) {
      FaceType& face = type_.faces[i];
      const Node& map = places_.faces[i];
      const auto [first, fresh] = ids.emplace(face.id, i);
      if (!fresh) {
        duplicate(place_of(map, "id"), fmt::format("duplicate face id {}", face.id),
                  place_of(places_.faces[first->second], "id"));
      }
      const bool normal = normalise(face.normal, map, "normal", problems_);
      const bool reference = normalise(face.reference, map, "reference", problems_);
      if (normal && reference && std::abs(face.normal.dot(face.reference)) > kRelative) {
        problems_.add(place_of(map, "reference"),
                      fmt::format("reference is not at right angles to the normal of face {}", face.id));
      }
      check_twins(i);
      check_connector(i);
    }
  }

  /// Reports two faces in one place, because only one of them could dock.
  void check_twins(std::size_t i) {
    for (std::size_t k = 0; k < i; ++k) {
      const FaceType& one = type_.faces[k];
      const FaceType& other = type_.faces[i];
      if (!at_one_place(one, other)) continue;
      problems_
          .add(place_of(places_.faces[i], "origin"),
               fmt::format("faces {} and {} are at the same place; write a connector that is neither active nor passive as one "
                           "face with gender: none",
                           one.id, other.id))
          .notes.emplace_back(place_of(places_.faces[k], "origin"), "the first is here");
      return;
    }
  }

  void check_connector(std::size_t i) {
    const std::string& name = type_.faces[i].connector;
    if (type_.connectors.empty() || name.empty() || type_.connectors.contains(name)) return;
    std::vector<std::string> known;
    for (const auto& [connector, limits] : type_.connectors) known.push_back(connector);
    problems_.add(place_of(places_.faces[i], "connector"),
                  "no connector " + in_quotes(name) + offer(name, known, "connectors"));
  }

  void duplicate(const SourceLocation& place, const std::string& what, const SourceLocation& first) {
    problems_.add(place, what).notes.emplace_back(first, "it is given here first");
  }

  ModuleType& type_;
  const ModulePlaces& places_;
  Problems& problems_;
  std::vector<std::size_t> parent_;  ///< hinge whose child is the body with this index
  std::vector<bool> is_parent_;
};

}  // namespace

void check_module(ModuleType& type, const ModulePlaces& places, Problems& problems) {
  ModuleCheck(type, places, problems).run();
}

}  // namespace gaitlab
