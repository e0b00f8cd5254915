// Panel kind `heat`, which shows over time the share of its motor's torque that each joint uses, as a colour.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/scenario/sections.h"
#include "core/settings/wording.h"
#include "report/analysis/envelope.h"
#include "report/figures/paper/paper_panel.h"

namespace gaitlab::report {

namespace {

constexpr double kHeatRow = 14;                 // px
constexpr double kLeastLabel = 13;              // px, least height of a row with a name
constexpr double kCells = 240;                  // cells per row
constexpr int kLevels = 20;                     // levels of the colour ramp, 5 % each
constexpr double kBarGap = 12, kBarWidth = 10;  // px

/// Colours from white to nearly black with hues of Okabe and Ito. They darken steadily, so that the figure is also readable in
/// grey.
constexpr std::array<Rgb, 5> kHeat{{{255, 255, 255}, {250, 221, 150}, {230, 145, 20}, {190, 70, 0}, {70, 15, 0}}};

int level(double share) { return std::clamp(static_cast<int>(std::floor(share * kLevels)), 0, kLevels - 1); }

std::string level_colour(int level) { return ramp(kHeat, (level + 0.5) / kLevels); }

class HeatOfPanel final : public PaperPanel {
 public:
  explicit HeatOfPanel(const PanelSource& source) {
    const PaperRun& run = source.run();
    joints_ = source.joints();
    const std::vector<std::string> all = joint_names(*run.scenario.robot);
    for (const std::size_t j : joints_) names_.push_back(all[j]);
    height_ = source.height(kHeatRow * static_cast<double>(std::max<std::size_t>(joints_.size(), 3)) / source.px_per_mm);
    const std::vector<double> time = row_times(run.recording);
    const std::size_t before = source.problems.size();
    const RowRange rows = source.rows(time);
    if (source.problems.size() > before) return;
    from_ = time[rows.first];
    to_ = time[rows.last - 1];
    std::vector<JointLoad> load;
    for (const std::size_t j : joints_) {
      const std::optional<JointLoad> one = source.load(j);
      if (!one) return;
      load.push_back(*one);
    }
    fill(run.scenario, time, rows, load);
  }

  [[nodiscard]] Margins margins() const override {
    return {texts_beside(row_ticks(names_)) + 3, kBarGap + kBarWidth + texts_beside(percent()) + 18};
  }
  [[nodiscard]] double head(const Edges&) const override { return 8; }
  [[nodiscard]] double body(const Edges&) const override { return height_; }

  void draw(Canvas& canvas, const PlotArea& area) const override {
    const double row = (area.bottom - area.top) / static_cast<double>(joints_.size());
    const auto every = static_cast<std::size_t>(std::ceil(kLeastLabel / row));
    Axis below = time_axis(from_, to_);
    below.lines = TickLines::outside;
    const Plot plot(canvas, area, below, {.ticks = row_ticks(names_, every), .lines = TickLines::none}, kPrint);
    const double gap = row > 6 ? 1 : 0;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const double top = area.top + row * static_cast<double>(j);
      // Each colour extends to the end of the row and is covered by the next one. Otherwise a thin line would be visible
      // between neighbours.
      int before = -1;
      for (std::size_t c = 0; c < cell_.size(); ++c) {
        const int now = level(share_[j][c]);
        if (now == before) continue;
        const double begin = plot.at(cell_[c], 0).x;
        canvas.rectangle({begin, top + gap / 2}, area.right - begin, row - gap, {.fill = level_colour(now)});
        before = now;
      }
    }
    plot.draw_axes();
    std::vector<std::string> colours;
    for (int k = 0; k < kLevels; ++k) colours.push_back(level_colour(k));
    draw_colours(canvas, {area.right + kBarGap, area.right + kBarGap + kBarWidth, area.top, area.bottom}, colours,
                 {.ticks = percent(), .title = title_, .away = texts_beside(percent()) + 14}, kPrint);
  }

  [[nodiscard]] Trace data() const override {
    std::vector<DataColumn> columns{{"t [s]", cell_}};
    for (std::size_t j = 0; j < joints_.size(); ++j) columns.push_back({names_[j] + " torque share", share_[j]});
    return data_table(columns);
  }
  [[nodiscard]] std::vector<std::string> notes() const override { return notes_; }

 private:
  static Ticks percent() { return ticks_within(0, 100, 2); }

  void fill(const Scenario& scenario, const std::vector<double>& time, const RowRange& rows,
            const std::vector<JointLoad>& load) {
    const AvailableTorque available(scenario);
    const bool known = std::ranges::all_of(joints_, [&](std::size_t j) { return available.known(j); });
    double largest = 0;
    for (std::size_t k = rows.first; k < rows.last && !known; ++k) {
      for (const JointLoad& one : load) largest = std::max(largest, std::abs(one.torque[k]));
    }
    if (!known) {
      title_ = "torque (% of the largest)";
      notes_.push_back(
          fmt::format("no motor states a limit: the heat map is in shares of the largest torque, {:.4g} N m", largest));
    }
    const auto count = std::min<std::size_t>(static_cast<std::size_t>(kCells), rows.last - rows.first - 1);
    const double width = (to_ - from_) / static_cast<double>(count);
    for (std::size_t c = 0; c < count; ++c) cell_.push_back(from_ + width * static_cast<double>(c));
    share_.assign(joints_.size(), std::vector<double>(count, 0.0));
    std::vector<double> w(scenario.robot->joints.size());
    std::vector<double> most(w.size());
    std::vector<double> least(w.size());
    for (std::size_t k = rows.first; k < rows.last; ++k) {
      const auto c = std::min(count - 1, static_cast<std::size_t>((time[k] - from_) / width + 1e-9));
      for (std::size_t i = 0; i < joints_.size(); ++i) w[joints_[i]] = load[i].speed[k];
      available.at(w, most, least);
      for (std::size_t i = 0; i < joints_.size(); ++i) {
        const std::size_t j = joints_[i];
        const double needed = load[i].torque[k];
        const double has = !known ? largest : needed >= 0 ? most[j] : -least[j];
        // A joint that is faster than its motor's no-load speed has no available torque: its share is 1.
        const double share = needed == 0 ? 0 : has > 0 ? std::abs(needed) / has : 1;
        share_[i][c] = std::max(share_[i][c], share);
      }
    }
  }

  std::vector<std::size_t> joints_;
  std::vector<std::string> names_, notes_;
  double height_ = 0, from_ = 0, to_ = 0;
  std::vector<double> cell_;                ///< s, start time of each cell
  std::vector<std::vector<double>> share_;  ///< one list per joint, one share per cell
  std::string title_ = "torque (% of available)";
};

}  // namespace

const PanelKind kHeatPanel{
    .name = "heat",
    .about =
        "Joints over time: each cell shows the largest torque of the joint as a share of its motor's largest torque at that "
        "speed (if no motor states a limit, of the largest torque drawn).",
    .one_run = true,
    .fields = [](PanelRecipe& panel, Fields& f) { panel.joint_fields(f); },
    .lacking = nothing_lacks,
    .make = made<HeatOfPanel>};

}  // namespace gaitlab::report
