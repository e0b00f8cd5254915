// Keys of module files: a struct for each map, from whose fields follow reader, manual, reference page and JSON Schema.
#pragma once
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "core/model/module_type.h"
#include "core/plugin/fields.h"

namespace gaitlab {

// A struct derives from the part of the model that its keys describe, and reads the keys of equal meaning into it.

struct ShapeKeys : Shape {
  std::string source;
  Vec3 origin = Vec3::Zero(), turn = Vec3::Zero();
  std::vector<std::vector<double>> corners;  ///< points of a hull
  void fields(Fields& f);
};

struct BodyKeys : BodyType {
  std::string source;
  std::array<double, 6> tensor = {};
  std::vector<ShapeKeys> outline;
  void fields(Fields& f);
};

/// Spring and damper of a hinge without a motor.
struct SpringKeys : Passive {
  void fields(Fields& f);
};

struct HingeKeys : HingeType {
  std::string source, of_parent, of_child;  ///< names of the bodies
  Vec3 origin = Vec3::Zero(), turn = Vec3::Zero();
  std::array<double, 2> range = {};
  bool free = false;
  enum class Drive { motor, none } drive = Drive::motor;
  enum class Encoder { output, motor } encoder = Encoder::output;
  SpringKeys spring;
  void fields(Fields& f);
};

struct FaceKeys : FaceType {
  std::string source, of_body;
  std::int64_t number = 0;
  std::vector<double> quarters{0, 1, 2, 3};
  void fields(Fields& f);
};

struct ContactKeys : ContactType {
  std::string source, of_body;
  Vec3 sphere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  void fields(Fields& f);
};

struct ContactsKeys {
  std::string source;
  std::vector<ContactKeys> feet, all;
  bool feet_of_shapes = false, all_of_shapes = false;
  void fields(Fields& f);
};

struct ConnectorKeys : Connector {
  std::string name;
  void fields(Fields& f);
};

struct ModuleKeys {
  std::int64_t version = 1;
  std::string source, name;
  bool lattice = false;
  Base base = Base::floating;
  std::vector<BodyKeys> bodies;
  std::vector<HingeKeys> hinges;
  std::vector<FaceKeys> faces;
  ContactsKeys contacts;
  std::vector<ConnectorKeys> connectors;
  Battery battery;
  void fields(Fields& f);
};

}  // namespace gaitlab
