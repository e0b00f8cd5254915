#include "interchange/robot_module.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tuple>

#include "core/laws/data_sheet.h"
#include "core/robot_files/module_file.h"
#include "core/scenario/scenario.h"
#include "core/settings/text_file.h"
#include "core/settings/wording.h"
#include "core/settings/writer.h"
#include "interchange/mjcf_bodies.h"
#include "interchange/mjcf_text.h"
#include "interchange/urdf_bodies.h"
#include "interchange/xml_text.h"

namespace gaitlab::interchange {

namespace {

constexpr double kVoltage = 12;  // V, chosen, because URDF has no voltage; torque and speed refer to it

std::string list_text(std::span<const double> numbers) {
  std::string text;
  for (const double number : numbers)
    text += (text.empty() ? "" : ", ") + number_text(number + 0.0);  // adding 0 turns -0 into 0
  return "[" + text + "]";
}
std::string list_text(const Vec3& v) { return list_text(std::span<const double>(v.data(), 3)); }

/// Pose without the rounding errors of products of quarter turns.
Pose tidy(const Pose& pose) {
  constexpr double kRounding = 1e-15;
  Pose whole = pose;
  for (double& entry : whole.R.reshaped()) {
    const double nearest_whole = static_cast<double>(static_cast<int>(entry * 1.5));  // -1, 0 or 1
    if (std::fabs(entry - nearest_whole) < kRounding) entry = nearest_whole;
  }
  return whole;
}

std::string frame_text(const Pose& pose) {
  const std::string turned = pose.R.isIdentity(0) ? "" : ", rpy: " + list_text(to_rpy(pose.R));
  return "origin: " + list_text(pose.p) + turned;
}

/// Points of a hull in the frame of its body, four in a line, rounded to 1 um: vertices of meshes have the digits of a float.
std::string hull_text(const Shape& shape) {
  std::string text = "      - hull: [";
  const std::vector<Vec3>& corners = shape.hull->corners;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    Vec3 point = shape.in_body * corners[k];
    for (double& at : point) at = std::round(at * 1e6) / 1e6 + 0.0;
    text += (k == 0 ? "" : k % 4 == 0 ? ",\n               " : ", ") + list_text(point);
  }
  return text + "]\n";
}

std::string shape_text(const Shape& shape) {
  if (shape.kind == Shape::Kind::hull) return hull_text(shape);
  const std::span<const double> size(shape.size.data(), 3);
  const std::string geometry = shape.kind == Shape::Kind::box      ? "box: " + list_text(size)
                               : shape.kind == Shape::Kind::sphere ? "sphere: " + number_text(shape.size.x())
                                                                   : "cylinder: " + list_text(size.first(2));
  return fmt::format("      - {{{}, {}}}\n", geometry, frame_text(tidy(shape.in_body)));
}

/// `shaped`: another body has a shape.
std::string body_text(const BodyType& body, bool shaped) {
  const Mat3& I = body.inertia;
  const double moments[] = {I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)};
  std::string text = fmt::format("  {}:\n    mass: {}\n", yaml_text(body.name), number_text(body.mass));
  if (body.mass > 0) text += fmt::format("    com: {}\n    inertia: {}\n", list_text(body.com), list_text(moments));
  if (body.shapes.empty() && shaped) text += "    shape: []\n";
  if (!body.shapes.empty()) text += "    shape:\n";
  for (const Shape& shape : body.shapes) text += shape_text(shape);
  return text;
}

/// Keys of the motor that may differ from hinge to hinge, and the gain that fits them.
std::string motor_text(const RobotHinge& hinge) {
  return fmt::format("stall_torque: {}, no_load_speed: {}, dry_friction: {}, viscous_friction: {}, rotor_inertia: {}",
                     number_text(hinge.effort), number_text(hinge.speed), number_text(hinge.dry), number_text(hinge.viscous),
                     number_text(hinge.rotor_inertia));
}
/// These keys, and the source where one of them was chosen.
std::string sourced_motor_text(const RobotHinge& hinge) {
  return motor_text(hinge) + (hinge.source.empty() ? "" : ", source: " + yaml_text(hinge.source));
}
std::string gain_text(const RobotHinge& hinge) {
  const double period = Scenario().control_period;
  return fmt::format("Kp: {:.3g}", gain_of_share(kUsualShare, kVoltage, hinge.speed, period));
}

