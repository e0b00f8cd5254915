#include "report/figures/paper/recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/files/file_kind.h"
#include "core/settings/explainer.h"
#include "core/settings/number_syntax.h"
#include "core/settings/reader.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"
#include "report/figures/paper/panel_kinds.h"

namespace gaitlab::report {

namespace {

constexpr Spec kLength{"mm", 20, 500, ""};

struct NamedSize {
  const char* name;
  double width;  ///< mm
};
// Sizes from "Preparation of Papers for IEEE Transactions and Journals": one column is 3.5 inches (21 picas), two columns are
// 7.16 inches.
constexpr std::array<NamedSize, 2> kSizes{{{"ieee-column", 88.9}, {"ieee-page", 181.864}}};

const std::string& names_of_sizes() {
  static const std::string kText = "ieee-column, ieee-page, a width in mm or [width, height] in mm";
  return kText;
}

void read_length(const Node& node, const char* what, double& length, Problems& problems) {
  const Reading<double> reading = read_number(node, kLength.unit);
  if (!reading.ok()) {
    problems.add(node.place, fmt::format("{} {}", what, reading.wrong));
  } else if (reading.value < kLength.min || reading.value > kLength.max) {
    problems.add(node.place, fmt::format("{} is {}; expected {}", what, with_unit(reading.value, "mm"), range_text(kLength)));
  } else {
    length = reading.value;
  }
}

void read_size(const Node& node, Recipe& recipe, Problems& problems) {
  if (node.kind == Node::Kind::list && node.items.size() == 2) {
    read_length(node.items[0], "size[0], the width,", recipe.width, problems);
    read_length(node.items[1], "size[1], the height,", recipe.height, problems);
    return;
  }
  if (node.kind == Node::Kind::scalar && looks_like_a_number(node.text)) {
    read_length(node, "size, the width,", recipe.width, problems);
    return;
  }
  const auto* const named = std::find_if(kSizes.begin(), kSizes.end(), [&](const NamedSize& size) {
    return node.kind == Node::Kind::scalar && node.text == size.name;
  });
  if (named != kSizes.end()) {
    recipe.width = named->width;
    return;
  }
  std::string near;
  if (node.kind == Node::Kind::scalar) {
    near = nearest(node.text, {kSizes[0].name, kSizes[1].name});
    if (!near.empty()) near = "; did you mean '" + near + "'?";
  }
  const std::string what = node.kind == Node::Kind::list ? counted(node.items.size(), "item") : found(node);
  problems.add(node.place, fmt::format("size is {}; expected {}{}", what, names_of_sizes(), near));
}

Explainer recipe_keys(const PanelKind& kind) {
  Explainer explainer;
  explainer.row("gaitlab", "", "1", "1", "Format version.");
  explainer.row(
      "size", "mm", kSizes[0].name, names_of_sizes(),
      "Size on paper: one or two columns of an IEEE journal (88.9 or 181.9 mm wide) or another width (84 and 174 are usual), "
      "with the height that the panels need; or width and height.");
  Recipe recipe;
  recipe.panels.resize(1);
  recipe.panels.front().kind = &kind;
  recipe.fields(explainer);
  return explainer;
}

}  // namespace

void AxisRecipe::fields(Fields& f) {
  f.texts("columns", columns,
          "Columns of the trace to draw, by name with * and ?; a joint by number or name: joint.7.torque, joint.m3/*.torque. "
          "All columns of an axis have the same unit.");
  f.texts("names", names, "Names in the legend, one per curve; default: the names of the columns.");
  f.text("label", label, "Title of the axis; default: quantity and unit of the columns.");
  f.numbers("range", range, {"", -1e300, 1e300, "Ends of the axis, [from, to]; default: chosen to fit the curves."});
  f.number("least", least, {"", 0, 1e300, "The axis extends at least this far below and above zero; not with log."});
  f.flag("log", log, "Logarithmic axis; values that are not above 0 leave a gap.");
  if (!range.empty() && (range.size() != 2 || !(range[0] < range[1])))
    f.problem("range", "range is not [FROM, TO] with FROM less than TO");
  if (log && !range.empty() && !(range[0] > 0)) {
    f.problem("range",
              fmt::format("range begins at {}; expected numbers above 0 on a logarithmic axis", number_text(range[0])));
  }
  if (log && least > 0) f.problem("least", "`least` extends a linear axis; remove `least` or `log`");
}

PanelRecipe::PanelRecipe() : kind(kPanelKinds[0]) {}

void PanelRecipe::fields(Fields& f) {
  std::string name = kind->name;
  f.one_of("kind", name, panel_names(), "Kind of panel; the other keys depend on it.");
  kind = &panel_kind(name);
  f.text("title", title, "Title above the panel.");
  if (kind->one_run) f.text("run", run, "Run that is drawn, by name; required if there are several.");
  kind->fields(*this, f);
}

void PanelRecipe::time_fields(Fields& f) {
  f.number("from", from, {"s", 0, kLongestTime, "Start of the drawn time."});
  f.number_or("to", to, "end", {"s", kPositive, kLongestTime, "End of the drawn time."});
  if (to > 0 && from >= to)
    f.problem("to", fmt::format("`to` is {} s, which is not after `from`, {} s", number_text(to), number_text(from)));
}

void PanelRecipe::height_field(Fields& f) { f.number_or("height", height, "auto", {"mm", 10, 500, "Height of the frame."}); }

void PanelRecipe::joint_fields(Fields& f) {
  f.texts("joints", joints, "Joints to draw, by name or number with * and ?: m3/active, m3/*.");
  time_fields(f);
  height_field(f);
}

void Recipe::fields(Fields& f) {
  f.named("runs", runs, NamedValues::texts, "Names of runs and their folders, relative to this file.");
  f.text("title", title, "Title above the figure.");
  f.number("font", font, {"pt", 7, 20, "Font size on paper; line widths scale with it."});
  f.flag("letters", letters, "Letters (a), (b), ... on the panels if there are several.");
  f.list("panels", panels, "Panels, from top to bottom.");
}

SourceLocation Recipe::place(const std::vector<std::string>& path) const {
  const Node* node = &root;
  for (const std::string& step : path) {
    const Node* next = node->kind == Node::Kind::map ? node->find(step) : nullptr;
    if (node->kind == Node::Kind::list) {
      const std::size_t item = std::stoul(step);
      next = item < node->items.size() ? &node->items[item] : nullptr;
    }
    if (next == nullptr) break;
    node = next;
  }
  return node->place;
}

namespace {

void check_panel(const Recipe& recipe, std::size_t number, const std::vector<std::string>& names, bool whole,
                 Problems& problems) {
  const PanelRecipe& panel = recipe.panels[number];
  const std::vector<std::string> place{"panels", std::to_string(number)};
  const auto check = [&](const std::string& name, const std::vector<std::string>& path) {
    if (std::ranges::find(names, name) != names.end()) return;
    std::vector<std::string> at = place;
    at.insert(at.end(), path.begin(), path.end());
    problems.add(recipe.place(at), "run " + in_quotes(name) + " is not one of `runs`" + offer(name, names, "runs"));
  };
  if (const char* const lacking = panel.kind->lacking(panel); whole && lacking != nullptr)
    problems.add(recipe.place(place), lacking);
  for (std::size_t k = 0; k < panel.runs.size(); ++k) check(panel.runs[k], {"runs", std::to_string(k)});
  if (!panel.run.empty()) check(panel.run, {"run"});
  if (panel.kind->one_run && panel.run.empty() && names.size() > 1)
    problems.add(recipe.place(place), "missing key 'run': there are several, " + joined(names));
}

}  // namespace

Recipe read_recipe(const std::string& file) {
  expect_kind(file, FileKind::recipe);
  Recipe recipe;
  recipe.file = file;
  recipe.root = read_yaml(file);
  Problems problems;
  Reader reader(recipe.root, "the recipe", problems, nullptr);
  if (!reader.version("gaitlab")) problems.raise();
  if (const Node* size = reader.take("size")) read_size(*size, recipe, problems);
  recipe.fields(reader);
  reader.require({"runs", "panels"});
  reader.finish();
  std::vector<std::string> names;
  for (const Named& run : recipe.runs) names.push_back(run.name);
  if (recipe.root.find("runs") != nullptr && names.empty() && problems.empty())
    problems.add(recipe.place({"runs"}), "runs is empty; expected NAME: FOLDER");
  if (recipe.root.find("panels") != nullptr && recipe.panels.empty() && problems.empty())
    problems.add(recipe.place({"panels"}), "panels is empty; nothing would be drawn");
  constexpr std::size_t kLetters = 26;  // panels and their data files are distinguished by a letter
  if (recipe.panels.size() > kLetters) {
    problems.add(recipe.place({"panels"}),
                 fmt::format("panels has {} entries; expected at most {}", recipe.panels.size(), kLetters));
  }
  // A panel of an unknown kind has already been refused, and its missing keys are not known.
  const bool whole = problems.empty();
  for (std::size_t i = 0; i < recipe.panels.size(); ++i) check_panel(recipe, i, names, whole, problems);
  problems.raise();
  return recipe;
}

std::span<const char* const> panel_names() {
  static const std::vector<const char*> kNames = [] {
    std::vector<const char*> names;
    for (const PanelKind* kind : kPanelKinds) names.push_back(kind->name);
    return names;
  }();
  return kNames;
}

const PanelKind& panel_kind(std::string_view name) {
  return **std::ranges::find_if(kPanelKinds, [&](const PanelKind* kind) { return kind->name == name; });
}

std::string explain_panel(const PanelKind& kind) { return wrapped(kind.about) + "\n" + table(recipe_keys(kind).rows()); }

std::string recipe_page() {
  std::string page =
      "# The recipe of a figure\n\n"
      "<!-- Written by `tests/gates/reference.sh build/release --renew`; CI fails where it is stale. -->\n\n"
      "All keys that `gaitlab figure` reads, as `gaitlab explain figure KIND` prints them. Rules of drawing:\n"
      "[files](../files.md#figure-recipes). Recipes that come with the program: `scenarios/figures/`.\n";
  for (const PanelKind* kind : kPanelKinds) {
    const std::vector<KeyRow> rows = recipe_keys(*kind).rows();
    const bool first = kind == kPanelKinds[0];
    const auto begin =
        first ? rows.begin()
              : std::find_if(rows.begin(), rows.end(), [](const KeyRow& row) { return row.key.starts_with("panels[]."); });
    page +=
        fmt::format("\n## A panel of kind `{}`{}\n\n{}\n\n", kind->name, first ? ", and the recipe itself" : "", kind->about);
    page += markdown_table({begin, rows.end()});
  }
  return page;
}

}  // namespace gaitlab::report
