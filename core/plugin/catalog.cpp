#include "core/plugin/catalog.h"

#include <dlfcn.h>

#include <algorithm>
#include <cfenv>
#include <cstdlib>
#include <exception>
#include <map>
#include <mutex>
#include <stdexcept>

#include "core/errors.h"
#include "core/plugin/load_trial.h"
#include "core/plugin/plugin.h"

namespace gaitlab {

namespace {

std::string last_dl_error() {
  const char* text = dlerror();
  return text == nullptr ? "unknown reason" : text;
}

/// Saves the processor's rounding and flushing modes and restores them at the end, because the code of a library that is linked
/// with -ffast-math may change them.
class FloatingPointEnvironment {
 public:
  FloatingPointEnvironment() { std::fegetenv(&environment_); }
  ~FloatingPointEnvironment() { std::fesetenv(&environment_); }
  FloatingPointEnvironment(const FloatingPointEnvironment&) = delete;
  FloatingPointEnvironment& operator=(const FloatingPointEnvironment&) = delete;

 private:
  std::fenv_t environment_ = {};
};

/// Hash that the file had when this process first loaded it; `hash` if this process has not loaded it.
std::string loaded_first(const std::string& path, const std::string& hash) {
  static std::mutex mutex;
  static std::map<std::string, std::string> hashes;
  const std::lock_guard lock(mutex);
  return hashes.emplace(path, hash).first->second;
}

/// True if scenarios, --set and lists with commas can contain the text.
bool is_plugin_name(const std::string& text) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto inside = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-'; };
  return !text.empty() && letter(text.front()) && std::all_of(text.begin(), text.end(), inside);
}

}  // namespace

const PluginKind& describe(Kind kind) {
  return *std::find_if(kPluginKinds.begin(), kPluginKinds.end(), [&](const PluginKind& one) { return one.kind == kind; });
}

const PluginKind* find_kind(std::string_view section) {
  const auto* const at =
      std::find_if(kPluginKinds.begin(), kPluginKinds.end(), [&](const PluginKind& one) { return one.section == section; });
  return at == kPluginKinds.end() ? nullptr : at;
}

void Catalog::add(const Entry& entry) {
  const std::string name(entry.name);
  if (!is_plugin_name(name)) {
    throw std::invalid_argument(std::string(word(entry.kind)) + " '" + name + "' of " + origin_ +
                                " has an invalid name; expected a letter, then letters, digits, `_` and `-`");
  }
  for (const Registered& known : entries_) {
    if (known.entry.kind == entry.kind && known.name == name) {
      throw std::invalid_argument(std::string(word(entry.kind)) + " '" + name + "' is registered twice: by " + known.origin +
                                  " and by " + origin_);
    }
  }
  entries_.push_back({name, origin_, entry});
  entries_.back().entry.origin = entries_.back().origin;
}

void Catalog::add(const Engine& engine) {
  if (this->engine(engine.name) != nullptr) throw std::invalid_argument("engine '" + engine.name + "' is registered twice");
  engines_.push_back(engine);
}

const Entry* Catalog::find(Kind kind, const std::string& name) const {
  for (const Registered& known : entries_) {
    if (known.entry.kind == kind && known.name == name) return &known.entry;
  }
  return nullptr;
}

const Engine* Catalog::engine(const std::string& name) const {
  for (const Engine& engine : engines_) {
    if (engine.name == name) return &engine;
  }
  return nullptr;
}

const Integrator* Engine::integrator(std::string_view wanted) const {
  const auto found = std::ranges::find(integrators, wanted, &Integrator::name);
  return found == integrators.end() ? nullptr : &*found;
}

const Integrator* Engine::adaptive() const {
  const auto found = std::ranges::find(integrators, true, &Integrator::adapts);
  return found == integrators.end() ? nullptr : &*found;
}

const Integrator& Engine::fixed() const { return *std::ranges::find(integrators, false, &Integrator::adapts); }

std::vector<std::string> Engine::integrator_names() const {
  std::vector<std::string> names;
  for (const Integrator& one : integrators) names.push_back(one.name);
  return names;
}

std::vector<std::string> Catalog::names(Kind kind) const {
  std::vector<std::string> names;
  for (const Registered& known : entries_) {
    if (known.entry.kind == kind) names.push_back(known.name);
  }
  return names;
}

std::vector<std::string> Catalog::engines() const {
  std::vector<std::string> names;
  for (const Engine& engine : engines_) names.push_back(engine.name);
  return names;
}

namespace {

/// Calls gaitlab_register of a library. Throws std::runtime_error.
void enter_plugin(void* library, const std::string& path, Catalog& catalog) {
  const auto abi = reinterpret_cast<const char* (*)()>(dlsym(library, "gaitlab_abi"));
  const auto enter = reinterpret_cast<void (*)(Registry&)>(dlsym(library, "gaitlab_register"));
  if (abi == nullptr || enter == nullptr) {
    throw std::runtime_error(path + " is not a gaitlab plugin: it has no " +
                             (abi == nullptr ? "gaitlab_abi" : "gaitlab_register") + " (GAITLAB_PLUGIN makes both)");
  }
  if (std::string_view(abi()) != GAITLAB_ABI) {
    throw std::runtime_error(path + " was built for '" + abi() + "', this program is '" GAITLAB_ABI "': build it again");
  }
  catalog.set_origin(path);
  try {
    enter(catalog);
  } catch (const std::exception& error) {
    catalog.set_origin(std::string(kBuiltIn));
    throw std::runtime_error(path + ": " + error.what());
  } catch (...) {
    catalog.set_origin(std::string(kBuiltIn));
    throw std::runtime_error(path + ": gaitlab_register threw something that is not derived from std::exception");
  }
  catalog.set_origin(std::string(kBuiltIn));
}

}  // namespace

void load_plugin(const std::string& path, const std::string& hash, Catalog& catalog) {
  if (loaded_first(path, hash) != hash)
    throw std::runtime_error("it was built again since this process loaded it; start the program again to run the new code");
  if (catalog.loaded(path)) return;
  const FloatingPointEnvironment restored;
  const bool first = dlopen(path.c_str(), RTLD_LAZY | RTLD_NOLOAD) == nullptr;
  const auto enter = [&](void* library) { enter_plugin(library, path, catalog); };
  if (const std::string fault = first ? load_trial(path, enter) : ""; !fault.empty()) throw std::runtime_error(fault);
  dlerror();
  void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error("cannot load " + path + ": " + last_dl_error());
  // The library is never closed, because its settings and plugins live as long as the program.
  enter(library);
  catalog.set_loaded(path);
}

}  // namespace gaitlab
