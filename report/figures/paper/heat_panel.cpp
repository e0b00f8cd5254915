// Kind `heat`: joints over time, the share of their motor's torque as a colour.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/scenario/sections.h"
#include "core/settings/wording.h"
#include "report/analysis/envelope.h"
#include "report/figures/paper/paper_panel.h"
#include "report/plot/helvetica.h"

namespace gaitlab::report {

namespace {

constexpr double kHeatRow = 14;                 // px
constexpr double kLeastLabel = 13;              // px, of a row that has a name
constexpr double kCells = 240;                  // of a row
constexpr int kLevels = 20;                     // of the ramp: 5 % each
constexpr double kBarGap = 12, kBarWidth = 10;  // px

/// From white to nearly black by hues of Okabe and Ito, ever darker, so that it is read in grey, too.
std::string ramp(double share) {
  struct Stop {
    double at;
    std::array<double, 3> rgb;
  };
  constexpr std::array<Stop, 5> kStops{
      {{0, {255, 255, 255}}, {0.25, {250, 221, 150}}, {0.5, {230, 145, 20}}, {0.75, {190, 70, 0}}, {1, {70, 15, 0}}}};
  std::size_t k = 1;
  while (k + 1 < kStops.size() && share > kStops[k].at) ++k;
  const double part = std::clamp((share - kStops[k - 1].at) / (kStops[k].at - kStops[k - 1].at), 0.0, 1.0);
  std::array<int, 3> mixed{};
  for (std::size_t c = 0; c < 3; ++c)
    mixed[c] = static_cast<int>(std::lround(kStops[k - 1].rgb[c] + part * (kStops[k].rgb[c] - kStops[k - 1].rgb[c])));
  return fmt::format("#{:02X}{:02X}{:02X}", mixed[0], mixed[1], mixed[2]);
}

int level(double share) { return std::clamp(static_cast<int>(std::floor(share * kLevels)), 0, kLevels - 1); }

std::string level_colour(int level) { return ramp((level + 0.5) / kLevels); }

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
    const Rows rows = source.rows(time);
    if (source.problems.size() > before) return;
    from_ = time[rows.first];
    to_ = time[rows.last - 1];
    std::vector<Series> speed(all.size());
    std::vector<Series> torque(all.size());
    for (const std::size_t j : joints_) {
      speed[j] = run.recording.joint(j, "speed");
      torque[j] = run.recording.joint(j, "torque");
      if (!speed[j].empty() && !torque[j].empty()) continue;
      source.problem({"kind"}, fmt::format("run {} has no joint.{}.{}: simulate it with trace.columns: [joint.*]",
                                           in_quotes(run.name), j, torque[j].empty() ? "torque" : "speed"));
      return;
    }
    fill(run.scenario, time, rows, speed, torque);
  }

  [[nodiscard]] Margins margins() const override {
    double names = 0;
    for (const std::string& name : names_) names = std::max(names, helvetica_width(name, 13));
    return {11 + names, kBarGap + kBarWidth + 6 + helvetica_width("100", 13) + 20};
  }
  [[nodiscard]] double head(const Edges&) const override { return 8; }
  [[nodiscard]] double body(const Edges&) const override { return height_; }

