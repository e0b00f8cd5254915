// The list of a plugin's settings. One visit of a Settings struct serves reading, the resolved scenario, range errors, `gaitlab
// explain` and the JSON schema. Standard library only.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gaitlab {

using In = std::span<const double>;
using Out = std::span<double>;

/// Specification of a number: unit ("" for none), closed range and one sentence.
struct Spec {
  const char* unit;
  double min, max;
  const char* about;
};

/// Least number of a range whose numbers must be above 0.
inline constexpr double kPositive = std::numeric_limits<double>::denorm_min();

/// Value of a number that is not stated, of a field with a `usual` value whose range begins at 0.
inline constexpr double kNotStated = -1;

/// A value per joint, or per module. In YAML it is a number, a list, or a map such as {default: x, m3/passive: y, "*/active":
/// z}.
struct PerJoint {
  double common = 0;
  std::vector<double> each = {};  ///< empty if every joint has the value `common`
  double operator[](std::size_t joint) const { return each.empty() ? common : each[joint]; }
  bool operator==(const PerJoint&) const = default;
};

/// A value under a name that the user chooses.
struct Named {
  std::string name;
  std::string text = {};  ///< empty if the value is `number`
  PerJoint number = {};
  bool operator==(const Named&) const = default;
};

/// Type of the values in a map whose keys the user chooses: only texts, or texts and numbers.
enum class NamedValues { texts, texts_or_numbers };

class Fields;

/// A column of a log: value = number in the column / scale.
struct LogColumn {
  std::string name = {};  ///< "" for none
  double scale = 1;
  void fields(Fields& f);
};

/// A joint, by its number, and its column of a log.
struct JointColumn {
  std::int64_t joint = -1;  ///< -1 for a joint that does not exist, which the reader has reported
  LogColumn column = {};
};

