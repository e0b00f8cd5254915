// Registration of plugins by name, with manual, settings and factory. The interface is abstract, so that a plugin library links
// against nothing.
#pragma once
#include <memory>

#include "core/plugin/actuator.h"
#include "core/plugin/controller.h"
#include "core/plugin/cpg.h"
#include "core/plugin/robot_info.h"

namespace gaitlab {

enum class Kind { cpg, controller, actuator, sensor };

class Sensor;
struct SensorSite;

struct Entry {
  Kind kind;
  std::string_view name;
  std::string_view manual;                          ///< text with equation, reference and minimal YAML
  std::shared_ptr<void> (*settings)(const Entry&);  ///< makes settings with the defaults, which may share the context
  void (*fields)(void* settings, Fields&);
  /// Makes a new Cpg, Controller or Actuator. An actuator gets one settings pointer per lane, any other plugin exactly one.
  /// Null for a sensor.
  void* (*make)(const RobotInfo&, std::span<const void* const> settings);
  std::string_view origin = {};  ///< kBuiltIn or the path of the library; set by the program
  Sensor* (*make_sensor)(const SensorSite&, const void* settings) = nullptr;  ///< makes a new sensor (core/plugin/sensor.h)
  /// Data for the functions of an entry that is no C++ class, such as a Python class. Null otherwise.
  std::shared_ptr<void> context = {};
};

class Registry {
 public:
  virtual void add(const Entry&) = 0;  ///< throws, with both origins, if the kind already has this name

 protected:
  ~Registry() = default;
};

namespace detail {
template <class T, class Make>
void add(Registry& registry, Kind kind, std::string_view name, std::string_view manual, Make make) {
  using S = typename T::Settings;
  registry.add({kind, name, manual, [](const Entry&) { return std::shared_ptr<void>(std::make_shared<S>()); },
                [](void* settings, Fields& f) { static_cast<S*>(settings)->fields(f); }, make});
}
}  // namespace detail

/// Registers T, which has `struct Settings` and a constructor T(const RobotInfo&, const Settings&).
template <class T>
void add_cpg(Registry& registry, std::string_view name, std::string_view manual) {
  detail::add<T>(registry, Kind::cpg, name, manual, [](const RobotInfo& robot, std::span<const void* const> s) -> void* {
    return static_cast<Cpg*>(new T(robot, *static_cast<const typename T::Settings*>(s[0])));
  });
}

/// Registers T, which has `struct Settings` and a constructor T(const RobotInfo&, const Settings&).
template <class T>
void add_controller(Registry& registry, std::string_view name, std::string_view manual) {
  detail::add<T>(registry, Kind::controller, name, manual, [](const RobotInfo& robot, std::span<const void* const> s) -> void* {
    return static_cast<Controller*>(new T(robot, *static_cast<const typename T::Settings*>(s[0])));
  });
}

/// Registers T, which has `struct Settings` and a constructor T(const RobotInfo&, std::vector<const Settings*>), with one
/// pointer per lane.
template <class T>
void add_actuator(Registry& registry, std::string_view name, std::string_view manual) {
  detail::add<T>(registry, Kind::actuator, name, manual, [](const RobotInfo& robot, std::span<const void* const> s) -> void* {
    std::vector<const typename T::Settings*> lanes;
    for (const void* one : s) lanes.push_back(static_cast<const typename T::Settings*>(one));
    return static_cast<Actuator*>(new T(robot, lanes));
  });
}

}  // namespace gaitlab
