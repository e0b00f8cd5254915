#include "core/scenario/replaced_motors.h"

#include <fmt/format.h>

#include "core/plugin/plugin_instance.h"
#include "core/scenario/section_places.h"
#include "core/settings/wording.h"

namespace gaitlab {

namespace {

/// The figures of a motor that an actuator has by default. What is one for all joints is of its law, and no figure.
class Defaults final : public Fields {
 public:
  struct Default {
    std::string key, unit;
    double value;
  };
  void visit(const Field& field) override {
    const auto* each = std::get_if<field::EachJoint>(&field.value);
    if (each == nullptr) return;
    const bool limit = each->role == field::Role::limit && each->usual == nullptr;
    const bool set = each->role == field::Role::setting && each->value.common != 0;
    if (limit || set) found.push_back({field.key, each->spec.unit, each->value.common});
  }
  void problem_at(const char*, std::string_view, std::size_t, std::string_view) override {}

  std::vector<Default> found;
};

}  // namespace

ReplacedMotors::ReplacedMotors(const Node& root, const Scenario& scenario, const TypePresets& presets)
    : place_(place_of(root, "actuator", "type")),
      actuator_(scenario.actuator.entry->name),
      source_(scenario.actuator_source),
      why_(presets.why()) {
  const Entry& entry = *scenario.actuator.entry;
  if (presets.holds(entry)) return;
  dropped_ = dropped_figures(Kind::actuator, *scenario.robot, *scenario.module_documents, presets, entry);
  const Node* const section = root.find("actuator");
  Defaults defaults;
  visit_settings(entry, default_settings(entry).get(), defaults);
  for (const Defaults::Default& one : defaults.found) {
    if (section != nullptr && section->find(one.key) != nullptr) continue;
    defaults_.push_back(fmt::format("{} {}", one.key, with_unit(one.value, one.unit)));
    if (one.value != 0) assumed_.push_back(one.key);
  }
  for (const auto& [key, place] : section == nullptr ? std::vector<std::pair<std::string, SourceLocation>>() : section->keys)
    given_ = given_ || (key != "type" && key != "source");
}

std::vector<Note> ReplacedMotors::notes() const {
  std::vector<Note> notes;
  if (given_ && defaults_.empty()) return notes;
  for (const DroppedFigures& of : dropped_) {
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

std::string ReplacedMotors::source() const {
  if (source_.empty() || assumed_.empty()) return source_;
  return fmt::format("chosen: {} by default of {}; the rest: {}", fmt::join(assumed_, ", "), actuator_, source_);
}

}  // namespace gaitlab
