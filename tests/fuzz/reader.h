// A reader of files that may be hostile, and what all readers share: a folder, the catalog, a scenario.
#pragma once
#include <string>
#include <string_view>

#include "app/app.h"
#include "tests/folder.h"

namespace gaitlab::fuzz {

struct Reader {
  std::string_view name;
  void (*read)(const std::string& bytes);
};

inline const test::Folder& folder() {
  static const test::Folder made;
  return made;
}

inline Catalog& catalog() {
  static Catalog made = app::standard_catalog();
  return made;
}

inline constexpr const char* kTwo =
    "gaitlab: 1\nname: two\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nphysics: {engine: articulated}\n"
    "cpg: {type: phase_oscillator}\nduration: 0.3\n";

}  // namespace gaitlab::fuzz
