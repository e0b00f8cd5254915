#include "sensors/load.h"

#include <array>

#include "sensors/parts.h"

namespace gaitlab::sensors {

const char* const LoadSensor::kManual =
    R"(Load of modules, bodies, joints or legs: the sum of the normal forces on their contact elements.

    touches: on above `touch`, off below `release`, unchanged in between

CPG and controller get `touches` of these modules in place of the true contact (a force above 0), and the load of these joints,
which is that of the link that a joint moves, in place of the true one (Measured::load; `load` and `limb_load` in equations). The
loads of modules, bodies and legs are separate values (Measured::channels). Trace columns sensor.NAME.MODULE,
sensor.NAME.MODULE.touching, sensor.NAME.BODY, sensor.NAME.JOINT.link and sensor.NAME.LEG. The keys are those of a channel
(docs/real-robot.md). Every part has its own draws. A robot without contact elements measures 0.
Source: none. Defaults (chosen): an exact sensor, `touch` 1 N and `release` 0.5 N.

    sensors:
      feet: {type: load, modules: [m5, m6], noise: 0.2}
      legs: {type: load, legs: ["*"]})";

void LoadSensor::Settings::fields(Fields& f) {
  f.names("joints", joints, Among::joints, "Joints whose link's load is measured: a name, a pattern, or a list.");
  f.texts("legs", legs, "Legs whose load is measured: a list of names, such as front_left, and patterns (gaitlab check).");
  if (!joints.empty() || !legs.empty()) modules.clear();
  f.names("modules", modules, Among::modules,
          "Modules whose load is measured: a name such as m5, a pattern, or a list; [] for none, the default beside joints "
          "or legs.");
  f.names("bodies", bodies, Among::bodies, "Bodies whose load is measured, such as m5/passive.");
  ChannelKeys::fields(f);
  f.number("touch", touch, {"N", -1e9, 1e9, "Measured load above which a module touches."});
  f.number("release", release, {"N", -1e9, 1e9, "Measured load below which a module no longer touches; at most `touch`."});
  if (release > touch) f.problem("release", "release is above touch; expected at most touch");
}

LoadSensor::LoadSensor(const SensorSite& site, const Settings& settings) : touch_(settings.touch), release_(settings.release) {
  const auto add = [&](Of of, const std::vector<std::size_t>& parts, const std::vector<std::string>& names, const char* what) {
    for (const std::size_t i : parts) {
      const std::string name =
          site.name + "." + names[i] + (of == Of::joint ? ".link" : "");  // a body may have the joint's name
      channels_.add(Channel(settings, site, name));
      parts_.push_back({of, i});
      readings_.push_back({name, "sensor." + name, "N",
                           "normal force measured by the sensor, in force just before t, of " + std::string(what) + names[i]});
      if (of == Of::joint) {
        readings_.back().replaces = Replaces::load;
        readings_.back().part = i;
      }
    }
  };
  const std::vector<std::string> modules = module_names_of(site.robot);
  add(Of::module, matching(settings.modules, modules), modules, "module ");
  modules_ = parts_.size();
  const std::vector<std::string> bodies = body_names_of(site.robot);
  add(Of::body, matching(settings.bodies, bodies), bodies, "body ");
  const std::vector<std::string> joints = joint_names_of(site.robot);
  add(Of::joint, matching(settings.joints, joints), joints, "the link of joint ");
  std::vector<std::string> legs;
  for (const Leg& leg : site.robot.legs) {
    legs.push_back(leg.name);
    bodies_.emplace_back(leg.bodies.begin(), leg.bodies.end());
  }
  for (const std::string& pattern : settings.legs) {
    if (!matching({pattern}, legs).empty()) continue;
    std::string known;
    for (const std::string& name : legs) known += (known.empty() ? "" : ", ") + name;
    throw SettingError("legs", "legs: '" + pattern.substr(0, 40) + "' matches no leg; " +
                                   (legs.empty() ? "the robot has none" : "the legs are " + known));
  }
  add(Of::leg, matching(settings.legs, legs), legs, "leg ");
  leg_load_.resize(legs.size());
  for (std::size_t i = 0; i < modules_; ++i) {
    const std::string name = readings_[i].name + ".touching";
    readings_.push_back({name, "sensor." + name, "",
                         "1 while the sensor reports contact, of module " + modules[parts_[i].number], Replaces::touching,
                         parts_[i].number});
  }
}

void LoadSensor::sense(const Truth& truth, Out state, Out values) const {
  const std::size_t loads = parts_.size();
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    leg_load_[k] = 0;
    for (const std::size_t body : bodies_[k]) leg_load_[k] += truth.body_load[body];
  }
  const std::array<In, 4> loads_of{truth.module_load, truth.body_load, truth.load, leg_load_};
  const auto one = [&](std::size_t i) { return loads_of[static_cast<std::size_t>(parts_[i].of)].subspan(parts_[i].number, 1); };
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
