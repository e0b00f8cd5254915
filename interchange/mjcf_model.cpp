#include "interchange/mjcf_model.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "core/errors.h"

namespace gaitlab::interchange {

namespace {

/// Functions of libmujoco, which is loaded when they are first needed: the program starts without it, and a program that loads
/// another version keeps its own.
struct Mujoco {
  decltype(&mj_defaultVFS) default_vfs;
  decltype(&mj_makeEmptyFileVFS) make_file;
  decltype(&mj_deleteVFS) delete_vfs;
  decltype(&mj_loadXML) load;
  decltype(&mj_deleteModel) delete_model;
};

[[noreturn]] void fail(const char* text) { throw std::runtime_error(text); }
thread_local std::vector<std::string> warned;  // during a call
void keep(const char* text) { warned.emplace_back(text); }

const Mujoco& mujoco(const std::string& file) {
  static void* const library = dlopen(GAITLAB_MUJOCO, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    throw InputError(SourceLocation{file},
                     fmt::format("is MJCF, which {} compiles, but that is not installed; Debian: apt install {}",
                                 GAITLAB_MUJOCO, "libmujoco2.2.2"));
  }
  static const Mujoco functions = [] {
    const auto find = [](auto& function, const char* name) {
      function = reinterpret_cast<std::decay_t<decltype(function)>>(dlsym(library, name));
      if (function == nullptr) throw std::runtime_error(fmt::format("{} lacks {}", GAITLAB_MUJOCO, name));
    };
    Mujoco found{};
    find(found.default_vfs, "mj_defaultVFS");
    find(found.make_file, "mj_makeEmptyFileVFS");
    find(found.delete_vfs, "mj_deleteVFS");
    find(found.load, "mj_loadXML");
    find(found.delete_model, "mj_deleteModel");
    // Otherwise an error ends the program, and a warning writes a file into the current folder.
    decltype(&mju_user_error) on_error = nullptr;
    decltype(&mju_user_warning) on_warning = nullptr;
    find(on_error, "mju_user_error");
    find(on_warning, "mju_user_warning");
    *on_error = fail;
    *on_warning = keep;
    return found;
  }();
  return functions;
}

Vec3 vec(const mjtNum* x) { return {x[0], x[1], x[2]}; }
Mat3 rotation(const mjtNum* q) { return Quat(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix(); }

double largest(const mjtNum* range) { return std::max(std::fabs(range[0]), std::fabs(range[1])); }

MjcfGeom geom_of(const mjModel& m, std::ptrdiff_t g) {
  constexpr MjcfGeom::Type kTypes[] = {MjcfGeom::Type::plane,   MjcfGeom::Type::heights,   MjcfGeom::Type::sphere,
                                       MjcfGeom::Type::capsule, MjcfGeom::Type::ellipsoid, MjcfGeom::Type::cylinder,
                                       MjcfGeom::Type::box,     MjcfGeom::Type::mesh};
  MjcfGeom geom{kTypes[m.geom_type[g]],   {rotation(m.geom_quat + 4 * g), vec(m.geom_pos + 3 * g)},
                vec(m.geom_size + 3 * g), m.geom_contype[g],
                m.geom_conaffinity[g],    m.names + m.name_geomadr[g]};
  if (geom.type != MjcfGeom::Type::mesh) return geom;
  const int mesh = m.geom_dataid[g];
  geom.mesh = static_cast<std::size_t>(mesh);
  const std::ptrdiff_t begin = m.mesh_vertadr[mesh];
  const float* const first = m.mesh_vert + 3 * begin;
  for (std::ptrdiff_t v = 0; v < m.mesh_vertnum[mesh]; ++v)
    geom.vertices.emplace_back(first[3 * v], first[3 * v + 1], first[3 * v + 2]);
  return geom;
}

MjcfJoint joint_of(const mjModel& m, std::ptrdiff_t j) {
  constexpr MjcfJoint::Type kTypes[] = {MjcfJoint::Type::free, MjcfJoint::Type::ball, MjcfJoint::Type::slide,
                                        MjcfJoint::Type::hinge};
  const int dof = m.jnt_dofadr[j];
  const int at = m.jnt_qposadr[j];
  return {kTypes[m.jnt_type[j]],  m.names + m.name_jntadr[j],
          vec(m.jnt_pos + 3 * j), vec(m.jnt_axis + 3 * j),
          m.jnt_limited[j] != 0,  m.jnt_range[2 * j],
          m.jnt_range[2 * j + 1], m.qpos0[at],
          m.qpos_spring[at],      m.dof_armature[dof],
          m.dof_damping[dof],     m.dof_frictionloss[dof],
          m.jnt_stiffness[j],     m.nuser_jnt == 2 ? largest(m.jnt_user + 2 * j) : 0};
}

MjcfActuator actuator_of(const mjModel& m, std::ptrdiff_t a) {
  const int joint = m.actuator_trnid[2 * a];
  const int body = m.jnt_bodyid[joint];
  MjcfActuator made{static_cast<std::size_t>(body),
                    static_cast<std::size_t>(joint - m.body_jntadr[body]),
                    m.actuator_gear[6 * a],
                    {},
                    m.actuator_biastype[a] != mjBIAS_NONE};
  if (m.actuator_ctrllimited[a] != 0 && m.actuator_gaintype[a] == mjGAIN_FIXED && !made.position)
    made.force = std::fabs(m.actuator_gainprm[mjNGAIN * a]) * largest(m.actuator_ctrlrange + 2 * a);
  if (m.actuator_forcelimited[a] != 0) {
    const double most = largest(m.actuator_forcerange + 2 * a);
    made.force = std::min(most, made.force.value_or(most));
  }
  return made;
}

MjcfRobot model_of(const mjModel& m) {
  MjcfRobot made;
  for (std::ptrdiff_t b = 0; b < m.nbody; ++b) {
    const Mat3 axes = rotation(m.body_iquat + 4 * b);
    MjcfBody body{m.names + m.name_bodyadr[b],
                  static_cast<std::size_t>(m.body_parentid[b]),
                  {rotation(m.body_quat + 4 * b), vec(m.body_pos + 3 * b)},
                  m.body_mass[b],
                  vec(m.body_ipos + 3 * b),
                  axes * vec(m.body_inertia + 3 * b).asDiagonal() * axes.transpose()};
    for (int j = 0; j < m.body_jntnum[b]; ++j) body.joints.push_back(joint_of(m, m.body_jntadr[b] + j));
    for (int g = 0; g < m.body_geomnum[b]; ++g) body.geoms.push_back(geom_of(m, m.body_geomadr[b] + g));
    made.bodies.push_back(std::move(body));
  }
  for (std::ptrdiff_t a = 0; a < m.nu; ++a) {
    if (m.actuator_trntype[a] == mjTRN_JOINT || m.actuator_trntype[a] == mjTRN_JOINTINPARENT)
      made.actuators.push_back(actuator_of(m, a));
  }
  for (int x = 0; x < m.nexclude; ++x) {
    const auto pair = static_cast<unsigned>(m.exclude_signature[x]);
    made.excluded.emplace_back((pair >> 16U) - 1, (pair & 0xFFFFU) - 1);  // from 1 on
  }
  return made;
}

/// The first line of a message without `XML Error: `, with the name of its element; and its line, `line 7`, `line = 7` or
/// `Line number=7`.
MjcfError error_of(const std::string& message) {
  MjcfError made;
  for (const char* const mark : {", line ", "line = ", "Line number="}) {
    const std::size_t at = message.find(mark);
    if (at != std::string::npos && made.line == 0) made.line = std::max(0, std::atoi(message.c_str() + at + std::strlen(mark)));
  }
  made.text = message.substr(0, message.find_first_of("\n\r"));
  for (const char* const head : {"XML Error: ", "Error: ", "Schema violation: "}) {
    if (made.text.starts_with(head)) made.text.erase(0, std::strlen(head));
  }
  if (made.text.starts_with("XML parse error")) made.text = "is not well-formed XML";
  const std::size_t element = message.find("Element '");
  if (element != std::string::npos) {
    const std::size_t begin = element + std::strlen("Element '");
    made.element = message.substr(begin, message.find('\'', begin) - begin);
  }
  return made;
}

}  // namespace

CompiledMjcf compile_mjcf(const std::string& text, const std::string& file) {
  const Mujoco& functions = mujoco(file);
  const auto vfs = std::make_unique<mjVFS>();
  functions.default_vfs(vfs.get());
  const char* const kName = "robot.xml";
  const auto size = static_cast<int>(text.size());
  CompiledMjcf made;
  if (functions.make_file(vfs.get(), kName, size) != 0) return {{}, MjcfError{"the text is too long"}};
  std::memcpy(vfs->filedata[0], text.c_str(), text.size());
  char message[1000] = "";
  warned.clear();
  mjModel* model = nullptr;
  try {
    model = functions.load(kName, vfs.get(), message, sizeof message);
  } catch (const std::exception& error) {
    std::strncpy(message, error.what(), sizeof message - 1);
  }
  functions.delete_vfs(vfs.get());
  if (model == nullptr) return {{}, error_of(message)};
  made.model = model_of(*model);
  made.warnings = warned;
  functions.delete_model(model);
  return made;
}

}  // namespace gaitlab::interchange