std::string hinge_text(const RobotHinge& one, const RobotBodies& parts, const RobotHinge* common) {
  const HingeType& hinge = one.hinge;
  const Pose pose = tidy(hinge.in_parent);
  const double range[] = {hinge.lo, hinge.hi};
  std::string text =
      fmt::format("  - name: {}\n    parent: {}\n    child: {}\n    origin: {}\n", yaml_text(hinge.name),
                  yaml_text(parts.bodies[hinge.parent].name), yaml_text(parts.bodies[hinge.child].name), list_text(pose.p));
  if (!pose.R.isIdentity(0)) text += "    rpy: " + list_text(to_rpy(pose.R)) + "\n";
  text += fmt::format("    axis: {}\n    range: {}\n", list_text(hinge.axis), hinge.hi == kNoStop ? "free" : list_text(range));
  if (hinge.passive) {
    text += fmt::format("    drive: none\n    damping: {}\n    friction: {}\n", number_text(hinge.passive->damping),
                        number_text(hinge.passive->friction));
    if (hinge.passive->stiffness > 0) {
      text += fmt::format("    stiffness: {}\n    rest: {}\n", number_text(hinge.passive->stiffness),
                          number_text(hinge.passive->rest));
    }
  } else if (sourced_motor_text(one) != sourced_motor_text(*common)) {
    text += fmt::format("    actuator: {{{}}}\n    controller: {{{}}}\n", sourced_motor_text(one), gain_text(one));
  }
  return text;
}

/// The text of a module, and the lines at which the parts for the elements of the robot file begin.
struct ModuleText {
  struct Part {
    int line;
    const char* tag;
    RobotElement of;
  };
  std::string text;
  std::vector<Part> parts = {};

  void begin(const char* tag, const RobotElement& of) {
    parts.push_back({static_cast<int>(std::ranges::count(text, '\n')) + 1, tag, of});
  }
};

/// The hinge whose motor is that of the module: the first with a motor that the file states, else the first with a torque that
/// it states, else the first with a motor.
const RobotHinge* common_motor(const std::vector<RobotHinge>& hinges) {
  const auto driven = [](const RobotHinge& one) { return !one.hinge.passive; };
  const auto stated = [&](const RobotHinge& one) { return driven(one) && one.source.empty(); };
  auto at = std::ranges::find_if(hinges, stated);
  if (at == hinges.end())
    at = std::ranges::find_if(hinges, [&](const RobotHinge& one) { return driven(one) && !one.no_effort; });
  if (at == hinges.end()) at = std::ranges::find_if(hinges, driven);
  return at == hinges.end() ? nullptr : &*at;
}

