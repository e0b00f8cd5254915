#include "core/scenario/replaced_motors.h"

#include <fmt/format.h>

#include "core/plugin/fields.h"
#include "core/scenario/section_places.h"
#include "core/settings/wording.h"

namespace gaitlab {

ReplacedMotors::ReplacedMotors(const Node& root, const Scenario& scenario, const TypePresets& presets, bool servo)
    : place_(place_of(root, "actuator", "type")),
      actuator_(scenario.actuator.entry->name),
      source_(scenario.actuator_source),
      why_(presets.why()) {
  const Entry& entry = *scenario.actuator.entry;
  const Node* const section = root.find("actuator");
  std::vector<TypeFigures> stated = stated_figures(Kind::actuator, *scenario.robot, *scenario.module_documents);
  if (presets.holds(entry)) {
    if (!servo || section == nullptr) return;
    for (TypeFigures& of : stated) {
      std::erase_if(of.keys, [&](const std::string& key) { return section->find(key) != nullptr; });
      if (!of.keys.empty()) kept_.push_back(std::move(of));
    }
    return;
  }
  dropped_ = std::move(stated);
  std::vector<std::string> assumed;  // keys with a default other than 0 that the section does not set
  for (const DefaultFigure& one : default_figures(entry)) {
    if (section != nullptr && section->find(one.key) != nullptr) continue;
    const bool follows = one.value == kNotStated;  // from other figures, as the manual of the actuator states
    defaults_.push_back(follows ? one.key : fmt::format("{} {}", one.key, with_unit(one.value, one.unit)));
    if (one.value != 0) assumed.push_back(one.key);
  }
  for (const auto& [key, place] : section == nullptr ? std::vector<std::pair<std::string, SourceLocation>>() : section->keys)
    given_ = given_ || (key != "type" && key != "source" && key != kIdentified);
  if (!source_.empty() && !assumed.empty()) source_ = with_defaults(assumed, entry, without_defaults(source_, entry));
}

std::vector<Note> ReplacedMotors::notes() const {
  std::vector<Note> notes;
  for (const TypeFigures& of : kept_) {
    notes.push_back(
        {place_, fmt::format("{} of the motor of module type {} {} beside the servo; give {} under actuator if the servo "
                             "has another",
                             joined(of.keys), clipped(of.module), of.keys.size() == 1 ? "stays" : "stay",
                             of.keys.size() == 1 ? "it" : "them")});
  }
  if (given_ && defaults_.empty()) return notes;
  for (const TypeFigures& of : dropped_) {
    notes.push_back(
        {place_,
         fmt::format(
             "the module type {} states {} for actuator {}, which {} dropped{}: {}; give {} and source under actuator{}",
             clipped(of.module), joined(of.keys), clipped(of.type), of.keys.size() == 1 ? "is" : "are",
             why_.empty() ? "" : fmt::format(" because {}", why_),
             defaults_.empty() ? fmt::format("actuator {} has none of them", actuator_)
                               : fmt::format("actuator {} takes its own {} {}", actuator_,
                                             defaults_.size() == 1 ? "default" : "defaults", fmt::join(defaults_, ", ")),
             defaults_.empty()       ? "its keys"
             : defaults_.size() == 1 ? "this"
                                     : "these",
             why_.empty() ? ", or leave type out" : "")});
  }
  return notes;
}

}  // namespace gaitlab