/// Types of fields. Each has a reference to the value, and its limits. Keys, names and sentences must be string literals or
/// outlive the visit, because their addresses are kept.
namespace field {
struct Number {
  double& value;
  Spec spec;
};
/// A number, or the text `word`, for which `value` is 0.
struct NumberOr {
  double& value;
  const char* word;
  Spec spec;
};
struct Integer {
  std::int64_t& value;
  Spec spec;
};
struct Flag {
  bool& value;
};
struct Text {
  std::string& value;
};
/// A text that may be in a separate file. In YAML it is the file's path relative to the scenario, or the text in several lines.
/// `value` is always the text; the resolved scenario contains it in full.
struct File {
  std::string& value;
};
struct OneOf {
  std::string& value;
  std::span<const char* const> names;
};
/// Meaning of a value per joint for a verdict.
/// - setting: any other value. With `usual`, kNotStated stands for the value of `usual`, which follows from other fields.
/// - limit: limit of the actuator; a run without such limits measures the demand of a gait. If a limit of 0 means "not stated",
///   `usual` is the value that applies instead; if `usual` is null, 0 is a limit like any other.
/// - rating: value stated by the maker. 0 for every joint means "not stated", and the resolved scenario omits the key.
/// - required: value without a default. Its initial value 0 means "not given" and is outside its range.
enum class Role { setting, limit, rating, required };
struct EachJoint {
  PerJoint& value;
  Spec spec;
  Role role = Role::setting;
  const PerJoint* usual = nullptr;
  bool of_modules = false;  ///< true for a value per module
};
/// True if no joint of a setting has a stated value.
inline bool not_stated(const EachJoint& field) {
  const auto unknown = [](double one) { return one == kNotStated; };
  if (field.role != Role::setting || field.usual == nullptr) return false;
  return field.value.each.empty() ? unknown(field.value.common)
                                  : std::all_of(field.value.each.begin(), field.value.each.end(), unknown);
}
/// The value with the numbers of `usual` where it is a setting that is not stated.
inline PerJoint in_force(const EachJoint& field) {
  if (field.role != Role::setting || field.usual == nullptr) return field.value;
  if (not_stated(field)) return *field.usual;
  PerJoint value = field.value;
  for (std::size_t j = 0; j < value.each.size(); ++j)
    if (value.each[j] == kNotStated) value.each[j] = (*field.usual)[j];
  return value;
}
/// A joint, by name or number in the file. `value` is its number.
struct Joint {
  std::int64_t& value;
};
/// A list of exactly `value.size()` numbers.
struct Vector {
  std::span<double> value;
  Spec spec;
};
/// A list of numbers of any length.
struct Numbers {
  std::vector<double>& value;
  Spec spec;
  bool whole = false;  ///< true for at least one number, all of them whole; the reader leaves this to the caller
};
/// A list of rows. Each row is a list with as many numbers as the first row.
struct Rows {
  std::vector<std::vector<double>>& value;
  Spec spec;
};
struct Texts {
  std::vector<std::string>& value;
};
/// Kind of the names in a field: parts of the robot, or words that the field lists.
enum class Among { joints, motors, modules, bodies, words };
/// Names of parts of the robot, or words. In YAML a text or a list of texts; names of parts may be patterns.
struct Names {
  std::vector<std::string>& value;
  Among among;
  std::span<const char* const> words = {};  ///< allowed words; only for Among::words
  bool one = false;                         ///< true for exactly one name, without a default
};
/// A time of whole control periods. If `most` is not null, the field is also a range [a, b], and `value` is a.
struct Periods {
  double& value;
  double* most;
  Spec spec;
};
/// A map whose keys the user chooses, in the order of the file. A key is a letter, followed by letters, digits and _. A map in
/// the file replaces the whole default. Empty texts are refused.
struct Map {
  std::vector<Named>& value;
  NamedValues kind;
};
/// A column of a log. In YAML its name, or {column: NAME, scale: NUMBER}.
struct Column {
  LogColumn& value;
};
/// Columns of a log by joint, a map with the names or numbers of joints as its keys. No joint occurs twice.
struct Columns {
  std::vector<JointColumn>& value;
};
/// A list of structs that each have `void fields(Fields&)`, or a map of such structs by name.
struct List {
  void* self;
  void (*resize)(void* self, std::size_t size);
  std::size_t (*size)(void* self);
  void (*visit)(void* self, std::size_t index, Fields& fields);
  std::string& (*name)(void* self, std::size_t index) = nullptr;  ///< null for a list
  const char* example = "";                                       ///< a struct of the map, for messages: `{mass: ...}`
};
/// One of `names` (the list is then empty), or a list of structs (`rule` is then empty).
struct RuleOrList {
  std::string& rule;
  std::span<const char* const> names;
  List list;
};
/// A nested map, as a struct with `void fields(Fields&)`.
struct Group {
  void* self;
  void (*visit)(void* self, Fields& fields);
};
/// A value that other code reads, and that the resolved scenario omits.
struct Other {
  const char* form;         ///< for the manual: `list of pairs`
  const char* schema;       ///< JSON Schema
  const char* preset = "";  ///< default as JSON
};
using Value = std::variant<Number, NumberOr, Integer, Flag, Text, File, OneOf, EachJoint, Joint, Vector, Numbers, Rows, Texts,
                           Names, Periods, Map, Column, Columns, List, RuleOrList, Group, Other>;
}  // namespace field

using field::Among;

/// Meaning of an absent key.
/// - preset: the initial value is the default.
/// - optional: the initial value is one that no file states, such as 0 for an unknown load.
/// - one_of: exactly one of the keys of a struct with this mark is given. The reader leaves the check to the caller.
/// - required: an error.
enum class Need { preset, optional, one_of, required };

struct Field {
  const char* key;
  const char* about;  ///< one sentence
  field::Value value;
  Need need = Need::preset;
  const char* word = nullptr;  ///< word that may be given instead of a value
  bool* is_word = nullptr;     ///< set to true for the word
};

/// Visitor of the fields of a Settings struct, in order. A Settings struct is default-constructible, its initial values are the
/// defaults, and it has `void fields(Fields&)`. Classes that read, write or list settings override visit() and, if they report
/// problems, problem_at().
class Fields {
 public:
  virtual void visit(const Field& field) = 0;
  /// Reports a failed check that concerns several fields, at the byte `offset` of the text of `key`. If `name` is not empty,
  /// the place is within the value with that name. If `offset` is npos, the place is the key or the name.
  virtual void problem_at(const char* key, std::string_view name, std::size_t offset, std::string_view what) = 0;
  void problem(const char* key, std::string_view what) { problem_at(key, {}, std::string_view::npos, what); }

