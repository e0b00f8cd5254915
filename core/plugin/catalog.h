// Catalog of the engines, and of all plugins that are registered in this program, by kind and name with their origin.
#pragma once
#include <array>
#include <deque>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/plugin/registry.h"

namespace gaitlab {

class Plant;
struct PlantSettings;
struct Scenario;

/// A method of time integration.
struct Integrator {
  std::string name;
  int order = 0;         ///< order of the error in the step; 0 if unknown or if the method chooses its steps
  bool adapts = false;   ///< true if the integrator divides its steps according to physics.accuracy
  bool limited = false;  ///< true for an explicit method, whose steps stability limits
};

/// A physics engine: its possible settings, and a function that makes it.
struct Engine {
  std::string name, manual;
  std::vector<Integrator> integrators;  ///< the first one is the default; fixed() is the default for a given step
  double step = 0;                      ///< default step of integrators with a given step, s
  std::vector<std::size_t> lanes{1};    ///< possible numbers of rollouts side by side, ascending
  bool rotor_inertia = false;           ///< true if the engine can add a joint's reflected rotor inertia
  std::unique_ptr<Plant> (*make)(const PlantSettings&) = nullptr;
  double solver_step = 0;  ///< default step with contact.law `bullet`, s; 0 if the engine lacks that law
  /// Function that chooses the step, s, of explicit integrators for `step: auto`, which is then their default. Null without
  /// such a function. It returns 0 if no stable step divides the scenario's periods.
  double (*choose_step)(const Scenario&) = nullptr;
  double longest_step = 0;  ///< longest step that choose_step returns, s

  [[nodiscard]] const Integrator* integrator(std::string_view name) const;  ///< null if the name is unknown
  /// Integrator that chooses its steps and has the default `step: auto`. Null if the engine has none.
  [[nodiscard]] const Integrator* adaptive() const;
  /// Default for a given step: the first integrator that does not choose its steps.
  [[nodiscard]] const Integrator& fixed() const;
  [[nodiscard]] std::vector<std::string> integrator_names() const;
  /// Default step for integrators with a given step, s. `own_solver` is true if the engine's own solver defines the contact
  /// law.
  [[nodiscard]] double given_step(bool own_solver) const { return own_solver && solver_step > 0 ? solver_step : step; }
};

inline constexpr std::string_view kBuiltIn = "built in";  ///< origin of plugins that belong to the program

/// A kind of plugin, with its names in scenarios and messages. If a scenario may have several plugins of a kind, the kind does
/// not have a separate section or a default type.
struct PluginKind {
  Kind kind;
  const char* section;       ///< key of the scenario, and name of the kind in messages
  const char* default_type;  ///< type that is used if the section names none
  bool may_be_none;          ///< true if `type: none` is allowed
  bool several;              ///< true if a scenario may have several of this kind, each under a name
  const char* about;         ///< description of the section
  const char* about_type;    ///< description of its key `type`
};
inline constexpr std::array<PluginKind, 4> kPluginKinds{{
    {Kind::cpg, "cpg", "phase_oscillator", false, false, "Pattern generator; without this section the initial angles are held.",
     "Oscillator model or gait; its keys: gaitlab explain cpg TYPE."},
    {Kind::controller, "controller", "pid", false, false, "Controller of the joints: from set points to commands.",
     "Joint controller; its keys: gaitlab explain controller TYPE."},
    {Kind::actuator, "actuator", "dc_motor", true, false, "The motor of every joint.",
     "Motor model; its keys: gaitlab explain actuator TYPE."},
    {Kind::sensor, "sensor", "", false, true, "A sensor.", "Sensor type; its keys: gaitlab explain sensor TYPE."},
}};
const PluginKind& describe(Kind kind);
/// Kind of plugin by its name, which is also the name of the section that selects a single plugin; or null.
const PluginKind* find_kind(std::string_view section);
inline const char* word(Kind kind) { return describe(kind).section; }

/// Plugin libraries that a scenario may load. A loaded library can run any code.
struct PluginTrust {
  bool all = true;
  std::set<std::string> files = {};  ///< canonical paths of the permitted libraries
  std::string remedy = {};           ///< part of the message of a refusal that explains how to permit the library
};

class Catalog final : public Registry {
 public:
  Catalog() = default;
  Catalog(Catalog&&) = default;  // not copied, because entries point to their origins
  /// Adds an entry. Its name must begin with a letter, followed by letters, digits, _ and -. Throws std::invalid_argument for
  /// any other name and, with the origins of both entries, if the kind already has an entry with this name.
  void add(const Entry& entry) override;
  void add(const Engine& engine);
  /// Sets the origin of the entries that are added afterwards: kBuiltIn, or the path of a library.
  void set_origin(std::string origin) { origin_ = std::move(origin); }
  void set_loaded(const std::string& path) { loaded_.insert(path); }
  [[nodiscard]] bool loaded(const std::string& path) const { return loaded_.contains(path); }

  void set_trust(PluginTrust trust) { trust_ = std::move(trust); }
  [[nodiscard]] const PluginTrust& trust() const { return trust_; }

  [[nodiscard]] const Entry* find(Kind kind, const std::string& name) const;
  [[nodiscard]] const Engine* engine(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> names(Kind kind) const;
  [[nodiscard]] std::vector<std::string> engines() const;

 private:
  struct Registered {
    std::string name, origin;
    Entry entry;
  };
  std::deque<Registered> entries_;
  std::deque<Engine> engines_;
  std::set<std::string> loaded_;
  std::string origin_{kBuiltIn};
  PluginTrust trust_;
};

/// Loads a plugin library into the catalog, from its canonical path, with RTLD_NOW | RTLD_LOCAL. The ABI text is compared
/// first, the floating-point control register is restored, and the library is never closed. A second call for the same file has
/// no effect. `hash` is the hash of the file's content. Throws std::runtime_error if the file cannot be opened, lacks
/// gaitlab_abi and is therefore no plugin, has another ABI, registers a name twice, or throws an exception. Also throws if this
/// process has loaded a file with this path and another hash before, because the old code would run.
void load_plugin(const std::string& canonical_path, const std::string& hash, Catalog& catalog);

}  // namespace gaitlab
