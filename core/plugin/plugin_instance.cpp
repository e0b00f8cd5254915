#include "core/plugin/plugin_instance.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace gaitlab {
namespace {

std::string title(const Entry& entry) {
  const bool built_in = entry.origin.empty() || entry.origin == kBuiltIn;
  return fmt::format("{} '{}'{}", word(entry.kind), entry.name, built_in ? "" : fmt::format(" ({})", entry.origin));
}

/// Calls a plugin's function, which may throw any exception. An empty `function` means the constructor; its message is printed
/// alone.
template <class Call>
auto guarded(const Entry& entry, const char* function, Call call) {
  const auto before = [&] { return *function == '\0' ? std::string() : fmt::format("{} threw: ", function); };
  try {
    return call();
  } catch (const SettingError& error) {
    throw PluginError(entry, before() + error.what(), error.key());
  } catch (const std::exception& error) {
    throw PluginError(entry, before() + error.what());
  } catch (...) {
    throw PluginError(entry, before() + "something that is not derived from std::exception");
  }
}

template <class T>
std::unique_ptr<T> made(const Entry& entry, const RobotInfo& robot, std::span<const void* const> settings) {
  return guarded(entry, "", [&] { return std::unique_ptr<T>(static_cast<T*>(entry.make(robot, settings))); });
}

class GuardedCpg final : public Cpg {
 public:
  GuardedCpg(const Entry& entry, std::unique_ptr<Cpg> cpg) : entry_(entry), cpg_(std::move(cpg)) {}
  [[nodiscard]] std::size_t states() const override {
    return guarded(entry_, "states", [&] { return cpg_->states(); });
  }
  [[nodiscard]] std::string state_name(std::size_t index) const override {
    return guarded(entry_, "state_name", [&] { return cpg_->state_name(index); });
  }
  void start(Out x) const override {
    guarded(entry_, "start", [&] { cpg_->start(x); });
  }
  void derivative(const Measured& m, In x, Out rate) const override {
    guarded(entry_, "derivative", [&] { cpg_->derivative(m, x, rate); });
  }
  void event(const Measured& m, Out x) const override {
    guarded(entry_, "event", [&] { cpg_->event(m, x); });
  }
  void output(double t, In x, Out setpoint) const override {
    guarded(entry_, "output", [&] { cpg_->output(t, x, setpoint); });
  }
  [[nodiscard]] std::string note() const override {
    return guarded(entry_, "note", [&] { return cpg_->note(); });
  }
  [[nodiscard]] SetPointTimes times() const override {
    return guarded(entry_, "times", [&] { return cpg_->times(); });
  }

 private:
  const Entry& entry_;
  std::unique_ptr<Cpg> cpg_;
};

class GuardedController final : public Controller {
 public:
  GuardedController(const Entry& entry, std::unique_ptr<Controller> controller)
      : entry_(entry), controller_(std::move(controller)) {}
  [[nodiscard]] std::string_view command_unit() const override {
    return guarded(entry_, "command_unit", [&] { return controller_->command_unit(); });
  }
  [[nodiscard]] std::size_t states() const override {
    return guarded(entry_, "states", [&] { return controller_->states(); });
  }
  void start(Out x) const override {
    guarded(entry_, "start", [&] { controller_->start(x); });
  }
  void update(const Measured& m, In setpoint, In limit, Out x, Out command) const override {
    guarded(entry_, "update", [&] { controller_->update(m, setpoint, limit, x, command); });
  }
  [[nodiscard]] std::vector<PositionGains> gains() const override {
    return guarded(entry_, "gains", [&] { return controller_->gains(); });
  }
  [[nodiscard]] std::string note() const override {
    return guarded(entry_, "note", [&] { return controller_->note(); });
  }

 private:
  const Entry& entry_;
  std::unique_ptr<Controller> controller_;
};

/// Actuator that checks the results of a plugin. `passive` contains the indices joint * lanes + lane of joints without a motor,
/// whose torques are not used.
class GuardedActuator final : public Actuator {
 public:
  GuardedActuator(const Entry& entry, std::unique_ptr<Actuator> actuator, std::size_t size, std::vector<std::size_t> passive)
      : entry_(entry), actuator_(std::move(actuator)), size_(size), passive_(std::move(passive)) {
    if (passive_.empty()) return;
    const auto copy = [](const auto& from, auto& to) { to.assign(from.begin(), from.end()); };
    copy(own_limit(), limit_);
    copy(own_inertia(), inertia_);
    copy(own_ratings(), ratings_);
    copy(own_friction(), friction_);
    for (const std::size_t i : passive_) {
      limit_[i] = 0;
      if (!inertia_.empty()) inertia_[i] = 0;
      if (!ratings_.empty()) ratings_[i] = {};
      if (!friction_.empty()) friction_[i] = {};
    }
  }
  [[nodiscard]] std::string_view command_unit() const override {
    return guarded(entry_, "command_unit", [&] { return actuator_->command_unit(); });
  }
  [[nodiscard]] In command_limit() const override { return passive_.empty() ? own_limit() : In(limit_); }
  [[nodiscard]] In reflected_inertia() const override { return passive_.empty() ? own_inertia() : In(inertia_); }
  void effort(In command, In speed, Out torque, Out slope) const override {
    guarded(entry_, "effort", [&] { actuator_->effort(command, speed, torque, slope); });
    silence({torque, slope});
  }
  void electrical(In command, In speed, Electrical out) const override {
    guarded(entry_, "electrical", [&] { actuator_->electrical(command, speed, out); });
    silence({out.voltage, out.current, out.saturation, out.power_in, out.copper, out.gear});
  }
  [[nodiscard]] std::span<const DriveRatings> ratings() const override {
    return passive_.empty() ? own_ratings() : std::span<const DriveRatings>(ratings_);
  }
  [[nodiscard]] std::span<const JointFriction> friction() const override {
    return passive_.empty() ? own_friction() : std::span<const JointFriction>(friction_);
  }
  void unlimited(In command, In speed, Out torque, Out slope) const override {
    guarded(entry_, "unlimited", [&] { actuator_->unlimited(command, speed, torque, slope); });
    silence({torque, slope});
  }
  [[nodiscard]] const DcMotor* dc_motors() const override {
    return guarded(entry_, "dc_motors", [&] { return actuator_->dc_motors(); });
  }