  void number(const char* key, double& value, Spec spec) { visit({key, spec.about, field::Number{value, spec}}); }
  void number_or(const char* key, double& value, const char* word, Spec spec) {
    visit({key, spec.about, field::NumberOr{value, word, spec}});
  }
  void integer(const char* key, std::int64_t& value, Spec spec) { visit({key, spec.about, field::Integer{value, spec}}); }
  void flag(const char* key, bool& value, const char* about) { visit({key, about, field::Flag{value}}); }
  void text(const char* key, std::string& value, const char* about) { visit({key, about, field::Text{value}}); }
  void file(const char* key, std::string& value, const char* about) { visit({key, about, field::File{value}}); }
  void one_of(const char* key, std::string& value, std::span<const char* const> names, const char* about) {
    visit({key, about, field::OneOf{value, names}});
  }
  /// Field of an enum. `names` are the names of its values, which start at 0, in their order.
  template <class Enum>
  void choice(const char* key, Enum& value, std::span<const char* const> names, const char* about) {
    std::string name = names[static_cast<std::size_t>(value)];
    one_of(key, name, names, about);
    const Enum read = value_of<Enum>(name, names);
    if (read != value) value = read;  // Without a change, nothing is written, because threads that only read share the settings
  }
  void per_joint(const char* key, PerJoint& value, Spec spec) { visit({key, spec.about, field::EachJoint{value, spec}}); }
  /// Field of a value per joint whose default, `usual`, follows from the fields before it. Initial value: kNotStated.
  void per_joint(const char* key, PerJoint& value, const PerJoint& usual, Spec spec) {
    visit({key, spec.about, field::EachJoint{value, spec, field::Role::setting, &usual}});
  }
  /// Field of a value per module, named m0, m1 ...
  void per_module(const char* key, PerJoint& value, Spec spec) {
    visit({key, spec.about, field::EachJoint{value, spec, field::Role::setting, nullptr, true}});
  }
  /// Field of an actuator's limit: its largest command, in the unit of the command, or its largest current.
  void limit(const char* key, PerJoint& value, Spec spec) {
    visit({key, spec.about, field::EachJoint{value, spec, field::Role::limit}});
  }
  /// Field of an actuator's limit for which 0 means "not stated"; `usual` then applies. Compute `usual` before the first limit
  /// is visited, because the visit may raise that limit.
  void limit(const char* key, PerJoint& value, const PerJoint& usual, Spec spec) {
    visit({key, spec.about, field::EachJoint{value, spec, field::Role::limit, &usual}});
  }
  /// Field of a number without a default. Its initial value is 0, and its range is above 0. A joint without a value is an
  /// error.
  void required(const char* key, PerJoint& value, Spec spec) {
    visit({key, spec.about, field::EachJoint{value, spec, field::Role::required}});
  }
  /// Field of a rating that the maker states, or 0. Most ratings limit verdicts, not the simulation.
  void rating(const char* key, PerJoint& value, Spec spec) {
    visit({key, spec.about, field::EachJoint{value, spec, field::Role::rating}});
  }
  void joint(const char* key, std::int64_t& value, const char* about) { visit({key, about, field::Joint{value}}); }
  void vector(const char* key, std::span<double> value, Spec spec) { visit({key, spec.about, field::Vector{value, spec}}); }
  void numbers(const char* key, std::vector<double>& value, Spec spec) {
    visit({key, spec.about, field::Numbers{value, spec}});
  }
  void integers(const char* key, std::vector<double>& value, Spec spec) {
    visit({key, spec.about, field::Numbers{value, spec, true}});
  }
  void rows(const char* key, std::vector<std::vector<double>>& value, Spec spec) {
    visit({key, spec.about, field::Rows{value, spec}});
  }
  void texts(const char* key, std::vector<std::string>& value, const char* about) { visit({key, about, field::Texts{value}}); }
  void names(const char* key, std::vector<std::string>& value, Among among, const char* about) {
    visit({key, about, field::Names{value, among}});
  }
  void name(const char* key, std::vector<std::string>& value, Among among, const char* about) {
    visit({key, about, field::Names{value, among, {}, true}});
  }
  /// Field of some of the `words`, which must outlive the visit.
  void words(const char* key, std::vector<std::string>& value, std::span<const char* const> words, const char* about) {
    visit({key, about, field::Names{value, Among::words, words}});
  }
  void periods(const char* key, double& value, Spec spec) { visit({key, spec.about, field::Periods{value, nullptr, spec}}); }
  /// Field of a time, or of a range of times.
  void periods(const char* key, double& least, double& most, Spec spec) {
    visit({key, spec.about, field::Periods{least, &most, spec}});
  }
  void named(const char* key, std::vector<Named>& value, NamedValues kind, const char* about) {
    visit({key, about, field::Map{value, kind}});
  }
  void column(const char* key, LogColumn& value, const char* about) { visit({key, about, field::Column{value}}); }
  void columns(const char* key, std::vector<JointColumn>& value, const char* about) {
    visit({key, about, field::Columns{value}});
  }
  template <class T>
  void list(const char* key, std::vector<T>& value, const char* about) {
    visit({key, about, list_of(value)});
  }
  /// Field of a map of structs, each with its key as `name`.
  template <class T>
  void by_name(const char* key, std::vector<T>& value, const char* example, const char* about) {
    field::List list = list_of(value);
    list.name = [](void* p, std::size_t i) -> std::string& { return (*static_cast<std::vector<T>*>(p))[i].name; };
    list.example = example;
    visit({key, about, list});
  }
  /// Field of a rule or a list. The list applies if `rule` does not have a value.
  template <class Enum, class T>
  void rule_or_list(const char* key, std::optional<Enum>& rule, std::span<const char* const> names, std::vector<T>& value,
                    const char* about) {
    std::string name = rule ? names[static_cast<std::size_t>(*rule)] : "";
    visit({key, about, field::RuleOrList{name, names, list_of(value)}});
    rule = name.empty() ? std::nullopt : std::optional(value_of<Enum>(name, names));
  }
  template <class T>
  void group(const char* key, T& value, const char* about) {
    visit({key, about, field::Group{&value, [](void* self, Fields& f) { static_cast<T*>(self)->fields(f); }}});
  }
  void other(const char* key, field::Other value, const char* about) { visit({key, about, value}); }

