// Reader of the parts of a study file that vary (parameters, replicates), and of the corresponding command-line options.
#include "studies/study/parameter_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/settings/reader.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"
#include "studies/study/study_keys.h"

namespace gaitlab::studies {

namespace {

/// Reads a list of values (numbers or words) in the form of --set.
void read_values(const Node& list, const std::string& what, std::vector<std::string>& values, bool& words, Problems& problems) {
  if (list.kind != Node::Kind::list || list.items.empty()) {
    problems.add(list.place, what + " is " + (list.items.empty() && list.kind == Node::Kind::list ? "empty" : found(list)) +
                                 "; expected a list of values: [0.5, 1, 2]");
    return;
  }
  std::size_t numbers = 0;
  for (const Node& item : list.items) {
    if (item.kind != Node::Kind::scalar) {
      problems.add(item.place, what + " holds " + found(item) + "; expected numbers or words");
      return;
    }
    const Reading<double> number = read_number(item, "");
    if (number.ok()) ++numbers;
    std::string text = number.ok() ? number_text(number.value) : item.text;
    if (std::ranges::find(values, text) != values.end())
      problems.add(item.place, what + " holds " + in_quotes(text) + " twice");
    values.push_back(std::move(text));
  }
  words = numbers == 0;
  if (numbers > 0 && numbers < list.items.size())
    problems.add(list.place, what + " mixes numbers and words; expected one or the other");
}

void check_range(const Parameter& p, const SourceLocation& place, const std::string& what, Problems& problems) {
  if (!(p.low < p.high)) {
    problems.add(place, fmt::format("{}: low is {}, not below high, {}", what, number_text(p.low), number_text(p.high)));
  } else if (p.log && !(p.low > 0)) {
    problems.add(place, fmt::format("{}: low is {}; expected more than 0 for a logarithm", what, number_text(p.low)));
  }
}

/// Reads followers, as in {cpg.offset: 0.3*legs - 0.1}.
void read_followers_of(const Node& node, Parameter& parameter, Problems& problems) {
  const std::string& name = parameter.key;
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  constexpr std::array<std::string_view, 4> kTaken{"pi", "and", "or", "not"};  // names that expressions use
  if (!is_name(name, "_") || !letter(name[0]) || std::ranges::find(kTaken, name) != kTaken.end()) {
    problems.add(
        parameter.place,
        in_quotes(name) +
            " cannot be a parameter of the study with `sets`; expected a name of letters, digits and `_` that begins with a "
            "letter, as in hip0: {low: 0.1, high: 0.2, sets: {cpg.offset.hips: hip0}}");
  }
  if (node.kind != Node::Kind::map || node.keys.empty()) {
    problems.add(node.place, name + ".sets is " + (node.kind == Node::Kind::map ? "empty" : found(node)) +
                                 "; expected keys of the scenario with expressions: {cpg.offset: 0.3*" + clipped(name) + "}");
    return;
  }
  if (parameter.words) problems.add(node.place, name + " has words, which no expression can use; expected numbers beside sets");
  for (std::size_t k = 0; k < node.keys.size(); ++k) {
    const Node& expression = node.items[k];
    if (expression.kind != Node::Kind::scalar) {
      problems.add(expression.place, node.keys[k].first + " is " + found(expression) + "; expected an expression");
    } else {
      parameter.sets.push_back({node.keys[k].first, {expression.text, expression}, node.keys[k].second});
    }
  }
}

/// Reads the value of a parameter at a start point, in the form of --set.
std::string start_value(const Node& node, const Parameter& p, Problems& problems) {
  const Reading<double> number = read_number(node, "");
  if (p.words || !p.values.empty()) {
    std::string text = number.ok() ? number_text(number.value) : node.text;
    if (node.kind != Node::Kind::scalar || std::ranges::find(p.values, text) == p.values.end())
      problems.add(node.place, fmt::format("{} is {}; expected one of its values: {}", p.key, found(node), joined(p.values)));
    return text;
  }
  if (!number.ok()) {
    problems.add(node.place, p.key + " " + number.wrong);
  } else if (number.value < p.low || number.value > p.high) {
    problems.add(node.place, fmt::format("{} is {}; expected {} to {}, the range of the parameter", p.key,
                                         number_text(number.value), number_text(p.low), number_text(p.high)));
  }
  return number_text(number.value);
}

}  // namespace

void read_starts(const Node& node, Study& study, Problems& problems) {
  constexpr const char* kExpected = "; expected a list of points: [{cpg.frequency: 0.5}]";
  if (node.kind != Node::Kind::list) problems.add(node.place, "start is " + found(node) + kExpected);
  std::vector<std::string> known;
  for (const Parameter& p : study.parameters) known.push_back(p.key);
  for (const Node& item : node.items) {
    if (node.kind != Node::Kind::list) return;
    if (item.kind != Node::Kind::map) problems.add(item.place, "a point of start is " + found(item) + kExpected);
    StartPoint start{{}, item.place};
    for (std::size_t k = 0; k < item.keys.size(); ++k) {
      const auto& [key, place] = item.keys[k];
      const auto p = std::ranges::find(study.parameters, key, &Parameter::key);
      if (p == study.parameters.end()) {
        problems.add(place, "unknown parameter " + in_quotes(key) + offer(key, known, "parameters"));
      } else {
        start.values.emplace_back(key, start_value(item.items[k], *p, problems));
      }
    }
    study.starts.push_back(std::move(start));
  }
}

void read_parameters(const Node& node, Study& study, Problems& problems) {
  if (node.kind != Node::Kind::map || node.keys.empty()) {
    problems.add(node.place, "parameters is " + (node.kind == Node::Kind::map ? "empty" : found(node)) +
                                 "; expected keys of the scenario: cpg.frequency: {low: 0.1, high: 1}");
    return;
  }
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    Parameter parameter;
    parameter.key = node.keys[i].first;
    parameter.place = node.keys[i].second;
    const std::size_t before = problems.size();
    Reader reader(node.items[i], parameter.key, problems, nullptr);
    const Node* values = reader.take("values");
    if (values != nullptr) {
      read_values(*values, parameter.key + ".values", parameter.values, parameter.words, problems);
      for (const Node& item : values->items) parameter.value_places.push_back(item.place);
      if (reader.has("low") || reader.has("high"))
        problems.add(values->place, parameter.key + " has values, and low or high; expected one or the other");
    }
    RangeKeys range{parameter, parameter.log};
    range.fields(reader);
    if (values == nullptr) reader.require({"low", "high"});
    if (const Node* sets = reader.take("sets")) read_followers_of(*sets, parameter, problems);
    reader.finish();
    if (problems.size() == before && values == nullptr) check_range(parameter, parameter.place, parameter.key, problems);
    study.parameters.push_back(std::move(parameter));
  }
}

