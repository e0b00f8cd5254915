#include "core/scenario/cpg_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/files/file_kind.h"
#include "core/settings/reader.h"
#include "core/settings/shipped_files.h"
#include "core/settings/text_file.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"

namespace gaitlab {

namespace {

constexpr const char* kEquations = "equations";
/// Parts of the model that a file states; `parameters` become those of the file.
constexpr std::array kModelParts{"states", "initial", "output", "inputs", "events"};

/// Keys of the section that are not parameters of the file.
constexpr std::array kOfSection{"type", "model", "step", "frequency", "amplitude", "offset", "phase_lag", "couplings"};

Node scalar(std::string text, const SourceLocation& place) {
  Node node{Node::Kind::scalar, place};
  node.text = std::move(text);
  return node;
}

void put(Node& map, const std::string& key, Node value) {
  map.keys.emplace_back(key, value.place);
  map.items.push_back(std::move(value));
}

/// Path of the file that the type of a section names; "" if it names none.
std::string path_of(const std::string& type, const std::string& folder, const Catalog& catalog) {
  if (type.find('/') != std::string::npos || type.ends_with(".yaml") || type.ends_with(".yml")) return path_from(folder, type);
  if (catalog.find(Kind::cpg, type) != nullptr) return {};
  const auto shipped = shipped_files("cpg");
  const auto at = shipped.find(type);
  return at == shipped.end() ? std::string() : at->second;
}

/// Reports every number of a parameter's value that is outside its range: a number, a list, or a map by joints.
void check_range(const Node& value, const CpgParameter& parameter, Problems& problems) {
  for (const Node& item : value.items) check_range(item, parameter, problems);
  if (value.kind != Node::Kind::scalar) return;
  const Reading<double> number = read_number(value, parameter.unit);
  if (!number.ok()) {
    problems.add(value.place, parameter.name + " " + number.wrong);
  } else if (!(number.value >= parameter.low && number.value <= parameter.high)) {
    problems.add(value.place,
                 fmt::format("{} is {}{}{}; expected {} to {}", parameter.name, value.text, parameter.unit.empty() ? "" : " ",
                             parameter.unit, number_text(parameter.low), number_text(parameter.high)));
  }
}

/// Adds the keys of the section that only the file states.
void put_defaults(const CpgFile& file, Node& section) {
  for (const std::string key : kOfSection) {
    const Node* const stated = file.text.find(key);
    if (stated != nullptr && section.find(key) == nullptr) put(section, key, *stated);
  }
}

/// The section with the model of a file that names a type of CPG.
Node with_model(const Node& section, const CpgFile& file, Problems& problems) {
  Node made{Node::Kind::map, section.place};
  for (std::size_t i = 0; i < section.items.size(); ++i) {
    const auto& [key, place] = section.keys[i];
    if (key == "model") {
      problems.add(place, fmt::format("model is stated by {}; change a copy of that file", in_quotes(file.path)));
    } else {
      put(made, key, key == "type" ? *file.text.find("type") : section.items[i]);
    }
  }
  put(made, "model", *file.text.find("model"));
  put_defaults(file, made);
  return made;
}

SourceLocation place_of_parameter(const CpgFile& file, const std::string& name) {
  const Node& all = *file.text.find("parameters");
  return std::ranges::find(all.keys, name, [](const auto& key) { return key.first; })->second;
}

/// Names the parameters in section `at` as the equations do: `cpg.sigma` becomes `cpg.model.parameters.sigma`.
void rename_changes(Node& root, const CpgFile& file, Problems& problems) {
  Node* const at = const_cast<Node*>(std::as_const(root).find("at"));
  if (at == nullptr) return;
  for (Node& change : at->items) {
    Node* const set = const_cast<Node*>(std::as_const(change).find("set"));
    if (set == nullptr || set->kind != Node::Kind::map) continue;
    for (std::size_t i = 0; i < set->items.size(); ++i) {
      for (const CpgParameter& one : file.parameters) {
        const std::string inside = "cpg.model.parameters." + one.name;
        std::string& key = set->keys[i].first;
        if (key != inside && key != "cpg." + one.name) continue;
        key = inside;
        check_range(set->items[i], one, problems);
      }
    }
  }
}

/// The section of type `equations` that means the same as `section`.
Node expanded(const Node& section, const CpgFile& file, Problems& problems) {
  if (file.text.find("type") != nullptr) return with_model(section, file, problems);
  Node made{Node::Kind::map, section.place};
  Node model{Node::Kind::map, section.place};
  std::vector<Node> values;
  for (const CpgParameter& one : file.parameters) values.push_back(scalar(number_text(one.value), section.place));
  for (std::size_t i = 0; i < section.items.size(); ++i) {
    const auto& [key, place] = section.keys[i];
    const Node& value = section.items[i];
    const auto own = std::ranges::find(file.parameters, key, &CpgParameter::name);
    if (own != file.parameters.end()) {
      check_range(value, *own, problems);
      values[static_cast<std::size_t>(own - file.parameters.begin())] = value;
    } else if (key == "model" && value.kind == Node::Kind::map) {
      for (std::size_t k = 0; k < value.items.size(); ++k) {
        const auto& [part, at] = value.keys[k];
        if (part == "parameters" ||
            (std::ranges::find(kModelParts, part) != kModelParts.end() && file.text.find(part) != nullptr)) {
          problems.add(at,
                       fmt::format("model.{} is stated by {}{}", part, in_quotes(file.path),
                                   part == "parameters" ? "; its parameters are keys of cpg" : "; change a copy of that file"));
        } else {
          put(model, part, value.items[k]);
        }
      }
    } else if (std::ranges::find(kOfSection, key) == kOfSection.end()) {
      std::vector<std::string> known;
      for (const CpgParameter& one : file.parameters) known.push_back(one.name);
      problems.add(place, fmt::format("unknown key {}{}", in_quotes(key), offer(key, known, "parameters of the file")));
    } else {
      put(made, key, key == "type" ? scalar(kEquations, value.place) : value);
    }
  }
  Node parameters{Node::Kind::map, section.place};
  for (std::size_t k = 0; k < values.size(); ++k) {
    parameters.keys.emplace_back(file.parameters[k].name, place_of_parameter(file, file.parameters[k].name));
    parameters.items.push_back(std::move(values[k]));
  }
  if (!parameters.items.empty()) put(model, "parameters", std::move(parameters));
  for (const char* const part : kModelParts) {
    if (const Node* const stated = file.text.find(part)) put(model, part, *stated);
  }
  put(made, "model", std::move(model));
  put_defaults(file, made);
  return made;
}

}  // namespace

void CpgParameter::fields(Fields& f) {
  f.number("value", value, {"", -1e300, 1e300, "Value without one in the scenario."});
  f.text("unit", unit, "Unit, such as 1/s.");
  f.number("low", low, {"", -1e300, 1e300, "Least value."});
  f.number("high", high, {"", -1e300, 1e300, "Largest value."});
  f.text("about", about, "One sentence.");
  if (!(low <= value && value <= high)) f.problem("value", "the value is outside low to high");
}

std::optional<CpgFile> read_cpg_file(const std::string& path, const SourceLocation& asked_at, Problems& problems) {
  expect_kind(path, FileKind::cpg);
  CpgFile file{path, {}, {}, read_yaml(path, asked_at)};
  const std::size_t before = problems.size();
  Reader reader(file.text, "CPG file", problems, nullptr);
  reader.version("gaitlab_cpg");
  std::string name;
  reader.text("name", name, "");
  reader.text("manual", file.manual, "");
  if (file.text.find("type") != nullptr) {
    std::string type;
    reader.text("type", type, "");
    const Node* const model = reader.take("model");
    if (model != nullptr && model->kind != Node::Kind::map)
      problems.add(model->place, fmt::format("model is {}; expected a map", found(*model)));
    reader.require({"gaitlab_cpg", "model"});
  } else {
    reader.by_name("parameters", file.parameters, "sigma", "");
    for (const char* const part : kModelParts) reader.take(part);
    reader.require({"gaitlab_cpg", "states", "output"});
  }
  for (const char* const key : kOfSection) reader.take(key);  // defaults of the scenario's section
  reader.finish();
  for (const CpgParameter& one : file.parameters) {
    if (std::ranges::find(kOfSection, one.name) != kOfSection.end()) {
      problems.add(place_of_parameter(file, one.name),
                   fmt::format("{} is a key of cpg itself; expected another name", in_quotes(one.name)));
    }
  }
  if (problems.size() > before) return {};
  return file;
}

std::string manual_of(const CpgFile& file) {
  std::string text = file.manual;
  if (!text.ends_with('\n')) text += "\n";
  if (!file.parameters.empty())
    text += "\nparameters, keys of cpg beside frequency, amplitude, offset, phase_lag, couplings:\n";
  for (const CpgParameter& one : file.parameters) {
    text += fmt::format("  {:<18} {}{}, {} to {}: {}\n", one.name, number_text(one.value),
                        one.unit.empty() ? "" : " " + one.unit, number_text(one.low), number_text(one.high), one.about);
  }
  return text;
}

std::optional<Node> insert_cpg_file(Node& root, const std::string& folder, const Catalog& catalog, Problems& problems) {
  const Node* const section = root.find("cpg");
  if (section == nullptr || section->kind != Node::Kind::map) return {};
  const Node* const type = section->find("type");
  if (type == nullptr || type->kind != Node::Kind::scalar) return {};
  const std::string path = path_of(type->text, folder, catalog);
  if (path.empty()) return {};
  Problems in_file;
  std::optional<CpgFile> file;
  try {
    file = read_cpg_file(path, type->place, in_file);
  } catch (const InputError& error) {
    add_all(error, in_file);
  }
  add_found(in_file, {path, folder, "CPG file", "gaitlab_cpg"}, problems);
  if (!file) return {};
  rename_changes(root, *file, problems);
  Node made = expanded(*section, *file, problems);
  return std::exchange(root.items[static_cast<std::size_t>(section - root.items.data())], std::move(made));
}

}  // namespace gaitlab
