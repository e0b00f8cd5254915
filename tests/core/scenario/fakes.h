// Fakes for tests of scenarios: plugins, an engine, a module of two bodies, and a temporary folder.
#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>

#include "core/scenario/scenario.h"
#include "tests/folder.h"

namespace gaitlab::fakes {

struct Motor : Actuator {
  struct Settings {
    PerJoint R{4.3};
    double i_max = 1.2;
    void fields(Fields& f) {
      f.per_joint("R", R, {"Ohm", 1e-3, 1e3, "Resistance."});
      f.number("i_max", i_max, {"A", 0, 100, "Largest current."});
    }
  };
  Motor(const RobotInfo&, const std::vector<const Settings*>&) {}
  [[nodiscard]] std::string_view command_unit() const override { return "V"; }
  [[nodiscard]] In command_limit() const override { return {}; }
  void effort(In, In, Out, Out) const override {}
  void electrical(In, In, Electrical) const override {}
};

struct Torque final : Motor {
  using Motor::Motor;
  [[nodiscard]] std::string_view command_unit() const override { return "N m"; }
};

struct Pid : Controller {
  struct Settings {
    double Kp = 100;
    bool anti_windup = true;
    void fields(Fields& f) {
      f.number("Kp", Kp, {"V/rad", 0, 1e6, "Gain."});
      f.flag("anti_windup", anti_windup, "Hold the integral at the limit.");
    }
  };
  Pid(const RobotInfo&, const Settings&) {}
  [[nodiscard]] std::string_view command_unit() const override { return "V"; }
  void update(const Measured&, In, In, Out, Out) const override {}
};

struct Hold final : Controller {
  struct Settings {
    void fields(Fields&) {}
  };
  Hold(const RobotInfo&, const Settings&) {}
  [[nodiscard]] std::string_view command_unit() const override { return ""; }
  void update(const Measured&, In, In, Out, Out) const override {}
};

struct Link {
  std::int64_t from = 0, to = 0;
  double weight = 1;
  void fields(Fields& f) {
    f.joint("from", from, "The joint that is followed.");
    f.joint("to", to, "The joint that follows.");
    f.number("weight", weight, {"1/s", -1000, 1000, "Pull."});
  }
};

struct CommonKeys {
  PerJoint frequency{0.25}, amplitude{0.6};
  enum class Rule { chain };
  std::optional<Rule> rule = Rule::chain;
  std::vector<Link> couplings;
  void fields(Fields& f) {
    static constexpr const char* kRules[] = {"chain"};
    f.per_joint("frequency", frequency, {"Hz", 0, 20, "Own frequency."});
    f.per_joint("amplitude", amplitude, {"rad", 0, 3.2, "Peak set point."});
    f.rule_or_list("couplings", rule, kRules, couplings, "chain, or a list.");
  }
};

struct Phase : Cpg {
  struct Model {
    double rate = 2;
    void fields(Fields& f) { f.number("rate", rate, {"1/s", 0, 100, "Rate."}); }
  };
  struct Settings : CommonKeys {
    Model model;
    void fields(Fields& f) {
      CommonKeys::fields(f);
      f.group("model", model, "Keys of this model.");
    }
  };
  Phase(const RobotInfo&, const Settings&) {}
  void output(double, In, Out) const override {}
  [[nodiscard]] std::string note() const override { return "starts at phase 0"; }
};

struct Hopf final : Cpg {
  struct Model {
    double mu = 1;
    void fields(Fields& f) { f.number("mu", mu, {"", 0, 100, "Size."}); }
  };
  struct Settings : CommonKeys {
    Model model;
    std::vector<double> table;
    std::vector<std::string> labels{"a b", "5"};
    std::string expression = "x + 1";
    void fields(Fields& f) {
      CommonKeys::fields(f);
      f.group("model", model, "Keys of this model.");
      f.numbers("table", table, {"rad", -10, 10, "Numbers."});
      f.texts("labels", labels, "Texts.");
      f.text("expression", expression, "A text.");
      if (model.mu > 50) f.problem("model", "mu and the table do not go together");
    }
  };
  Hopf(const RobotInfo&, const Settings&) {}
  void output(double, In, Out) const override {}
};

struct Picky final : Cpg {
  struct Settings {
    void fields(Fields&) {}
  };
  Picky(const RobotInfo&, const Settings&) { throw std::runtime_error("needs six legs; the robot has none"); }
  void output(double, In, Out) const override {}
};

inline void fill(Catalog& catalog, const char* engine_name = "bullet") {
  add_actuator<Motor>(catalog, "dc_motor", "A motor.");
  add_actuator<Torque>(catalog, "torque", "A torque.");
  add_controller<Pid>(catalog, "pid", "A controller.\n");
  add_controller<Hold>(catalog, "hold", "Holds.");
  add_cpg<Phase>(catalog, "phase_oscillator", "Phases.");
  add_cpg<Hopf>(catalog, "hopf", "Hopf.");
  add_cpg<Picky>(catalog, "picky", "Refuses.");
  Engine engine;
  engine.name = engine_name;
  engine.integrators = {{"semi_implicit", 1}, {"rk4", 4}};
  engine.step = 2.5e-5;
  catalog.add(engine);
}

/// Module file of two bodies and a hinge. Face 1 (active) is at -x, face 4 (passive) at +x.
inline constexpr const char* kDuo = R"(gaitlab_module: 1
name: duo
bodies:
  a: {mass: 1, inertia: [1, 1, 1, 0, 0, 0], source: "chosen: a, b"}
  b:
    mass: 0.5
    com: [0.1, 0, 0]
    inertia: [1, 2, 2, 0, 0, 0]
    shape:
      - {box: [0.1, 0.1, 0.1]}
hinges:
  - {name: h, parent: a, child: b, origin: [0.05, 0, 0], axis: [0, 2, 0], range: [-1.5, 1.5]}
faces:
  - {id: 1, body: a, gender: active, origin: [0, 0, 0], normal: [-1, 0, 0], reference: [0, 1, 0]}
  - {id: 4, body: b, gender: passive, origin: [0.1, 0, 0], normal: [1, 0, 0], reference: [0, 1, 0]}
contacts:
  feet: [{body: b, point: [0.1, 0, -0.1]}]
  all: [{body: a, sphere: [0, 0, 0], radius: 0.1}]
)";

/// Temporary folder with a module type. `shown` replaces the folder's path in error messages by DIR.
class Folder : public test::Folder {
 public:
  Folder() {
    std::filesystem::create_directories(path() + "/modules");
    write("modules/duo.yaml", kDuo);
  }
  [[nodiscard]] std::string path() const { return test::Folder::path().string(); }

  /// Text with this folder's path replaced by DIR.
  [[nodiscard]] std::string shown(std::string text) const {
    const std::string path = this->path();
    for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path)) text.replace(at, path.size(), "DIR");
    return text;
  }
};

}  // namespace gaitlab::fakes