  void draw(Canvas& canvas, const PlotArea& area) const override {
    const Ticks time = time_ticks(from_, to_);
    const double row = (area.bottom - area.top) / static_cast<double>(joints_.size());
    const auto every = static_cast<std::size_t>(std::ceil(kLeastLabel / row));
    const double gap = row > 6 ? 1 : 0;
    const Scale x{0, static_cast<double>(cell_.size()), area.left, area.right};
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const double top = area.top + row * static_cast<double>(j);
      // Each colour up to the end of the row, covered by the next one: else a thin line shows between neighbours.
      int before = -1;
      for (std::size_t c = 0; c < cell_.size(); ++c) {
        const int now = level(share_[j][c]);
        if (now == before) continue;
        const double begin = x(static_cast<double>(c));
        canvas.rectangle({begin, top + gap / 2}, area.right - begin, row - gap, {.fill = level_colour(now)});
        before = now;
      }
      if (j % every == 0) canvas.text({area.left - 8, top + row / 2 + 4.5}, names_[j], {.anchor = Anchor::end});
    }
    canvas.rectangle({area.left, area.top}, area.right - area.left, area.bottom - area.top, kAxisLine);
    const Scale seconds{from_, to_, area.left, area.right};
    for (const double t : time.values()) canvas.line({seconds(t), area.bottom}, {seconds(t), area.bottom + 4}, kAxisLine);
    draw_axis_below(canvas, area, time, "time (s)", true);
    bar(canvas, area);
  }

  [[nodiscard]] Trace data() const override {
    std::vector<DataColumn> columns{{"t [s]", cell_}};
    for (std::size_t j = 0; j < joints_.size(); ++j) columns.push_back({names_[j] + " torque share", share_[j]});
    return data_table(columns);
  }
  [[nodiscard]] std::vector<std::string> notes() const override { return notes_; }

 private:
  void fill(const Scenario& scenario, const std::vector<double>& time, const Rows& rows, const std::vector<Series>& speed,
            const std::vector<Series>& torque) {
    const AvailableTorque available(scenario);
    const bool known = std::ranges::all_of(joints_, [&](std::size_t j) { return available.known(j); });
    double largest = 0;
    for (std::size_t k = rows.first; k < rows.last && !known; ++k) {
      for (const std::size_t j : joints_) largest = std::max(largest, std::abs(torque[j][k]));
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
    std::vector<double> w(speed.size());
    std::vector<double> most(speed.size());
    std::vector<double> least(speed.size());
    for (std::size_t k = rows.first; k < rows.last; ++k) {
      const auto c = std::min(count - 1, static_cast<std::size_t>((time[k] - from_) / width + 1e-9));
      for (const std::size_t j : joints_) w[j] = speed[j][k];
      available.at(w, most, least);
      for (std::size_t i = 0; i < joints_.size(); ++i) {
        const std::size_t j = joints_[i];
        const double needed = torque[j][k];
        const double has = !known ? largest : needed >= 0 ? most[j] : -least[j];
        // A joint faster than its motor idles has nothing left: its share is whole.
        const double share = needed == 0 ? 0 : has > 0 ? std::abs(needed) / has : 1;
        share_[i][c] = std::max(share_[i][c], share);
      }
    }
  }

  void bar(Canvas& canvas, const PlotArea& area) const {
    const double left = area.right + kBarGap;
    const Scale y{0, 1, area.bottom, area.top};
    for (int k = 0; k < kLevels; ++k) {
      const double top = y(1 - k / static_cast<double>(kLevels));
      canvas.rectangle({left, top}, kBarWidth, area.bottom - top, {.fill = level_colour(kLevels - 1 - k)});
    }
    canvas.rectangle({left, area.top}, kBarWidth, area.bottom - area.top, {.stroke = colour::kInk, .width = 0.8});
    for (const int percent : {0, 50, 100}) {
      // At both ends within the height of the frame.
      const double shift = percent == 0 ? 0 : percent == 100 ? 9.5 : 4.5;
      canvas.text({left + kBarWidth + 6, y(0.01 * percent) + shift}, std::to_string(percent));
    }
    canvas.text({left + kBarWidth + 6 + helvetica_width("100", 13) + 14, (area.top + area.bottom) / 2}, title_,
                {.anchor = Anchor::middle, .upwards = true});
  }

  std::vector<std::size_t> joints_;
  std::vector<std::string> names_, notes_;
  double height_ = 0, from_ = 0, to_ = 0;
  std::vector<double> cell_;                ///< s, their starts
  std::vector<std::vector<double>> share_;  ///< per joint and cell
  std::string title_ = "torque (% of available)";
};

}  // namespace

std::unique_ptr<PaperPanel> heat_panel(const PanelSource& source) { return std::make_unique<HeatOfPanel>(source); }

}  // namespace gaitlab::report
