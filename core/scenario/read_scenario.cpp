#include "core/scenario/read_scenario.h"

#include <algorithm>
#include <array>

#include "core/files/file_kind.h"
#include "core/scenario/group_section.h"
#include "core/scenario/robot_section.h"
#include "core/scenario/scenario_reader.h"
#include "core/settings/text_file.h"

namespace gaitlab {

Scenario read_scenario(const std::string& path, const std::vector<std::string>& sets, Catalog& catalog) {
  expect_kind(path, FileKind::scenario);
  return ScenarioReader(path, catalog).read(read_text(path), sets);
}

Scenario read_record(const std::string& text, const std::string& file, const std::vector<std::string>& sets, Catalog& catalog) {
  return ScenarioReader(file, catalog, ScenarioReader::ReadAs::record).read(text, sets);
}

Scenario read_module(const std::string& path, Catalog& catalog) {
  return ScenarioReader("module", catalog, ScenarioReader::ReadAs::module_type).read(scenario_of_module(path), {});
}

ScenarioTemplate::ScenarioTemplate(std::string path, std::vector<std::string> sets, Catalog& catalog)
    : path_(std::move(path)),
      sets_(std::move(sets)),
      catalog_(catalog),
      reader_(std::make_unique<ScenarioReader>(path_, catalog)) {
  expect_kind(path_, FileKind::scenario);
  reader_->read(read_text(path_), sets_);
}

ScenarioTemplate::~ScenarioTemplate() = default;

Scenario ScenarioTemplate::with(const std::vector<std::string>& own) const {
  // Settings that determine which keys exist, or that require the robot to be read again.
  const auto whole = [&](const std::string& set) {
    const std::string key = set.substr(0, set.find('='));
    const std::string section = key.substr(0, key.find('.'));
    constexpr std::array kWhole{"gaitlab",          "name",          "plugins",       "robot", kGroupsSection,
                                kTolerancesSection, kAsBuiltSection, kMeasuredSection};
    if (std::ranges::find(kWhole, std::string_view(section)) != kWhole.end() || key.ends_with(".type")) return true;
    if (section == "seed" && reader_->draws_robots()) return true;
    if (key == section && find_kind(section) != nullptr) return true;  // a whole section of a plugin
    // When the template changed the type, it dropped the model of the previous type, to which this setting may refer.
    const auto types = [&](const std::string& one) { return one.starts_with(section + ".type="); };
    return key.starts_with(section + ".model") && std::ranges::any_of(sets_, types);
  };
  // The control period of a robot without a motor depends on further sections.
  if (!reader_->driven() || std::ranges::any_of(own, whole)) {
    std::vector<std::string> all = sets_;
    all.insert(all.end(), own.begin(), own.end());
    return ScenarioReader(path_, catalog_).read(reader_->text(), all);  // the text that was read first
  }
  return reader_->with(own);
}

}  // namespace gaitlab
