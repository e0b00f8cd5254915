// Lists the keys of Settings structs with unit, default, range and sentence: `gaitlab explain`.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/fields.h"

namespace gaitlab {

/// One line of the table.
struct KeyRow {
  std::string key, unit, preset, range, about;  ///< preset: the default
};

/// The rows as aligned plain text.
std::string table(const std::vector<KeyRow>& rows);
/// The same as a table of Markdown.
std::string markdown_table(const std::vector<KeyRow>& rows);

/// Visit fields, then read rows(). Groups are indented; the keys of a list's elements are shown as `couplings[].from`.
class Explainer final : public Fields {
 public:
  void number(const char* key, double& value, Spec spec) override;
  void number_or(const char* key, double& value, const char* word, Spec spec) override;
  void integer(const char* key, std::int64_t& value, Spec spec) override;
  void flag(const char* key, bool& value, const char* about) override;
  void text(const char* key, std::string& value, const char* about) override;
  void file(const char* key, std::string& value, const char* about) override;
  void choice(const char* key, int& value, std::span<const char* const> names, const char* about) override;
  void per_joint(const char* key, PerJoint& value, Spec spec) override;
  void joint(const char* key, std::int64_t& value, const char* about) override;
  void vector(const char* key, std::span<double> value, Spec spec) override;
  void numbers(const char* key, std::vector<double>& value, Spec spec) override;
  void rows(const char* key, std::vector<std::vector<double>>& value, Spec spec) override;
  void texts(const char* key, std::vector<std::string>& value, const char* about) override;
  void named(const char* key, std::vector<Named>& values, NamedValues kind, const char* about) override;
  void problem(const char*, std::string_view) override {}
  void problem_at(const char*, std::string_view, std::size_t, std::string_view) override {}
  using Fields::group;
  using Fields::list;
  using Fields::rule_or_list;

  /// A row by hand.
  void row(const std::string& key, const std::string& unit, const std::string& preset, const std::string& range,
           const std::string& about);
  [[nodiscard]] const std::vector<KeyRow>& rows() const { return rows_; }
  /// The keys of the outermost map alone.
  [[nodiscard]] const std::vector<std::string>& keys() const { return keys_; }

 private:
  void list(const char* key, const char* about, List list) override;
  void rule_or_list(const char* key, int& rule, std::span<const char* const> names, const char* about, List list) override;
  void group(const char* key, const char* about, Group group) override;
  void elements(const char* key, const List& list);

  std::vector<KeyRow> rows_;
  std::vector<std::string> keys_;
  std::string prefix_;  ///< indentation, or `couplings[].`
  int depth_ = 0;
};

}  // namespace gaitlab