 private:
  [[nodiscard]] In own_limit() const {
    return sized("command_limit", guarded(entry_, "command_limit", [&] { return actuator_->command_limit(); }));
  }
  [[nodiscard]] In own_inertia() const {
    const In inertia = guarded(entry_, "reflected_inertia", [&] { return actuator_->reflected_inertia(); });
    return inertia.empty() ? inertia : sized("reflected_inertia", inertia);
  }
  [[nodiscard]] std::span<const DriveRatings> own_ratings() const {
    const std::span<const DriveRatings> stated = guarded(entry_, "ratings", [&] { return actuator_->ratings(); });
    return stated.empty() ? stated : sized("ratings", stated);
  }
  [[nodiscard]] std::span<const JointFriction> own_friction() const {
    const std::span<const JointFriction> stated = guarded(entry_, "friction", [&] { return actuator_->friction(); });
    return stated.empty() ? stated : sized("friction", stated);
  }
  void silence(std::initializer_list<Out> values) const {
    for (const Out one : values) {
      for (const std::size_t i : passive_) one[i] = 0;
    }
  }

  template <class Values>
  [[nodiscard]] Values sized(const char* function, Values values) const {
    if (values.size() == size_) return values;
    throw PluginError(entry_,
                      fmt::format("{} has {} numbers; expected {}, one per joint and lane", function, values.size(), size_));
  }

  const Entry& entry_;
  std::unique_ptr<Actuator> actuator_;
  std::size_t size_;
  std::vector<std::size_t> passive_;
  std::vector<double> limit_, inertia_;
  std::vector<DriveRatings> ratings_;
  std::vector<JointFriction> friction_;
};

template <class Guard, class T>
std::unique_ptr<T> make(const PluginSelection& selection, const RobotInfo& robot) {
  if (selection.entry == nullptr) return {};
  const void* const settings = selection.settings.get();
  return std::make_unique<Guard>(*selection.entry, made<T>(*selection.entry, robot, {&settings, 1}));
}

}  // namespace

PluginError::PluginError(const Entry& entry, const std::string& what, std::string at)
    : RunError(title(entry) + ": " + what), kind(entry.kind), key(std::move(at)) {}

std::shared_ptr<void> default_settings(const Entry& entry) {
  return guarded(entry, "Settings", [&] { return entry.settings(entry); });
}

void visit_settings(const Entry& entry, void* settings, Fields& fields) {
  guarded(entry, "fields", [&] { entry.fields(settings, fields); });
}

std::unique_ptr<Cpg> make_cpg(const PluginSelection& selection, const RobotInfo& robot) {
  return make<GuardedCpg, Cpg>(selection, robot);
}

std::unique_ptr<Controller> make_controller(const PluginSelection& selection, const RobotInfo& robot) {
  return make<GuardedController, Controller>(selection, robot);
}

std::unique_ptr<Sensor> make_sensor(const PluginSelection& selection, const SensorSite& site) {
  const Entry& entry = *selection.entry;
  return guarded(entry, "", [&] { return std::unique_ptr<Sensor>(entry.make_sensor(site, selection.settings.get())); });
}

std::unique_ptr<Actuator> make_actuator(std::span<const PluginSelection* const> lanes, const RobotInfo& robot) {
  const Entry* entry = lanes.front()->entry;
  if (entry == nullptr) return {};
  std::vector<const void*> settings;
  for (const PluginSelection* lane : lanes) settings.push_back(lane->settings.get());
  std::vector<std::size_t> passive;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    for (std::size_t l = 0; l < lanes.size() && !robot.joints[j].driven; ++l) passive.push_back(j * lanes.size() + l);
  }
  return std::make_unique<GuardedActuator>(*entry, made<Actuator>(*entry, robot, settings), robot.joints.size() * lanes.size(),
                                           std::move(passive));
}

std::unique_ptr<Actuator> make_actuator(const PluginSelection& selection, const RobotInfo& robot) {
  const PluginSelection* const one = &selection;
  return make_actuator({&one, 1}, robot);
}

}  // namespace gaitlab
