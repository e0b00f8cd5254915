// Reader of one map of a module file by the list of its keys.
#pragma once
#include <string>
#include <vector>

#include "core/model/frames.h"
#include "core/robot_files/module_keys.h"
#include "core/settings/reader.h"

namespace gaitlab {

class KeyReader {
 public:
  /// Reader of `node`, called `name` in messages. Reports missing keys. Node, map and problems must outlive the reader.
  KeyReader(const Node& node, const ModuleMap& map, const std::string& name, Problems& problems);

  /// Value of a key, or null.
  const Node* take(const char* key) { return reader_.take(map_.at(key).key); }
  [[nodiscard]] bool has(const char* key) { return take(key) != nullptr; }
  void require(const char* key) { reader_.require({key}); }

  void text(const char* key, std::string& value);
  void number(const char* key, double& value);
  void integer(const char* key, std::int64_t& value);
  void flag(const char* key, bool& value);
  void vector(const char* key, std::span<double> value);
  void numbers(const char* key, std::vector<double>& value);
  /// Reads a word. The words of the key are in the order of the enum.
  template <class Enum>
  void choice(const char* key, Enum& value) {
    const ModuleKey& declared = map_.at(key);
    reader_.choice(key, value, declared.words, declared.spec.about);
  }
  /// True if the value of a key is this word instead of a value of another form.
  bool word(const char* key, const char* word);
  /// Reads the keys `origin` and `rpy`.
  Pose frame();
  /// Reports every unknown key.
  void finish() { reader_.finish(); }

 private:
  const ModuleMap& map_;
  Reader reader_;
};

}  // namespace gaitlab
