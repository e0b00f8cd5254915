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
  /// Reader of `node`, called `name` in messages. Reports missing keys, and keys of newer formats, which then count as absent.
  /// `format` 0 means that the format is not known, which has been reported. Node, map and problems must outlive the reader.
  KeyReader(const Node& node, const ModuleMap& map, const std::string& name, std::int64_t format, Problems& problems);

  /// Value of a key, or null.
  const Node* take(const char* key);
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
    const std::vector<const char*> words = known_words(key);
    if (!words.empty()) reader_.choice(key, value, words, map_.at(key).spec.about);
  }
  /// True if the value of a key is this word instead of a value of another form. Reports a word of a newer format.
  bool word(const char* key, const char* word);
  /// Reads the keys `origin` and `rpy`.
  Pose frame();
  /// Reports every unknown key.
  void finish() { reader_.finish(); }

 private:
  [[nodiscard]] bool newer(const ModuleKey& key) const { return key.format > format_; }
  /// Words of a key in this format; empty if its value is a word of a newer format, which is reported.
  std::vector<const char*> known_words(const char* key);
  void need_format(std::int64_t format, const std::string& what, const SourceLocation& place);

  const ModuleMap& map_;
  std::int64_t format_;
  Problems& problems_;
  Reader reader_;
};

}  // namespace gaitlab
