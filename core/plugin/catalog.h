// Catalog of everything registered in this program: plugins by kind and name, with their origin, and the engines.
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
  int order = 0;        ///< order of its error in the step; 0: unknown, or the method chooses its steps
  bool adapts = false;  ///< divides its steps as physics.accuracy asks
};

/// A physics engine: its choices for a scenario and its factory.
struct Engine {
  std::string name, manual;
  std::vector<Integrator> integrators;  ///< the first is the default; for a given step, fixed()
  double step = 0;  ///< default step of the integrators that take it as given, s; with choose_step the longest
  std::vector<std::size_t> lanes{1};  ///< possible numbers of rollouts side by side, ascending
  bool rotor_inertia = false;         ///< can add a joint's reflected rotor inertia
  std::unique_ptr<Plant> (*make)(const PlantSettings&) = nullptr;
  double solver_step = 0;  ///< default with contact.law: bullet, s; 0: the engine does not have that law
  /// Chooses the step, s, for `step: auto`, which is then the default; for an engine whose stability limits its steps. 0: no
  /// such step divides the scenario's periods.
  double (*choose_step)(const Scenario&) = nullptr;

  [[nodiscard]] const Integrator* integrator(std::string_view name) const;  ///< nullptr: unknown
  [[nodiscard]] const Integrator* adaptive() const;  ///< the one that chooses its steps, with default step: auto; or nullptr
  [[nodiscard]] const Integrator& fixed() const;     ///< the default for a given step: the first that takes it
  [[nodiscard]] std::vector<std::string> integrator_names() const;
  /// The default where a step is given, s. own_solver: the contact law is that of its solver.
  [[nodiscard]] double given_step(bool own_solver) const { return own_solver && solver_step > 0 ? solver_step : step; }
};

inline constexpr std::string_view kBuiltIn = "built in";  ///< an origin

/// A kind of plugin, with its names in scenarios and messages.
struct PluginKind {
  Kind kind;
  const char* section;       ///< key of the scenario, and name of the kind in messages
  const char* default_type;  ///< type if the section names none
  bool may_be_none;          ///< whether `type: none` is allowed
  const char* about;         ///< description of the section
  const char* about_type;    ///< description of its key `type`
};
inline constexpr std::array<PluginKind, 3> kPluginKinds{{
    {Kind::cpg, "cpg", "phase_oscillator", false, "Pattern generator; without this section the initial angles are held.",
     "Oscillator model or gait; its own keys: gaitlab explain cpg TYPE."},
    {Kind::controller, "controller", "pid", false, "Controller of the joints: from set points to commands.",
     "Joint controller; its own keys: gaitlab explain controller TYPE."},
    {Kind::actuator, "actuator", "dc_motor", true, "The motor of every joint.",
     "Motor model; its own keys: gaitlab explain actuator TYPE."},
}};
const PluginKind& describe(Kind kind);
/// Kind of a section; nullptr: the section has no plugin.
const PluginKind* find_kind(std::string_view section);
inline const char* word(Kind kind) { return describe(kind).section; }

/// Libraries that a scenario may load; loading runs their code.
struct PluginTrust {
  bool all = true;
  std::set<std::string> files = {};  ///< canonical paths
  std::string remedy = {};           ///< part of the message of a refusal: how to allow it
};

class Catalog final : public Registry {
 public:
  Catalog() = default;
  Catalog(Catalog&&) = default;  // no copy: entries point to their origins
  /// Adds an entry. Names are unique within a kind: a second one throws std::invalid_argument naming both origins, as does an
  /// invalid name (valid: a letter, then letters, digits, _ and -).
  void add(const Entry& entry) override;
  void add(const Engine& engine);
  /// Sets the origin of the entries added from now on: kBuiltIn or the path of a library.
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

/// Loads a plugin library into the catalog: canonical path, RTLD_NOW | RTLD_LOCAL, ABI string first, floating-point control
/// register restored, never closed. Loading the same file again does nothing. Throws std::runtime_error if it cannot be opened
/// (with the reason), has no gaitlab_abi (it is not a plugin), has another ABI (with both), duplicates a name, or throws
/// itself.
void load_plugin(const std::string& canonical_path, Catalog& catalog);

}  // namespace gaitlab
