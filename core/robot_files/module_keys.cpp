#include "core/robot_files/module_keys.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "core/model/module_type.h"

namespace gaitlab {

namespace {

constexpr double kAnyNumber = std::numeric_limits<double>::infinity();

constexpr Spec kSource{"", 0, 0, "Origin of the values."};
constexpr Spec kSize{"m", kPositive, kAnyNumber, ""};

/// Specification of a text, a word or a map, which have no range.
constexpr Spec said(const char* about) { return {"", 0, 0, about}; }
/// Specification of numbers of any size.
constexpr Spec any(const char* unit, const char* about) { return {unit, -kAnyNumber, kAnyNumber, about}; }
constexpr Spec positive(const char* unit, const char* about) { return {unit, kPositive, kAnyNumber, about}; }

constexpr ModuleKey kSourceKey{.key = "source", .form = ModuleForm::text, .spec = kSource};
constexpr ModuleKey kOrigin{.key = "origin",
                            .form = ModuleForm::vector,
                            .spec = any("m", "Origin in the body's frame."),
                            .preset = "[0, 0, 0]",
                            .size = 3};
constexpr ModuleKey kTurn{
    .key = "rpy", .form = ModuleForm::vector, .spec = any("rad", "Roll, pitch, yaw."), .preset = "[0, 0, 0]", .size = 3};

constexpr ModuleKey kShapeKeys[] = {
    kSourceKey,
    kOrigin,
    kTurn,
    {.key = "box", .form = ModuleForm::vector, .spec = positive("m", "Edges along x, y, z."), .size = 3},
    {.key = "cylinder", .form = ModuleForm::vector, .spec = positive("m", "Radius and length, along y."), .size = 2},
    {.key = "half_cylinder",
     .form = ModuleForm::vector,
     .spec = positive("m", "Radius and length, along y; the half on the side of +x."),
     .size = 2},
    {.key = "sphere", .form = ModuleForm::number, .spec = positive("m", "Radius.")},
};
constexpr const char* kShapeKinds[] = {"box", "cylinder", "half_cylinder", "sphere"};

constexpr ModuleKey kBodyKeys[] = {
    kSourceKey,
    {.key = "mass",
     .form = ModuleForm::number,
     .spec = {"kg", 0, kAnyNumber, "Mass; 0 only for a body between two hinges."},
     .preset = "0"},
    {.key = "com",
     .form = ModuleForm::vector,
     .spec = any("m", "Centre of mass, body frame. Without com and inertia: that of the shapes."),
     .preset = "[0, 0, 0]",
     .size = 3},
    {.key = "inertia",
     .form = ModuleForm::vector,
     .spec =
         any("kg m^2",
             "xx, yy, zz, xy, xz, yz about the COM, body axes; elements of the tensor (xy: -sum of m x y). Without it: that "
             "of the shapes at uniform density."),
     .size = 6},
    {.key = "shape",
     .form = ModuleForm::list,
     .spec = said("Outline of the body. Each shape has exactly one of box, cylinder, half_cylinder and sphere."),
     .map = &kShapeMap},
};

constexpr const char* kFree[] = {"free"};
constexpr const char* kDrives[] = {"motor", "none"};
constexpr ModuleKey kHingeKeys[] = {
    kSourceKey,
    {.key = "name", .form = ModuleForm::text, .spec = said("Name of the hinge and of its joint."), .required = true},
    {.key = "parent", .form = ModuleForm::text, .spec = said("A body's name."), .required = true},
    {.key = "child", .form = ModuleForm::text, .spec = said("A body's name, which moves with the hinge."), .required = true},
    kOrigin,
    kTurn,
    {.key = "axis",
     .form = ModuleForm::vector,
     .spec = any("", "Axis, hinge frame, of any length."),
     .required = true,
     .size = 3},
    {.key = "range",
     .form = ModuleForm::vector,
     .spec = any("rad", "Smallest and largest angle, outside which a stop acts; free: continuous rotation."),
     .required = true,
     .size = 2,
     .words = kFree},
    {.key = "drive",
     .form = ModuleForm::word,
     .spec = said("motor, or none for a passive hinge."),
     .preset = "\"motor\"",
     .words = kDrives},
    {.key = "stiffness",
     .form = ModuleForm::number,
     .spec = {"N m/rad", 0, 1e6, "Stiffness of a spring."},
     .preset = "0",
     .passive = true},
    {.key = "rest",
     .form = ModuleForm::number,
     .spec = {"rad", -1000, 1000, "Angle at which the spring has no torque."},
     .preset = "0",
     .passive = true},
    {.key = "damping",
     .form = ModuleForm::number,
     .spec = {"N m s/rad", 0, 1e6, "Coefficient of a viscous damper."},
     .preset = "0",
     .passive = true},
    {.key = "friction", .form = ModuleForm::number, .spec = {"N m", 0, 1e6, "Dry friction."}, .preset = "0", .passive = true},
    {.key = "friction_speed",
     .form = ModuleForm::number,
     .spec = {"rad/s", 1e-6, 1e3, "Speed below which dry friction is viscous."},
     .preset = "0.1",
     .passive = true},
    {.key = "actuator",
     .form = ModuleForm::map,
     .spec = said("Keys of the motor that differ from the module type's actuator.")},
    {.key = "controller",
     .form = ModuleForm::map,
     .spec = said("Keys of the controller that differ from the module type's controller.")},
};

constexpr const char* kGenders[] = {name_of(Gender::active), name_of(Gender::passive), name_of(Gender::none)};
constexpr ModuleKey kFaceKeys[] = {
    kSourceKey,
    {.key = "id", .form = ModuleForm::integer, .spec = {"", 0, 1000, "Number of the face in build files."}, .required = true},
    {.key = "body", .form = ModuleForm::text, .spec = said("A body's name."), .required = true},
    {.key = "gender",
     .form = ModuleForm::word,
     .spec = said("An active face docks on a passive one, none on none."),
     .required = true,
     .words = kGenders},
    {.key = "connector",
     .form = ModuleForm::text,
     .spec = said("Name of the connector; only faces with the same connector dock.")},
    {.key = "turns",
     .form = ModuleForm::integers,
     .spec = {"", 0, 3, "Orientations in which the face docks, times pi/2."},
     .preset = "[0, 1, 2, 3]"},
    {.key = "origin",
     .form = ModuleForm::vector,
     .spec = any("m", "Middle of the face, body frame."),
     .required = true,
     .size = 3},
    {.key = "normal", .form = ModuleForm::vector, .spec = any("", "Outward normal, body frame."), .required = true, .size = 3},
    {.key = "reference",
     .form = ModuleForm::vector,
     .spec = any("", "In-plane reference direction, body frame."),
     .required = true,
     .size = 3},
};

constexpr ModuleKey kContactKeys[] = {
    kSourceKey,
    {.key = "body", .form = ModuleForm::text, .spec = said("A body's name."), .required = true},
    {.key = "point", .form = ModuleForm::vector, .spec = any("m", "A point, body frame."), .size = 3},
    {.key = "sphere", .form = ModuleForm::vector, .spec = any("m", "Centre of a sphere, body frame."), .size = 3},
    {.key = "radius", .form = ModuleForm::number, .spec = positive("m", "Radius of the sphere.")},
};
constexpr const char* kContactKinds[] = {"point", "sphere"};

constexpr const char* kShapes[] = {"shapes"};
constexpr ModuleKey kContactsKeys[] = {
    kSourceKey,
    {.key = "feet",
     .form = ModuleForm::list,
     .spec = said("Elements for contact.on: feet, on the free block of every module without children. Without it: those of "
                  "all."),
     .words = kShapes,
     .map = &kContactMap},
    {.key = "all",
     .form = ModuleForm::list,
     .spec = said("Elements for contact.on: all; shapes: the vertices of boxes and cylinders, and spheres."),
     .preset = "[]",
     .words = kShapes,
     .map = &kContactMap},
};

constexpr ModuleKey kConnectorKeys[] = {
    {.key = "tension", .form = ModuleForm::number, .spec = positive("N", "Largest pull along the normal.")},
    {.key = "shear", .form = ModuleForm::number, .spec = positive("N", "Largest force in the plane of the face.")},
    {.key = "bending", .form = ModuleForm::number, .spec = positive("N m", "Largest moment about axes in that plane.")},
    {.key = "torsion", .form = ModuleForm::number, .spec = positive("N m", "Largest moment about the normal.")},
    kSourceKey,
};

constexpr ModuleKey kModuleKeys[] = {
    {.key = "gaitlab_module",
     .form = ModuleForm::integer,
     .spec = {"", 1, 1, "Format version, which marks a file as a module."},
     .preset = "1"},
    kSourceKey,
    {.key = "name", .form = ModuleForm::text, .spec = said("Name of the type."), .required = true},
    {.key = "lattice",
     .form = ModuleForm::flag,
     .spec = said("Bodies with faces fill cells of a cubic lattice."),
     .preset = "false"},
    {.key = "bodies",
     .form = ModuleForm::map,
     .spec = said("Bodies by name. The frame of the root, which no hinge moves, is the module frame."),
     .required = true,
     .map = &kBodyMap,
     .by_name = true},
    {.key = "hinges",
     .form = ModuleForm::list,
     .spec = said("Revolute hinges, which join the bodies into one tree."),
     .map = &kHingeMap},
    {.key = "faces", .form = ModuleForm::list, .spec = said("Docking faces."), .map = &kFaceMap},
    {.key = "contacts",
     .form = ModuleForm::map,
     .spec = said("Points and spheres that touch the ground."),
     .map = &kContactsMap},
    {.key = "connectors",
     .form = ModuleForm::map,
     .spec = said("Largest loads of the connectors of faces, by name; a load that is missing is not judged."),
     .map = &kConnectorMap,
     .by_name = true},
    {.key = "may_overlap",
     .form = ModuleForm::pairs,
     .spec = said("Pairs [BODY, BODY] that the check collision leaves out, by names or patterns; of a pair that is not left "
                  "out, overlap with all hinges at 0 is by design."),
     .preset = "[]"},
    {.key = "actuator",
     .form = ModuleForm::map,
     .spec = said("Motor of every driven hinge: type, and keys of that actuator (gaitlab explain actuator TYPE).")},
    {.key = "controller",
     .form = ModuleForm::map,
     .spec = said("Controller of these motors: type, and its keys without period (gaitlab explain controller TYPE).")},
};

}  // namespace

const ModuleMap kModuleMap{kModuleKeys};
const ModuleMap kBodyMap{kBodyKeys};
const ModuleMap kShapeMap{kShapeKeys, kShapeKinds};
const ModuleMap kHingeMap{kHingeKeys};
const ModuleMap kFaceMap{kFaceKeys};
const ModuleMap kConnectorMap{kConnectorKeys};
const ModuleMap kContactsMap{kContactsKeys};
const ModuleMap kContactMap{kContactKeys, kContactKinds};

const ModuleKey& ModuleMap::at(std::string_view key) const {
  const auto found = std::ranges::find(keys, key, [](const ModuleKey& one) { return std::string_view(one.key); });
  if (found == keys.end()) throw std::logic_error("no key " + std::string(key) + " of a module file is declared");
  return *found;
}

}  // namespace gaitlab
