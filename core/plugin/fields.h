// The list of a plugin's settings: one walk over a Settings struct serves reading, the resolved scenario, range errors,
// `gaitlab explain` and the JSON schema. Standard library only.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gaitlab {

using In = std::span<const double>;
using Out = std::span<double>;

/// Unit ("" = none), closed range and one sentence of a number.
struct Spec {
  const char* unit;
  double min, max;
  const char* about;
};

/// A value per joint: in YAML a number, a list, or {default: x, m3/passive: y}.
struct PerJoint {
  double common = 0;
  std::vector<double> each = {};  ///< empty: `common` everywhere
  double operator[](std::size_t joint) const { return each.empty() ? common : each[joint]; }
  bool operator==(const PerJoint&) const = default;
};

/// A value under a name that the user chose.
struct Named {
  std::string name;
  std::string text = {};  ///< empty: `number` holds
  PerJoint number = {};
  bool operator==(const Named&) const = default;
};

enum class NamedValues { texts, texts_or_numbers };

/// Visits the fields of a Settings struct in order. A Settings struct is default-constructible, its initial values are the
/// defaults, and it has `void fields(Fields&)`. Keys and texts must be string literals (they are kept by address).
class Fields {
 public:
  virtual void number(const char* key, double& value, Spec spec) = 0;
  /// A number, or `word` instead of one: then `value` is 0.
  virtual void number_or(const char* key, double& value, const char* /*word*/, Spec spec) { number(key, value, spec); }
  virtual void integer(const char* key, std::int64_t& value, Spec spec) = 0;
  virtual void flag(const char* key, bool& value, const char* about) = 0;
  virtual void text(const char* key, std::string& value, const char* about) = 0;
  /// A text that may stand in a file of its own: in YAML the file's path (relative to the scenario), or the text itself, which
  /// then has several lines. `value` is always the text; the resolved scenario holds it in full.
  virtual void file(const char* key, std::string& value, const char* about) = 0;
  /// `value` is the index of the chosen name.
  virtual void choice(const char* key, int& value, std::span<const char* const> names, const char* about) = 0;
  virtual void per_joint(const char* key, PerJoint& value, Spec spec) = 0;
  /// A joint, by name or number in the file, by number here.
  virtual void joint(const char* key, std::int64_t& value, const char* about) = 0;
  /// A list of exactly `value.size()` numbers.
  virtual void vector(const char* key, std::span<double> value, Spec spec) = 0;
  /// A list of numbers of any length.
  virtual void numbers(const char* key, std::vector<double>& value, Spec spec) = 0;
  /// A list of rows, each a list of as many numbers as the first.
  virtual void rows(const char* key, std::vector<std::vector<double>>& value, Spec spec) = 0;
  virtual void texts(const char* key, std::vector<std::string>& value, const char* about) = 0;
  /// A map whose keys the user chooses (a letter, then letters, digits and _), in the order of the file. One that is given
  /// takes the place of the whole default. Empty texts are refused.
  virtual void named(const char* key, std::vector<Named>& values, NamedValues kind, const char* about) = 0;
  /// A check across fields failed: reported at the place of `key`.
  virtual void problem(const char* key, std::string_view what) = 0;
  /// The same at the byte `offset` of a text, `name` being empty for one of its own and else that of a named value; npos: at
  /// the name itself.
  virtual void problem_at(const char* key, std::string_view name, std::size_t offset, std::string_view what) = 0;

  /// A list of structs, each with `void fields(Fields&)`.
  template <class T>
  void list(const char* key, std::vector<T>& value, const char* about) {
    list(key, about, list_of(value));
  }
  /// Either one of `names` (then `rule` is its index and the list is empty) or a list of structs (then `rule` is -1).
  template <class T>
  void rule_or_list(const char* key, int& rule, std::span<const char* const> names, std::vector<T>& value, const char* about) {
    rule_or_list(key, rule, names, about, list_of(value));
  }
  /// A nested map, a struct with `void fields(Fields&)`.
  template <class T>
  void group(const char* key, T& value, const char* about) {
    group(key, about, Group{&value, [](void* self, Fields& f) { static_cast<T*>(self)->fields(f); }});
  }

 protected:
  struct List {
    void* self;
    void (*resize)(void* self, std::size_t size);
    std::size_t (*size)(void* self);
    void (*visit)(void* self, std::size_t index, Fields& fields);
  };
  struct Group {
    void* self;
    void (*visit)(void* self, Fields& fields);
  };
  virtual void list(const char* key, const char* about, List list) = 0;
  virtual void rule_or_list(const char* key, int& rule, std::span<const char* const> names, const char* about, List list) = 0;
  virtual void group(const char* key, const char* about, Group group) = 0;
  ~Fields() = default;

 private:
  template <class T>
  static List list_of(std::vector<T>& value) {
    return {&value, [](void* p, std::size_t n) { static_cast<std::vector<T>*>(p)->resize(n); },
            [](void* p) { return static_cast<std::vector<T>*>(p)->size(); },
            [](void* p, std::size_t i, Fields& f) { (*static_cast<std::vector<T>*>(p))[i].fields(f); }};
  }
};

}  // namespace gaitlab
