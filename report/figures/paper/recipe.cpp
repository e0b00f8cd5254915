#include "report/figures/paper/recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/settings/explainer.h"
#include "core/settings/reader.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"

namespace gaitlab::report {

namespace {

constexpr double kLongestTime = 1e9;  // s
constexpr Spec kLength{"mm", 20, 500, ""};

struct NamedSize {
  const char* name;
  double width;  ///< mm
};
// "Preparation of Papers for IEEE Transactions and Journals": one column 3.5 inches (21 picas), two columns 7.16 inches.
constexpr std::array<NamedSize, 2> kSizes{{{"ieee-column", 88.9}, {"ieee-page", 181.864}}};

const std::string& names_of_sizes() {
  static const std::string kText = "ieee-column, ieee-page or [width, height] in mm";
  return kText;
}

void read_length(const Node& node, const char* what, double& length, Problems& problems) {
  const Reading<double> reading = read_number(node, kLength.unit);
  if (!reading.ok()) {
    problems.add(node.place, fmt::format("{} {}", what, reading.wrong));
  } else if (reading.value < kLength.min || reading.value > kLength.max) {
    problems.add(node.place,
                 fmt::format("{} is {}; allowed are {}", what, with_unit(reading.value, "mm"), range_text(kLength)));
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

Explainer recipe_keys(PanelKind kind) {
  Explainer explainer;
  explainer.row("gaitlab", "", "1", "1", "Format version.");
  explainer.row(
      "size", "mm", kSizes[0].name, names_of_sizes(),
      "Size on paper: one or two columns of an IEEE journal (88.9 or 181.9 mm wide), as high as the panels need; or width "
      "and height.");
  Recipe recipe;
  recipe.panels.resize(1);
  recipe.panels.front().kind = kind;
  recipe.fields(explainer);
  return explainer;
}

}  // namespace

void AxisRecipe::fields(Fields& f) {
  f.texts(
      "columns", columns,
      "Columns of the trace to draw, by name with * and ?; a joint by number or name: joint.7.torque, joint.m3/*.torque. All "
      "of an axis have one unit.");
  f.texts("names", names, "Names in the legend, one per curve; without them those of the columns.");
  f.text("label", label, "Title of the axis; without it quantity and unit of the columns.");
  f.numbers("range", range, {"", -1e300, 1e300, "Ends of the axis, [from, to]; without them chosen by the curves."});
  if (!range.empty() && (range.size() != 2 || !(range[0] < range[1])))
    f.problem("range", "range is not [from, to] with from below to");
}

void PanelRecipe::fields(Fields& f) {
  f.choice("kind", kind, enum_names<PanelKind>(), "What is drawn; the other keys of a panel depend on it.");
  const bool curves = kind == PanelKind::curves;
  if (curves) {
    f.texts("runs", runs, "Runs whose curves are drawn, by name; without them all.");
    f.group("left", left, "Curves of the left axis.");
    f.group("right", right, "Curves of the right axis; the zeros of both meet where that wastes little paper.");
    f.text("stance", stance, "Leg whose stance is shaded, named as in the footfalls of figure.svg: m5 front left.");
  } else {
    f.text("run", run, "Run that is drawn, by name; needed where there are several.");
  }
  if (kind == PanelKind::envelope || kind == PanelKind::heat)
    f.texts("joints", joints, "Joints to draw, by name or number with * and ?: m3/active, m3/*.");
  if (kind == PanelKind::views) {
    f.numbers("times", times, {"s", 0, kLongestTime, "When the robot is drawn, from top to bottom."});
    f.text("joint", joint, "Joint that an arrow points out.");
    f.flag("legend", legend, "Whether a legend explains the colours of the bodies.");
    return;
  }
  f.number("from", from, {"s", 0, kLongestTime, "Start of what is drawn."});
  f.number_or("to", to, "end", {"s", kPositive, kLongestTime, "End of what is drawn."});
  if (to > 0 && from >= to)
    f.problem("to", fmt::format("to is {} s, not behind from, {} s", number_text(to), number_text(from)));
  if (kind != PanelKind::footfalls) f.number_or("height", height, "auto", {"mm", 10, 500, "Height of the frame."});
}

void Recipe::fields(Fields& f) {
  f.named("runs", runs, NamedValues::texts, "Names of runs and their folders, relative to this file.");
  f.number("font", font, {"pt", 7, 20, "Size of all text on paper; lines are as thick as suits it."});
  f.flag("letters", letters, "Whether several panels are lettered (a), (b), ...");
  f.list("panels", panels, "What is drawn, from top to bottom.");
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

Recipe read_recipe(const std::string& file) {
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
  const auto check = [&](const std::string& name, const std::vector<std::string>& path) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      problems.add(recipe.place(path), "run " + in_quotes(name) + " is not one of `runs`" + offer(name, names, "runs"));
  };
  if (recipe.root.find("runs") != nullptr && names.empty() && problems.empty())
    problems.add(recipe.place({"runs"}), "runs is empty; expected NAME: FOLDER");
  if (recipe.root.find("panels") != nullptr && recipe.panels.empty() && problems.empty())
    problems.add(recipe.place({"panels"}), "panels is empty; nothing would be drawn");
  constexpr std::size_t kLetters = 26;  // panels and their data files are told apart by a letter
  if (recipe.panels.size() > kLetters)
    problems.add(recipe.place({"panels"}),
                 fmt::format("panels has {} entries; allowed are up to {}", recipe.panels.size(), kLetters));
  // A panel of an unknown kind has been refused already: what it lacks is not known.
  const bool whole = problems.empty();
  for (std::size_t i = 0; i < recipe.panels.size(); ++i) {
    const std::string item = std::to_string(i);
    const PanelRecipe& panel = recipe.panels[i];
    const bool curves = panel.kind == PanelKind::curves;
    if (whole && curves && panel.left.columns.empty() && panel.right.columns.empty())
      problems.add(recipe.place({"panels", item}), "nothing is drawn; expected left: {columns: [...]}, or right");
    if (whole && panel.kind == PanelKind::views && panel.times.empty())
      problems.add(recipe.place({"panels", item}), "missing key 'times', a list of times in s");
    for (std::size_t k = 0; k < panel.runs.size(); ++k) check(panel.runs[k], {"panels", item, "runs", std::to_string(k)});
    if (!panel.run.empty()) check(panel.run, {"panels", item, "run"});
    if (panel.kind != PanelKind::curves && panel.run.empty() && names.size() > 1)
      problems.add(recipe.place({"panels", item}), "missing key 'run': there are several, " + joined(names));
  }
  problems.raise();
  return recipe;
}

std::string about_panel(PanelKind kind) {
  switch (kind) {
    case PanelKind::curves:
      return "Columns of the trace over time, on one axis or two.";
    case PanelKind::envelope:
      return "Torque of joints over their speed, in front of what their motors have at most at each speed.";
    case PanelKind::heat:
      return "Joints over time: of each cell the largest torque of the joint, as a share of what its motor has at that speed. "
             "Where no motor states a limit, as a share of the largest torque drawn.";
    case PanelKind::footfalls:
      return "When each leg of a robot stands, with its duty factor.";
    case PanelKind::views:
      return "The robot from the side of its way at some instants.";
  }
  return {};
}

std::string explain_panel(PanelKind kind) { return wrapped(about_panel(kind)) + "\n" + table(recipe_keys(kind).rows()); }

std::string recipe_page() {
  std::string page =
      "# The recipe of a figure\n\n"
      "<!-- Written by `tests/gates/reference.sh build/release --renew`; CI fails where it is stale. -->\n\n"
      "Every key of what `gaitlab figure` reads, as `gaitlab explain figure KIND` prints it; what is drawn how:\n"
      "[conventions](../conventions.md). Recipes that come with the program: `scenarios/figures/`.\n";
  for (const auto& [kind, name] : enum_table<PanelKind>()) {
    const std::vector<KeyRow> rows = recipe_keys(kind).rows();
    const bool first = kind == PanelKind::curves;
    const auto begin =
        first ? rows.begin()
              : std::find_if(rows.begin(), rows.end(), [](const KeyRow& row) { return row.key.starts_with("panels[]."); });
    page +=
        fmt::format("\n## A panel of kind `{}`{}\n\n{}\n\n", name, first ? ", and the recipe itself" : "", about_panel(kind));
    page += markdown_table({begin, rows.end()});
  }
  return page;
}

}  // namespace gaitlab::report