namespace {

/// Reads the two numbers of a law into v.a and v.b. `expected` is the text of the law with names for the numbers.
void read_pair(const Node& list, Variation& v, const char* expected, Problems& problems) {
  const bool two = list.kind == Node::Kind::list && list.items.size() == 2;
  for (std::size_t k = 0; k < 2; ++k) {
    const Reading<double> number = two ? read_number(list.items[k], "") : Reading<double>{0, ""};
    if (!two || !number.ok()) {
      problems.add(list.place, v.key + " is not " + expected);
      return;
    }
    (k == 0 ? v.a : v.b) = number.value;
  }
}

/// Reads a normal law, truncated at low and high.
void read_normal(const Node& node, const Node& normal, double low, double high, Variation& v, Problems& problems) {
  v.law = Variation::Law::normal;
  read_pair(normal, v, "normal: [MEAN, DEVIATION]", problems);
  if (v.b < 0) problems.add(normal.place, v.key + " has a deviation of " + number_text(v.b) + "; expected at least 0");
  if (!(low < high) || low > v.a || high < v.a)
    problems.add(node.place, v.key + ": the mean, " + number_text(v.a) + ", is not between low and high");
}

void read_law(const Node& node, Variation& v, Problems& problems) {
  Reader reader(node, v.key, problems, nullptr);
  if (node.kind != Node::Kind::map) return;
  const Node* times = reader.take("times");
  if (times != nullptr && !v.times) {
    v.times = true;
    reader.finish();
    return read_law(*times, v, problems);
  }
  const Node* normal = reader.take("normal");
  const Node* uniform = reader.take("uniform");
  const Node* values = reader.take("values");
  double low = -kAny;
  double high = kAny;
  if (normal != nullptr) {
    reader.number("low", low, {"", -kAny, kAny, ""});
    reader.number("high", high, {"", -kAny, kAny, ""});
    if (reader.has("low")) v.low = low;
    if (reader.has("high")) v.high = high;
  }
  reader.finish();
  const int given = (normal != nullptr ? 1 : 0) + (uniform != nullptr ? 1 : 0) + (values != nullptr ? 1 : 0);
  if (given != 1) {
    problems.add(node.place, v.key + " has " + (given == 0 ? "no law" : "several laws") +
                                 "; expected one of normal: [MEAN, DEVIATION], uniform: [LOW, HIGH], values: [...]");
  } else if (normal != nullptr) {
    read_normal(node, *normal, low, high, v, problems);
  } else if (uniform != nullptr) {
    v.law = Variation::Law::uniform;
    read_pair(*uniform, v, "uniform: [LOW, HIGH]", problems);
    if (!(v.a <= v.b)) problems.add(uniform->place, v.key + " is not uniform: [LOW, HIGH] with LOW at most HIGH");
  } else {
    v.law = Variation::Law::values;
    read_values(*values, v.key + ".values", v.values, v.words, problems);
    if (v.times && v.words) problems.add(values->place, v.key + ": words cannot multiply a value");
  }
}

void read_combine(const Node& node, Replicates& replicates, Problems& problems) {
  const std::vector<std::string> known{"mean", "worst", "median", "quantile(Q)", "share(Q)"};
  const std::string word = node.text.substr(0, node.text.find('('));
  for (const auto& [combine, name] : EnumNames<Combine>::kTable) {
    if (node.kind != Node::Kind::scalar || word != name || combine == Combine::robust) continue;
    replicates.combine = combine;
    if (!replicates.has_argument() && node.text == word) return;
    if (!replicates.has_argument() || !node.text.ends_with(")")) break;
    Node number = node;
    number.text = node.text.substr(word.size() + 1, node.text.size() - word.size() - 2);
    const Reading<double> q = read_number(number, "");
    if (!q.ok() || !(q.value >= 0 && q.value <= 1)) break;
    replicates.quantile = q.value;
    return;
  }
  problems.add(node.place, "combine is " + found(node) + "; expected " + joined(known) + " with Q from 0 to 1");
}

}  // namespace

