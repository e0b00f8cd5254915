#include "studies/run/told.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/settings/wording.h"
#include "studies/run/json_line.h"

namespace gaitlab::studies {

namespace {

using Json = nlohmann::json;
constexpr const char* kExpected =
    R"(; expected {"id": 7, "objective": 0.031, "violation": 0}, or an answer of gaitlab evaluate)";
// The keys of an answer. Those that are not read here follow from the others.
constexpr std::array kKeys{"id",      "objective", "violation", "outcome", "message",  "simulated",
                           "verdict", "figures",   "margins",   "kept",    "feasible", "run"};

constexpr std::string_view kNotRun = "not run";  // outcome in tables of rollouts: an interrupt, not a failure of the gait

class ToldReader {
 public:
  ToldReader(const Json& root, const SourceLocation& place) : root_(root), place_(place) {}

  Told read(std::size_t objectives) {
    check_keys();
    Told told;
    if (const Json* id = need("id"); id != nullptr) {
      if (id->is_number_unsigned()) told.point = id->get<std::uint64_t>();
      if (!id->is_number_unsigned()) wrong("id", "the id of a question");
    }
    text("outcome", told.outcome);
    if (told.outcome == kNotRun) wrong("outcome", "no result of this point before it has run");
    text("message", told.message);
    number("simulated", told.simulated);
    if (told.outcome == "done") {
      read_objectives(objectives, told.score);
      read_violation(told.score);
      read_figures(told.quantities);
      std::string word = name_of(told.verdict);
      text("verdict", word);
      told.verdict = named<Word>(word).value_or(Word::failed);
      if (told.verdict == Word::failed) wrong("verdict", "feasible, infeasible or not judged");
    } else {
      told.verdict = Word::failed;
    }
    problems_.raise();
    return told;
  }

 private:
  void check_keys() {
    for (const auto& [key, value] : root_.items()) {
      if (std::ranges::find(kKeys, key) == kKeys.end()) problems_.add(place_, "unknown key " + in_quotes(key) + kExpected);
    }
  }

  const Json* find(const char* key) const {
    const auto at = root_.find(key);
    return at == root_.end() ? nullptr : &*at;
  }

  const Json* need(const char* key) {
    const Json* value = find(key);
    if (value == nullptr) problems_.add(place_, fmt::format("has no {}{}", key, kExpected));
    return value;
  }

  void wrong(const std::string& key, const std::string& expected) {
    const std::string found = root_.at(key).dump(-1, ' ', true);
    problems_.add(place_, fmt::format("{} is {}; expected {}", key, clipped(found), expected));
  }

  void text(const char* key, std::string& value) {
    const Json* given = find(key);
    if (given == nullptr || given->is_null()) return;
    if (!given->is_string()) return wrong(key, "a text");
    if (const auto& read = given->get_ref<const std::string&>(); !read.empty()) value = read;
  }

  void number(const char* key, double& value) {
    const Json* given = find(key);
    if (given == nullptr || given->is_null()) return;
    const std::optional<double> read = number_of(*given);
    if (!read || !(*read >= 0)) return wrong(key, "a number, 0 or more");
    value = *read;
  }

  /// A number, NaN for null, or nothing for a value of another type.
  static std::optional<double> number_of(const Json& value) {
    if (value.is_null()) return std::nan("");
    if (!value.is_number()) return {};
    return value.get<double>();
  }

  void read_objectives(std::size_t objectives, Score& score) {
    const Json* given = need("objective");
    if (given == nullptr) return;
    const Json all = given->is_array() ? *given : Json::array({*given});
    bool sound = all.size() == objectives;
    for (std::size_t k = 0; sound && k < objectives; ++k) {
      const std::optional<double> value = number_of(all[k]);
      sound = value.has_value();
      score.objectives[k] = value.value_or(0);
      if (std::isnan(score.objectives[k])) score.violation += 1;
    }
    if (!sound) wrong("objective", objectives == 1 ? "a number" : fmt::format("a list of {} numbers", objectives));
  }

  void read_violation(Score& score) {
    double violation = 0;
    number("violation", violation);
    score.violation = std::max(score.violation, violation);  // the violation of an answer includes unknown objectives
  }

  void read_figures(std::map<std::string, double>& quantities) {
    const Json* given = find("figures");
    if (given == nullptr || given->is_null()) return;
    if (!given->is_object()) return wrong("figures", "an object of numbers");
    for (const auto& [name, value] : given->items()) {
      const std::optional<double> read = number_of(value);
      if (!read) {
        problems_.add(place_,
                      fmt::format("figure {} is {}; expected a number", clipped(name), clipped(value.dump(-1, ' ', true))));
      }
      quantities[name] = read.value_or(0);
    }
  }

  const Json& root_;
  const SourceLocation& place_;
  Problems problems_;
};

}  // namespace

Told read_told(const std::string& line, const SourceLocation& place, std::size_t objectives) {
  return ToldReader(json_object(line, place, kExpected), place).read(objectives);
}

}  // namespace gaitlab::studies
