// The fields of a Settings struct as properties of a JSON Schema.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "core/plugin/fields.h"

namespace gaitlab {

using Json = nlohmann::ordered_json;

/// Schema of any scalar. A text need not be quoted, so that 8 and true are texts as well.
Json scalar_schema();
/// Schema of a number of the JSON type `type`, number or integer, within the range of `spec`.
Json number_schema(const char* type, const Spec& spec);
/// Schema of a map with exactly these keys.
Json object_schema(Json properties);

/// Visitor of fields, after which properties() contains their schema.
class SchemaFields final : public Fields {
 public:
  void visit(const Field& field) override;
  void problem_at(const char*, std::string_view, std::size_t, std::string_view) override {}

  Json& properties() { return properties_; }
  /// Schema of a map with these fields.
  Json object();

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

  Json properties_ = Json::object(), required_ = Json::array(), one_of_ = Json::array();
  Need need_ = Need::preset;  ///< of the field that is visited
};

}  // namespace gaitlab
