#include "interchange/mjcf_compiled.h"

#include <fmt/format.h>

#include <set>
#include <string>
#include <utility>

#include "core/settings/wording.h"

namespace gaitlab::interchange {

namespace {

/// Compiles the text with some of its meshes. Attributes that libmujoco lacks are dropped one after the other, as its messages
/// name them.
MjcfRobot compiled(MjcfText& text, const std::set<std::size_t>& meshes, std::vector<std::string>& warnings) {
  for (;;) {
    CompiledMjcf made = compile_mjcf(text.text(meshes), text.file());
    warnings = made.warnings;
    if (!made.error) return std::move(made.model);
    const MjcfError& error = *made.error;
    const std::size_t quote = error.text.find('\'');
    const std::string name = quote == std::string::npos ? "" : error.text.substr(quote + 1, error.text.rfind('\'') - quote - 1);
    const bool unknown = error.text.starts_with("unrecognized ");
    if (unknown && text.drop_attribute(error.element, name)) continue;
    const std::string of = error.element.empty() ? "" : fmt::format(" of <{}>", error.element);
    if (error.text.starts_with("unrecognized element")) {
      throw InputError(text.place(error.line),
                       fmt::format("<{}> is not an element that libmujoco 2.2.2, which reads MJCF, knows at "
                                   "this place",
                                   error.element));
    }
    if (unknown) {
      throw InputError(text.place(error.line),
                       fmt::format("{}{} is unknown to libmujoco 2.2.2, which reads MJCF", in_quotes(name), of));
    }
    throw InputError(text.place(error.line),
                     fmt::format("{}{}{}", error.text.starts_with("is not") ? "" : "libmujoco: ", error.text, of));
  }
}

}  // namespace

MjcfRobot compiled(MjcfText& text, std::vector<RobotNote>& notes) {
  std::vector<std::string> warnings;
  const MjcfRobot drawn = compiled(text, {}, warnings);
  if (drawn.bodies.size() != text.bodies() + 1)
    throw InputError(SourceLocation{text.file()}, "has an element in the place of several bodies; write them out");
  std::set<std::size_t> needed;
  for (std::size_t b = 1; b < drawn.bodies.size(); ++b) {
    for (const MjcfGeom& geom : drawn.bodies[b].geoms) {
      const bool collides = geom.contype != 0 || geom.conaffinity != 0 || text.paired().contains(geom.name);
      if (geom.type == MjcfGeom::Type::mesh && (collides || !text.states_inertia(b))) needed.insert(geom.mesh);
    }
  }
  MjcfRobot made = compiled(text, needed, warnings);
  for (const std::string& one : warnings) {
    if (one.find("NaN") != std::string::npos)
      throw InputError(SourceLocation{text.file()}, "has a NaN; expected finite numbers");
    notes.push_back({{text.file()}, "libmujoco: " + one.substr(0, one.find('\n')), true});
  }
  return made;
}

}  // namespace gaitlab::interchange
