#include "report/figures/paper/paper_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/settings/wording.h"
#include "report/figures/paper/panel_kinds.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr double kTextSize = 13;         // px, of all text
constexpr double kPointMm = 25.4 / 72;   // mm
constexpr double kTopMargin = 4;         // px
constexpr double kBetweenPanels = 10;    // px
constexpr double kLetterHeight = 18;     // px, least height above a frame with a letter, and height of a title
constexpr double kHeadingHeight = 40;    // px, of the title of the figure
constexpr double kLeastFrame = 10;       // mm
constexpr double kLeastFrameWidth = 25;  // mm

std::string title_of(const Recipe& recipe) {
  if (!recipe.title.empty()) return recipe.title;
  std::vector<std::string> titles;
  for (const PanelRecipe& panel : recipe.panels) {
    std::vector<std::string> runs = panel.runs;
    if (panel.kind->one_run) runs = {panel.run.empty() ? recipe.runs.front().name : panel.run};
    if (runs.empty()) std::ranges::transform(recipe.runs, std::back_inserter(runs), &Named::name);
    titles.push_back(fmt::format("{} of {}", panel.kind->name, fmt::join(runs, ", ")));
  }
  return fmt::format("{}", fmt::join(titles, "; "));
}

}  // namespace

PaperFigure::PaperFigure(const Recipe& recipe, std::span<const PaperRun> runs)
    : heading_(recipe.title), margin_(recipe.margin), letters_(recipe.letters && recipe.panels.size() > 1) {
  paper_.mm = recipe.font * kPointMm / kTextSize;
  paper_.width = recipe.width / paper_.mm;
  Problems problems;
  for (std::size_t i = 0; i < recipe.panels.size(); ++i) {
    const std::string& title = recipe.panels[i].title;
    Placed& placed = panels_.emplace_back();
    placed.panel = recipe.panels[i].kind->make({recipe, i, runs, 1 / paper_.mm, problems});
    placed.title = title.empty() ? placed.panel->title() : title;
  }
  problems.raise();
  title_ = title_of(recipe);
  place(recipe);
}

Edges PaperFigure::edges(const Recipe& recipe) const {
  double left = 0;
  double right = 0;
  for (const Placed& placed : panels_) {
    left = std::max(left, recipe.margin + placed.panel->margins().left);
    right = std::max(right, recipe.margin + placed.panel->margins().right);
  }
  const double width = (paper_.width - left - right) * paper_.mm;
  if (width < kLeastFrameWidth) {
    throw InputError(
        recipe.place({"size"}),
        fmt::format("a width of {} leaves {:.1f} mm for the frames beside their labels; at least {:g} mm are needed",
                    with_unit(recipe.width, "mm"), width, kLeastFrameWidth));
  }
  return {left, paper_.width - right};
}

void PaperFigure::place(const Recipe& recipe) {
  const Edges frame = edges(recipe);
  const double heading = kTopMargin + (heading_.empty() ? 0 : kHeadingHeight);
  double fixed = heading - kBetweenPanels;
  double stretching = 0;
  double least = 0;
  const auto head = [&](const Placed& placed) {
    const double own = placed.panel->head(frame);
    return placed.title.empty() ? std::max(own, letters_ ? kLetterHeight : 0.0) : own + kLetterHeight;
  };
  for (const Placed& placed : panels_) {
    fixed += head(placed) + placed.panel->foot() + kBetweenPanels;
    (placed.panel->stretches() ? stretching : fixed) += placed.panel->body(frame);
    least += placed.panel->stretches() ? kLeastFrame / paper_.mm : 0;
  }
  paper_.height = recipe.height > 0 ? recipe.height / paper_.mm : fixed + stretching;
  if (recipe.height > 0 && fixed + least > paper_.height) {
    throw InputError(recipe.place({"size", "1"}),
                     fmt::format("a height of {} is too small: the panels need {:.0f} mm", with_unit(recipe.height, "mm"),
                                 (fixed + least) * paper_.mm + 0.5));
  }
  const double factor = recipe.height > 0 && stretching > 0 ? (paper_.height - fixed) / stretching : 1;
  double y = heading;
  for (Placed& placed : panels_) {
    placed.top = y;
    y += head(placed);
    const double body = placed.panel->body(frame) * (placed.panel->stretches() ? factor : 1);
    placed.area = {frame.left, frame.right, y, y + body};
    y += body + placed.panel->foot() + kBetweenPanels;
  }
}

void PaperFigure::draw(Canvas& canvas) const {
  if (!heading_.empty()) {
    const double size = fitting_size(heading_, 18, 10, paper_.width - 80);
    canvas.text({paper_.width / 2, kTopMargin + 20}, heading_, {.size = size, .anchor = Anchor::middle, .bold = true});
  }
  char letter = 'a';
  for (const Placed& placed : panels_) {
    placed.panel->draw(canvas, placed.area);
    if (!placed.title.empty()) {
      const double size = fitting_size(placed.title, kTextSize, 8, placed.area.right - placed.area.left);
      canvas.text({placed.area.left, placed.top + 13}, placed.title, {.size = size, .bold = true});
    }
    if (letters_) canvas.text({margin_, placed.top + 13}, fmt::format("({})", letter), {.bold = true});
    ++letter;
  }
}

Recipe screen_recipe(std::string title) {
  constexpr double kPixel = 25.4 / 96;  // mm
  Recipe recipe;
  recipe.title = std::move(title);
  recipe.width = 1000 * kPixel;
  recipe.font = kTextSize * kPixel / kPointMm;
  recipe.letters = false;
  recipe.margin = 30;  // the font of a screen may be wider than Helvetica
  return recipe;
}

std::string figure_svg(const Recipe& recipe, std::span<const PaperRun> runs) {
  const PaperFigure figure(recipe, runs);
  Svg svg(figure.paper(), figure.title());
  figure.draw(svg);
  return svg.finish();
}

std::vector<Trace> PaperFigure::data() const {
  std::vector<Trace> tables;
  for (const Placed& placed : panels_) tables.push_back(placed.panel->data());
  return tables;
}

std::vector<std::string> PaperFigure::notes() const {
  std::vector<std::string> notes;
  for (const Placed& placed : panels_) {
    for (const std::string& note : placed.panel->notes()) notes.push_back(note);
  }
  return notes;
}

}  // namespace gaitlab::report