 protected:
  ~Fields() = default;

 private:
  template <class Enum>
  static Enum value_of(const std::string& name, std::span<const char* const> names) {
    return static_cast<Enum>(std::find(names.begin(), names.end(), name) - names.begin());
  }
  template <class T>
  static field::List list_of(std::vector<T>& value) {
    return {&value, [](void* p, std::size_t n) { static_cast<std::vector<T>*>(p)->resize(n); },
            [](void* p) { return static_cast<std::vector<T>*>(p)->size(); },
            [](void* p, std::size_t i, Fields& f) { (*static_cast<std::vector<T>*>(p))[i].fields(f); }};
  }
};

/// Declaration of a field that may have no default, or a word instead of a value: `Marked(f, Need::required).text(...)`.
class Marked final : public Fields {
 public:
  Marked(Fields& fields, Need need, const char* word = nullptr, bool* is_word = nullptr)
      : fields_(fields), need_(need), word_(word), is_word_(is_word) {}
  void visit(const Field& field) override { fields_.visit({field.key, field.about, field.value, need_, word_, is_word_}); }
  void problem_at(const char* key, std::string_view name, std::size_t offset, std::string_view what) override {
    fields_.problem_at(key, name, offset, what);
  }

 private:
  Fields& fields_;
  Need need_;
  const char* word_;
  bool* is_word_;
};

inline void LogColumn::fields(Fields& f) {
  Marked(f, Need::required).text("column", name, "Name of the column.");
  f.number("scale", scale,
           {"", -1e9, 1e9, "Number in the column for a value of 1, such as 885 for a PWM of 885 at full duty; not 0."});
  if (scale == 0) f.problem("scale", "scale is 0; expected the number in the column for a value of 1");
}

}  // namespace gaitlab
