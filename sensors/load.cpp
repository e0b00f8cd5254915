#include "sensors/load.h"

#include "sensors/parts.h"

namespace gaitlab::sensors {

const char* const LoadSensor::kManual =
    R"(Load of modules or single bodies: the sum of the normal forces on their contact elements.

    touches: on above `touch`, off below `release`, unchanged in between

CPG and controller get `touches` of these modules in place of the true contact (a force above 0). The loads are separate values
(Measured::channels). Trace columns sensor.NAME.MODULE, sensor.NAME.MODULE.touching and sensor.NAME.BODY. The keys are those of a
channel (docs/real-robot.md). Every module and body has its own draws. A robot without contact elements measures 0.
Source: none. Defaults (chosen): an exact sensor, `touch` 1 N and `release` 0.5 N.

    sensors:
      feet: {type: load, modules: [m5, m6], noise: 0.2})";

void LoadSensor::Settings::fields(Fields& f) {
  f.names("modules", modules, Among::modules,
          "Modules whose load is measured: a name such as m5, a pattern, or a list; [] for none.");
  f.names("bodies", bodies, Among::bodies, "Bodies whose load is measured, such as m5/passive.");
  ChannelKeys::fields(f);
  f.number("touch", touch, {"N", -1e9, 1e9, "Measured load above which a module touches."});
  f.number("release", release, {"N", -1e9, 1e9, "Measured load below which a module no longer touches; at most `touch`."});
  if (release > touch) f.problem("release", "release is above touch; expected at most touch");
}

LoadSensor::LoadSensor(const SensorSite& site, const Settings& settings) : touch_(settings.touch), release_(settings.release) {
  const auto add = [&](const std::vector<std::size_t>& parts, const std::vector<std::string>& names, const char* what) {
    for (const std::size_t i : parts) {
      const std::string name = site.name + "." + names[i];
      channels_.add(Channel(settings, site, name));
      parts_.push_back(i);
      readings_.push_back({name, "sensor." + name, "N",
                           "normal force measured by the sensor, in force just before t, of " + std::string(what) + names[i]});
    }
  };
  const std::vector<std::string> modules = module_names_of(site.robot);
  add(matching(settings.modules, modules), modules, "module ");
  modules_ = parts_.size();
  const std::vector<std::string> bodies = body_names_of(site.robot);
  add(matching(settings.bodies, bodies), bodies, "body ");
  for (std::size_t i = 0; i < modules_; ++i) {
    const std::string name = readings_[i].name + ".touching";
    readings_.push_back({name, "sensor." + name, "", "1 while the sensor reports contact, of module " + modules[parts_[i]],
                         Replaces::touching, parts_[i]});
  }
}

void LoadSensor::sense(const Truth& truth, Out state, Out values) const {
  const std::size_t loads = parts_.size();
  const auto one = [&](std::size_t i) { return (i < modules_ ? truth.module_load : truth.body_load).subspan(parts_[i], 1); };
  channels_.sense(truth.tick, one, state, values.first(loads));
  const Out touching = values.subspan(loads);
  for (std::size_t i = 0; i < modules_; ++i) {
    if (truth.tick == 0) touching[i] = 0;
    if (values[i] > touch_) {
      touching[i] = 1;
    } else if (values[i] < release_) {
      touching[i] = 0;
    }
  }
}

}  // namespace gaitlab::sensors