ModuleText module_text(const RobotBodies& parts, const std::string& name, const std::string& file) {
  const RobotHinge* const common = common_motor(parts.hinges);
  const std::string from = std::filesystem::path(file).filename().string();
  const bool shapes = std::ranges::any_of(parts.bodies, [](const BodyType& body) { return !body.shapes.empty(); });
  std::string text = fmt::format(
      "# Module {}, written by gaitlab new module --from. Units: m, kg, N m, rad, s. Every key: gaitlab explain module\n"
      "# Add faces, where modules dock; replace the motor by that of a data sheet.\n",
      name);
  for (const RobotNote& note : parts.notes) {
    const std::string of = note.place.file == file ? "" : " of " + std::filesystem::path(note.place.file).filename().string();
    const std::string line = note.place.line > 0 ? fmt::format(", line {}{}", note.place.line, of) : "";
    text += one_line(fmt::format("# {}{}: {}", note.kind(), line, note.text)) + "\n";
  }
  ModuleText made{text + fmt::format("gaitlab_module: 1\nname: {}\nsource: {}\n", yaml_text(name), yaml_text(from))};
  if (parts.base != Base::floating) made.text += fmt::format("base: {}\n", name_of(parts.base));
  made.text += "bodies:\n";
  for (std::size_t b = 0; b < parts.bodies.size(); ++b) {
    made.begin(parts.format.body, parts.body_of[b]);
    made.text += body_text(parts.bodies[b], shapes);
  }
  if (!parts.hinges.empty()) made.text += "hinges:\n";
  for (std::size_t j = 0; j < parts.hinges.size(); ++j) {
    made.begin("joint", parts.hinge_of[j]);
    made.text += hinge_text(parts.hinges[j], parts, common);
  }
  made.begin("robot", {});
  // Without contacts `new scenario` writes a fixed base and no ground: an arm on the ground would bend on its start.
  if (shapes && parts.base == Base::fixed)
    made.text += "# The base is fixed. For an arm that may touch the ground: contacts: {all: shapes}\n";
  if (shapes && parts.base != Base::fixed) made.text += "contacts: {all: shapes}\n";
  if (common == nullptr) return made;
  made.text += fmt::format(
      "actuator: {{type: servo, voltage: {}, {}, load_friction: 0, source: "
      "{}}}\ncontroller: {{type: pid, {}, Kd: 0}}\n",
      number_text(kVoltage), motor_text(*common),
      yaml_text(common->source.empty()
                    ? fmt::format("chosen: the voltage, because {} has none; {}{}", parts.format.name, parts.format.motor, from)
                    : fmt::format("{}; the voltage, because {} has none", common->source, parts.format.name)),
      gain_text(*common));
  return made;
}

/// Throws InputError with the problems in the order of the file.
void raise_by_line(const Problems& problems) {
  if (problems.empty()) return;
  std::vector<Problem> list = problems.list();
  std::ranges::stable_sort(list, {},
                           [](const Problem& one) { return std::tuple(one.place.file, one.place.line, one.place.column); });
  throw InputError(std::move(list));
}

/// The same problem, placed at the element from which that part of the module text was made.
Problem at_element(const Problem& problem, const ModuleText& made, const std::string& file) {
  const auto after = std::ranges::find_if(made.parts, [&](const auto& part) { return part.line > problem.place.line; });
  if (after == made.parts.begin() || std::prev(after)->of.name.empty()) return {SourceLocation{file}, problem.text};
  const ModuleText::Part& part = *std::prev(after);
  const std::string name = in_quotes(part.of.name);
  const bool named = problem.text.find(name) != std::string::npos;
  return {part.of.place, named ? problem.text : fmt::format("{} {}: {}", part.tag, name, problem.text)};
}

RobotBodies bodies_in(const std::string& file, const ImportOptions& options, Problems& problems) {
  const std::string text = without_comments(read_text(file));
  const std::vector<XmlTag> tags = xml_tags(text);
  if (tags.empty() || tags.front().name != "mujoco") return urdf_bodies(UrdfText(file), options, problems);
  if (!options.srdf.empty()) {
    throw InputError(SourceLocation{"--srdf"},
                     fmt::format("{} is MJCF, whose elements exclude name such pairs; expected URDF", file));
  }
  MjcfText mjcf(file, options.meshes);
  return mjcf_bodies(mjcf, options, problems);
}

}  // namespace

RobotModule module_of_robot(const std::string& file, const std::string& name, const ImportOptions& options) {
  Problems problems;
  RobotBodies parts = bodies_in(file, options, problems);
  raise_by_line(problems);
  ModuleText made = module_text(parts, name, file);
  // The reader of module files checks what robot files permit: impossible inertias, axes of length 0, sizes of 0.
  Problems found;
  static_cast<void>(read_module(parse_yaml(made.text, file), true, found));
  for (const Problem& problem : found.list()) {
    const Problem placed = at_element(problem, made, file);
    problems.add(placed.place, placed.text);
  }
  raise_by_line(problems);
  const bool driven = std::ranges::any_of(parts.hinges, [](const RobotHinge& one) { return !one.hinge.passive; });
  return {std::move(made.text), driven, std::move(parts.may_overlap), std::move(parts.notes)};
}

}  // namespace gaitlab::interchange
