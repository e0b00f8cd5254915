// List of the keys of Settings structs with unit, default, range and sentence, for `gaitlab explain`.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/fields.h"

namespace gaitlab {

/// One row of the table.
struct KeyRow {
  std::string key, unit, preset, range, about;  ///< `preset` is the default value, `about` the sentence
  std::vector<std::string> words = {};          ///< words that the key permits
};

/// The rows as text of at most 80 columns. A line with key, unit, default and range precedes the sentence.
std::string table(const std::vector<KeyRow>& rows);
/// The rows as a table in Markdown.
std::string markdown_table(const std::vector<KeyRow>& rows);

/// Visitor of fields, after which rows() returns one row per key. Keys of a group are indented. Keys of a list's elements have
/// names such as `couplings[].from`; if `nested`, they are indented below `couplings[]`.
class Explainer final : public Fields {
 public:
  explicit Explainer(bool nested = false) : nested_(nested) {}
  void visit(const Field& field) override;
  void problem_at(const char*, std::string_view, std::size_t, std::string_view) override {}

  /// Adds a row for a key that is not a field.
  void row(const std::string& key, const std::string& unit, const std::string& preset, const std::string& range,
           const std::string& about, std::vector<std::string> words = {});
  [[nodiscard]] const std::vector<KeyRow>& rows() const { return rows_; }
  /// Keys of the outermost map, without those of groups and lists.
  [[nodiscard]] const std::vector<std::string>& keys() const { return keys_; }

 private:
  void on(const char* key, const char* about, const field::Number& field);
  void on(const char* key, const char* about, const field::NumberOr& field);
  void on(const char* key, const char* about, const field::Integer& field);
  void on(const char* key, const char* about, const field::Flag& field);
  void on(const char* key, const char* about, const field::Text& field);
  void on(const char* key, const char* about, const field::File& field);
  void on(const char* key, const char* about, const field::OneOf& field);
  void on(const char* key, const char* about, const field::EachJoint& field);
  void on(const char* key, const char* about, const field::Joint& field);
  void on(const char* key, const char* about, const field::Vector& field);
  void on(const char* key, const char* about, const field::Numbers& field);
  void on(const char* key, const char* about, const field::Rows& field);
  void on(const char* key, const char* about, const field::Texts& field);
  void on(const char* key, const char* about, const field::Names& field);
  void on(const char* key, const char* about, const field::Periods& field);
  void on(const char* key, const char* about, const field::Map& field);
  void on(const char* key, const char* about, const field::Column& field);
  void on(const char* key, const char* about, const field::Columns& field);
  void on(const char* key, const char* about, const field::List& field);
  void on(const char* key, const char* about, const field::RuleOrList& field);
  void on(const char* key, const char* about, const field::Group& field);
  void on(const char* key, const char* about, const field::Other& field);
  void elements(const char* key, const field::List& list);

  std::vector<KeyRow> rows_;
  std::vector<std::string> keys_;
  std::string prefix_;  ///< indentation of a group, or the text `couplings[].`
  int depth_ = 0;
  bool nested_;
  Need need_ = Need::preset;    ///< of the field whose row is next
  const char* word_ = nullptr;  ///< of the field whose row is next
  /// The last list: its structs, and the rows of their keys.
  void (*structs_)(void* self, std::size_t index, Fields& fields) = nullptr;
  std::size_t first_ = 0, end_ = 0;
};

}  // namespace gaitlab
