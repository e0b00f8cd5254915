#include "app/study/quantity_text.h"

#include "core/settings/wording.h"

namespace gaitlab::app {

std::string objective_text(const studies::JournalHead& head) {
  const std::string unit = objective_unit(head);
  return clipped(head.objectives.front().expression) + (unit.empty() ? "" : "," + unit);
}

std::string objective_unit(const studies::JournalHead& head) {
  const std::string unit = clipped(studies::unit_of(head, head.objectives.front().expression));
  return unit.empty() ? "" : " " + unit;
}

std::string file_name(const std::string& quantity) {
  std::string name;
  for (const char c : quantity) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
    name += plain ? c : '-';
  }
  constexpr std::size_t kLongest = 100;  // longest file name, for quantities that are expressions
  return name.substr(0, kLongest);
}

}  // namespace gaitlab::app
