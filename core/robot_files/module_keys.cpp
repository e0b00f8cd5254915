#include "core/robot_files/module_keys.h"

#include <cmath>

#include "core/robot_files/body_pair_list.h"

namespace gaitlab {
namespace {

constexpr double kAnyNumber = std::numeric_limits<double>::infinity();

/// Specification of numbers of any size.
constexpr Spec any(const char* unit, const char* about) { return {unit, -kAnyNumber, kAnyNumber, about}; }
constexpr Spec positive(const char* unit, const char* about) { return {unit, kPositive, kAnyNumber, about}; }

Marked required(Fields& f) { return {f, Need::required}; }
Marked optional(Fields& f) { return {f, Need::optional}; }
/// One of the keys of which a map has exactly one.
Marked one_of(Fields& f) { return {f, Need::one_of}; }

void source_field(Fields& f, std::string& source) { f.text("source", source, "Origin of the values."); }

void frame_fields(Fields& f, Vec3& origin, Vec3& turn) {
  f.vector("origin", span_of(origin), any("m", "Origin in the body's frame."));
  f.vector("rpy", span_of(turn), any("rad", "Roll, pitch, yaw."));
}

/// A map with keys of plugins, which are read when the plugins are known.
constexpr field::Other kPluginMap{"map", R"({"type": "object"})"};
constexpr field::Other kPairs{
    "list of pairs",
    R"({"type": "array", "items": {"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 2}})", "[]"};

}  // namespace

void ShapeKeys::fields(Fields& f) {
  source_field(f, source);
  frame_fields(f, origin, turn);
  one_of(f).vector(name_of(Shape::Kind::box), span_of(size), positive("m", "Edges along x, y, z."));
  one_of(f).vector(name_of(Shape::Kind::cylinder), span_of(size).first(2), positive("m", "Radius and length, along y."));
  one_of(f).vector(name_of(Shape::Kind::half_cylinder), span_of(size).first(2),
                   positive("m", "Radius and length, along y; the half on the side of +x."));
  one_of(f).number(name_of(Shape::Kind::sphere), size.x(), positive("m", "Radius."));
  one_of(f).rows(name_of(Shape::Kind::hull), corners, any("m", "4 to 64 points [x, y, z], whose convex hull is the shape."));
}

void BodyKeys::fields(Fields& f) {
  source_field(f, source);
  f.number("mass", mass, {"kg", 0, kAnyNumber, "Mass; 0 only for a body between two hinges."});
  f.vector("com", span_of(com), any("m", "Centre of mass, body frame. Without com and inertia: that of the shapes."));
  optional(f).vector("inertia", tensor,
                     any("kg m^2",
                         "xx, yy, zz, xy, xz, yz about the COM, body axes; elements of the tensor (xy: -sum of m x y). Without "
                         "this key: inertia of the shapes at uniform density."));
  optional(f).list(
      "shape", outline,
      "Outline of the body. Each shape has exactly one of box, cylinder, half_cylinder, sphere and hull. "
      "[] states that the body has no extent: the checks collision and in_ground, which otherwise need the shapes of all "
      "bodies, leave it out.");
}

void SpringKeys::fields(Fields& f) {
  f.number("stiffness", stiffness, {"N m/rad", 0, 1e6, "Stiffness of a spring. Only with drive: none."});
  f.number("rest", rest, {"rad", -1000, 1000, "Angle at which the spring has no torque. Only with drive: none."});
  f.number("damping", damping, {"N m s/rad", 0, 1e6, "Coefficient of a viscous damper. Only with drive: none."});
  f.number("friction", friction, {"N m", 0, 1e6, "Dry friction. Only with drive: none."});
  f.number("friction_speed", friction_speed,
           {"rad/s", 1e-6, 1e3,
            "Speed below which dry friction is viscous, under explicit integrators; under the others the hinge sticks. Only "
            "with drive: none."});
}

