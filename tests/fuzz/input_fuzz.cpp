// libFuzzer over everything a user writes: the first byte chooses what the rest is. Bad input is an InputError, and what is
// taken can be resolved, and resolved again is itself; anything else that happens is a finding.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "app/app.h"
#include "core/errors.h"
#include "core/scenario/read_scenario.h"
#include "core/scenario/resolved.h"
#include "tests/folder.h"

namespace gaitlab {
namespace {

constexpr const char* kWithBuild = "gaitlab: 1\nrobot: {modules: mtran, build: robot.dat}\nduration: 1\n";
constexpr const char* kWithModule = "gaitlab: 1\nrobot: {modules: module.yaml}\nduration: 1\n";

/// A YAML scalar in double quotes.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n') {
      out += "\\n";
      continue;
    }
    out += c;
  }
  return out + '"';
}

std::string with_equation(const std::string& text) {
  return "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 1\n"
         "cpg: {type: equations, model: {parameters: {a: 2}, states: {phi: " +
         quoted(text) + ", r: \"a*(amplitude - r)\"}, initial: {phi: phase}, output: \"r*sin(phi)\"}}\n";
}

/// One tick of the CPG: whatever its equations give, it comes back.
void turn(const Scenario& scenario) {
  const void* settings = scenario.cpg.settings.get();
  const std::unique_ptr<Cpg> cpg(static_cast<Cpg*>(scenario.cpg.entry->make(info(*scenario.robot), {&settings, 1})));
  const std::vector<double> zeros(scenario.robot->joints.size(), 0.0);
  const Measured measured{0, 0.015, zeros, zeros, zeros, zeros};
  std::vector<double> state(cpg->states());
  std::vector<double> rate(cpg->states());
  std::vector<double> setpoint(scenario.robot->joints.size());
  cpg->start(state);
  cpg->output(0, state, setpoint);
  cpg->derivative(measured, state, rate);
}

void check_resolved(const Scenario& scenario, const test::Folder& folder, Catalog& catalog) {
  const std::string once = resolved(scenario);
  const std::string twice = resolved(read_scenario(folder.write("resolved.yaml", once), {}, catalog));
  if (once == twice) return;
  std::fprintf(stderr, "resolved:\n%s\nresolved again:\n%s\n", once.c_str(), twice.c_str());
  std::abort();
}

void read(char kind, const std::string& text) {
  static const test::Folder folder;
  static Catalog catalog = app::standard_catalog();
  std::string scenario = text;
  if (kind == 'b') {
    folder.write("robot.dat", text);
    scenario = kWithBuild;
  } else if (kind == 'm') {
    folder.write("module.yaml", text);
    scenario = kWithModule;
  } else if (kind == 'e') {
    scenario = with_equation(text);
  }
  try {
    const Scenario read = read_scenario(folder.write("scenario.yaml", scenario), {}, catalog);
    if (kind == 'e') turn(read);
    check_resolved(read, folder, catalog);
  } catch (const InputError&) {
    return;
  }
}

}  // namespace
}  // namespace gaitlab

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  gaitlab::read(static_cast<char>(data[0]), {reinterpret_cast<const char*>(data) + 1, size - 1});
  return 0;
}