void read_replicates(const Node& node, Replicates& replicates, Problems& problems) {
  Reader reader(node, "replicates", problems, nullptr);
  reader.integer("count", replicates.count, {"", 1, 1e6, "Runs of each point."});
  if (const Node* combine = reader.take("combine")) read_combine(*combine, replicates, problems);
  if (const Node* vary = reader.take("vary")) {
    if (vary->kind != Node::Kind::map)
      problems.add(vary->place, "vary is " + found(*vary) + "; expected keys: ground.friction: {uniform: [0.6, 1]}");
    for (std::size_t i = 0; i < vary->keys.size(); ++i) {
      Variation variation;
      variation.key = vary->keys[i].first;
      variation.place = vary->keys[i].second;
      read_law(vary->items[i], variation, problems);
      replicates.vary.push_back(std::move(variation));
    }
  }
  reader.require({"count"});
  reader.finish();
}

namespace {

std::vector<std::string> split(const std::string& list, char by) {
  std::vector<std::string> parts(1);
  for (const char c : list) c == by ? parts.emplace_back() : parts.back().append(1, c);
  return parts;
}

Node scalar(const std::string& text, const SourceLocation& place) {
  Node node{Node::Kind::scalar, place};
  node.text = text;
  return node;
}

/// True for a text such as 0.1-1 or 0.1..1: two numbers joined by another sign than `:`.
bool joins_numbers(const std::string& text) {
  const auto number = [](const std::string& part) { return read_number(scalar(part, {}), "").ok(); };
  if (number(text)) return false;
  for (std::size_t i = text.find_first_of("-. ;", 1); i < text.size(); i = text.find_first_of("-. ;", i + 1)) {
    const std::size_t next = std::min(text.find_first_not_of("-. ;", i), text.size());
    if (number(text.substr(0, i)) && (number(text.substr(i + 1)) || number(text.substr(next)))) return true;
  }
  return false;
}

/// Reads LOW, HIGH and, for a grid, N.
void read_range(const std::vector<std::string>& parts, bool drawn, Parameter& parameter, Problems& problems) {
  const Reading<double> low = read_number(scalar(parts[0], parameter.place), "");
  const Reading<double> high = read_number(scalar(parts[1], parameter.place), "");
  for (const Reading<double>* one : {&low, &high}) {
    if (!one->ok()) problems.add(parameter.place, std::string(one == &low ? "LOW " : "HIGH ") + one->wrong);
  }
  if (!low.ok() || !high.ok()) return;
  parameter.low = low.value;
  parameter.high = high.value;
  check_range(parameter, parameter.place, parameter.key, problems);
  if (drawn) return;
  const Reading<std::int64_t> count = read_integer(scalar(parts[2], parameter.place));
  if (count.ok() && count.value >= 2 && count.value <= 1000000000) {
    parameter.count = count.value;
  } else {
    problems.add(parameter.place, count.ok() ? "N is " + parts[2] + "; expected 2 to 1e9" : "N " + count.wrong);
  }
}

}  // namespace

