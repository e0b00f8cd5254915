#include "core/scenario/old_names.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/settings/wording.h"

namespace gaitlab {

namespace {

struct OldName {
  const char *section, *old, *present;
};
constexpr OldName kOldNames[] = {{"limits", "margin", "warn_share"}};

std::ptrdiff_t place_in(const Node& map, const char* key) {
  return std::ranges::find(map.keys, key, [](const auto& one) { return one.first; }) - map.keys.begin();
}

void take_out(Node& map, std::ptrdiff_t at) {
  map.keys.erase(map.keys.begin() + at);
  map.items.erase(map.items.begin() + at);
}

void rename(const OldName& name, Node& section, const std::vector<std::string>& sets, Problems& problems) {
  const std::ptrdiff_t old = place_in(section, name.old);
  const std::ptrdiff_t present = place_in(section, name.present);
  const auto count = static_cast<std::ptrdiff_t>(section.keys.size());
  if (old == count) return;
  section.keys[static_cast<std::size_t>(old)].first = name.present;
  if (present == count) return;
  const auto place = [&](std::ptrdiff_t at) { return section.items[static_cast<std::size_t>(at)].place; };
  const auto is_set = [&](std::ptrdiff_t at) {
    return std::ranges::any_of(sets, [&](const std::string& set) { return place(at).file == "--set " + clipped(set); });
  };
  if (is_set(present) == is_set(old)) {
    problems
        .add(place(old), fmt::format("{0}.{1} is the old name of {0}.{2}, which is given, too; expected one of them",
                                     name.section, name.old, name.present))
        .notes.emplace_back(place(present), fmt::format("{}.{} is here", name.section, name.present));
  }
  take_out(section, is_set(present) ? old : present);
}

}  // namespace

void rename_old_names(Node& root, const std::vector<std::string>& sets, Problems& problems) {
  for (const OldName& name : kOldNames) {
    const std::ptrdiff_t at = place_in(root, name.section);
    if (at < static_cast<std::ptrdiff_t>(root.keys.size()))
      rename(name, root.items[static_cast<std::size_t>(at)], sets, problems);
  }
}

}  // namespace gaitlab
