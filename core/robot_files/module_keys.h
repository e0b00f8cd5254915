// Keys of module files, each declared once: reader, manual, reference page and JSON Schema loop over this list.
#pragma once
#include <span>
#include <string_view>

#include "core/plugin/fields.h"

namespace gaitlab {

/// Form of a value in a module file.
enum class ModuleForm { text, number, integer, flag, vector, integers, word, map, list, pairs };

struct ModuleMap;

struct ModuleKey {
  const char* key;
  ModuleForm form;
  Spec spec = {"", 0, 0, ""};  ///< unit, range and sentence
  bool required = false;
  const char* preset = "";                  ///< default as JSON; "" if the key has none
  std::size_t size = 0;                     ///< number of elements of a vector
  std::span<const char* const> words = {};  ///< permitted words; instead of a value of another form if `form` is not `word`
  const ModuleMap* map = nullptr;           ///< keys of a map, or of each map in a list or by name; null for those of a plugin
  bool by_name = false;                     ///< true if the value is a map of such maps by names
  bool passive = false;                     ///< true for a key of hinges without a motor
};

/// A map of a module file with its permitted keys. Exactly one of the keys `one_of` is given.
struct ModuleMap {
  std::span<const ModuleKey> keys;
  std::span<const char* const> one_of = {};

  /// The key with this name, which must exist.
  [[nodiscard]] const ModuleKey& at(std::string_view key) const;
};

extern const ModuleMap kModuleMap, kBodyMap, kShapeMap, kHingeMap, kFaceMap, kConnectorMap, kContactsMap, kContactMap;

}  // namespace gaitlab