Parameter read_parameter(const std::string& option, const std::string& text, bool drawn, Problems& problems) {
  Parameter parameter;
  parameter.place = SourceLocation{option + " " + clipped(text)};
  const std::string expected =
      drawn ? "KEY=LOW:HIGH, KEY=log:LOW:HIGH or KEY=v,v,v" : "KEY=LOW:HIGH:N, KEY=log:LOW:HIGH:N or KEY=v,v,v";
  const std::size_t equals = text.find('=');
  parameter.key = text.substr(0, equals);
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    problems.add(parameter.place, "expected " + expected);
    return parameter;
  }
  std::vector<std::string> parts = split(text.substr(equals + 1), ':');
  if (parts.size() == 1 && joins_numbers(parts[0])) {
    problems.add(parameter.place, fmt::format("{} is {}; expected {}", parameter.key, in_quotes(parts[0]), expected));
    return parameter;
  }
  if (parts.size() == 1) {
    Node list{Node::Kind::list, parameter.place};
    for (const std::string& one : split(parts[0], ',')) list.items.push_back(scalar(one, parameter.place));
    read_values(list, parameter.key, parameter.values, parameter.words, problems);
    parameter.value_places.assign(list.items.size(), parameter.place);
    return parameter;
  }
  parameter.log = parts[0] == "log";
  if (parameter.log) parts.erase(parts.begin());
  if (parts.size() != (drawn ? 2U : 3U)) {
    problems.add(parameter.place, "expected " + expected);
    return parameter;
  }
  read_range(parts, drawn, parameter, problems);
  return parameter;
}

}  // namespace gaitlab::studies