void HingeKeys::fields(Fields& f) {
  static constexpr const char* kDrives[] = {"motor", "none"};
  static constexpr const char* kEncoders[] = {"output", "motor"};
  source_field(f, source);
  required(f).text("name", name, "Name of the hinge and of its joint.");
  required(f).text("parent", of_parent, "A body's name.");
  required(f).text("child", of_child, "Name of the body that moves with the hinge.");
  frame_fields(f, origin, turn);
  required(f).vector("axis", span_of(axis), any("", "Axis, hinge frame, of any length."));
  Marked(f, Need::required, "free", &free)
      .vector("range", range, any("rad", "Smallest and largest angle, outside which a stop acts; free: continuous rotation."));
  f.choice("drive", drive, kDrives, "motor, or none for a passive hinge.");
  f.number("play", play.width,
           {"rad", 0, 1,
            "Lost motion between the geared motor and the child, from one flank of the gear to the other. Needs an inertia of "
            "the rotor."});
  f.number("play_stiffness", play.stiffness, {"N m/rad", kPositive, 1e6, "Stiffness of the flanks of a gear with play."});
  f.choice("encoder", encoder, kEncoders,
           "Place of encoder and controller's measurement in a gear with play: output, the child, or motor.");
  spring.fields(f);
  optional(f).other("actuator", kPluginMap, "Keys of the motor that differ from the module type's actuator.");
  optional(f).other("controller", kPluginMap, "Keys of the controller that differ from the module type's controller.");
}

void FaceKeys::fields(Fields& f) {
  source_field(f, source);
  required(f).integer("id", number, {"", 0, 1000, "Number of the face in build files."});
  required(f).text("body", of_body, "A body's name.");
  required(f).choice("gender", gender, enum_names<Gender>(), "`active` docks on `passive`, and `none` on `none`.");
  f.text("connector", connector, "Name of the connector; only faces with the same connector dock.");
  f.integers("turns", quarters, {"", 0, 3, "Orientations in which the face docks, times pi/2."});
  required(f).vector("origin", span_of(origin), any("m", "Middle of the face, body frame."));
  required(f).vector("normal", span_of(normal), any("", "Outward normal, body frame."));
  required(f).vector("reference", span_of(reference), any("", "In-plane reference direction, body frame."));
}

void ContactKeys::fields(Fields& f) {
  source_field(f, source);
  required(f).text("body", of_body, "A body's name.");
  one_of(f).vector("point", span_of(centre), any("m", "A point, body frame."));
  one_of(f).vector("sphere", span_of(sphere), any("m", "Centre of a sphere, body frame."));
  Marked(f, std::isnan(sphere.x()) ? Need::optional : Need::required)
      .number("radius", radius, positive("m", "Radius of the sphere."));
}

void ContactsKeys::fields(Fields& f) {
  source_field(f, source);
  Marked(f, Need::optional, "shapes", &feet_of_shapes)
      .list("feet", feet,
            "Elements for contact.on: feet, on the free block of every module without children. Without this key: those of "
            "`all`.");
  Marked(f, Need::preset, "shapes", &all_of_shapes)
      .list("all", all, "Elements for contact.on: all; shapes: the vertices of boxes and cylinders, and spheres.");
}

void ConnectorKeys::fields(Fields& f) {
  optional(f).number("tension", tension, positive("N", "Largest pull along the normal."));
  optional(f).number("shear", shear, positive("N", "Largest force in the plane of the face."));
  optional(f).number("bending", bending, positive("N m", "Largest moment about axes in that plane."));
  optional(f).number("torsion", torsion, positive("N m", "Largest moment about the normal."));
  source_field(f, source);
}

void ModuleKeys::fields(Fields& f) {
  f.integer("gaitlab_module", version, {"", 1, 1, "Format version, which marks a file as a module."});
  source_field(f, source);
  required(f).text("name", name, "Name of the type.");
  f.flag("lattice", lattice, "Bodies with faces fill cells of a cubic lattice.");
  f.choice("base", base, enum_names<Base>(),
           "Base of a robot of one such module, which gaitlab new scenario writes into robot.base. No effect on a scenario.");
  required(f).by_name("bodies", bodies, "{mass: ...}",
                      "Bodies by name. The frame of the root, which no hinge moves, is the module frame.");
  optional(f).list("hinges", hinges, "Revolute hinges, which join the bodies into one tree.");
  optional(f).list("faces", faces, "Docking faces.");
  f.group("contacts", contacts, "Points and spheres that touch the ground.");
  optional(f).by_name("connectors", connectors, "{tension: ..., shear: ...}",
                      "Largest loads of the connectors of faces, by name; a load that is missing is not judged.");
  f.other(kMayOverlap, kPairs,
          "Pairs [BODY, BODY] that the check collision leaves out, by names or patterns; for other pairs, the overlap with all "
          "hinges at 0 is by design.");
  f.group("battery", battery,
          "Battery of the motors of each module of this type, which then do not use the scenario's supply.");
  optional(f).other("actuator", kPluginMap,
                    "Motor of every driven hinge: type, and keys of that actuator (gaitlab explain actuator TYPE).");
  optional(f).other("controller", kPluginMap,
                    "Controller of every driven hinge: type, and its keys without period (gaitlab explain controller TYPE).");
}

}  // namespace gaitlab
