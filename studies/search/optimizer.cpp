#include "studies/search/optimizer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/settings/wording.h"
#include "studies/search/box.h"
#include "studies/search/fitness.h"
#include "studies/search/search.h"
#include "studies/study/number.h"
#include "studies/study/population.h"

namespace gaitlab::studies {

namespace {

SearchSettings search_settings(const Study& study, std::uint64_t number, std::vector<Vector> starts) {
  return {.algorithm = study.method,
          .dimensions = dimensions(study),
          .objectives = study.objectives.size(),
          .population = static_cast<std::size_t>(study.search.population),
          .restarts = static_cast<std::size_t>(study.search.restarts),
          .sigma = study.search.sigma,
          .seed = static_cast<std::uint64_t>(study.seed),
          .number = number,
          .starts = std::move(starts)};
}

/// Values of all parameters in the form of --set, from a combination of the listed values and a point in the box of the
/// remaining parameters.
std::vector<std::string> values_at(const Study& study, std::size_t combination, const Vector& point) {
  std::vector<std::string> values(study.parameters.size());
  std::size_t coordinate = point.size();
  for (std::size_t k = values.size(); k-- > 0;) {
    const Parameter& p = study.parameters[k];
    if (p.values.empty()) {
      values[k] = number_text(between(p, point[--coordinate]));
    } else {
      values[k] = p.values[combination % p.values.size()];
      combination /= p.values.size();
    }
  }
  return values;
}

/// A first point of a search: its coordinates, and the values of all parameters, digit for digit.
struct Start {
  Vector point;
  std::vector<std::string> values;
};

/// The study's first points for a combination of the listed values. `start` points with other listed values belong to other
/// combinations; the scenario's own point belongs to all.
std::vector<Start> starts_of(const BoundStudy& bound, std::size_t combination) {
  const Study& study = bound.study();
  const std::vector<std::string> listed = values_at(study, combination, Vector(dimensions(study), 0.0));
  const std::size_t own = bound.starts().size() - study.starts.size();
  std::vector<Start> starts;
  for (std::size_t k = 0; k < bound.starts().size(); ++k) {
    std::vector<std::string> values = bound.starts()[k];
    Vector point;
    bool of_this = true;
    for (std::size_t p = 0; p < values.size(); ++p) {
      const Parameter& parameter = study.parameters[p];
      if (parameter.values.empty()) {
        point.push_back(share_at(parameter, number_of(values[p])));
        continue;
      }
      of_this = of_this && (k < own || values[p] == listed[p]);
      values[p] = listed[p];
    }
    if (of_this) starts.push_back({within_box(std::move(point)), std::move(values)});
  }
  return starts;
}

std::vector<Vector> points_of(const std::vector<Start>& starts) {
  std::vector<Vector> points;
  for (const Start& start : starts) points.push_back(start.point);
  return points;
}

/// One search, with the points of its present generation.
struct Course {
  std::size_t combination;
  std::vector<Start> starts;
  Search search;
  bool refused = false;  ///< true if the scenario refused all points of the first block
  std::vector<std::uint64_t> points = {};
  std::uint64_t first = 0, added = 0;  ///< number of the first new point, and number of new points
};

class Optimizer {
 public:
  Optimizer(Plan& plan, Journal& journal, RunnerSettings settings)
      : plan_(plan), journal_(journal), runner_(plan, journal, keeping(std::move(settings))), before_(present()) {
    const auto instances = static_cast<std::size_t>(plan.study().search.instances);
    for (std::size_t s = 0; s < instances * combinations(plan.study()); ++s) {
      std::vector<Start> starts = starts_of(plan.bound(), s / instances);
      Search search(search_settings(plan.study(), s, points_of(starts)));
      courses_.push_back({s / instances, std::move(starts), std::move(search)});
    }
  }

  SearchEnd run(const std::function<void(const SearchPlace&)>& told, std::atomic<bool>& stop) {
    const std::uint64_t runs = plan_.points().runs_of_point();
    for (bool whole = true; whole;) {
      const std::uint64_t first = added_;
      whole = ask();
      if (added_ == first && whole && std::ranges::all_of(courses_, [](const Course& c) { return c.points.empty(); }))
        return std::ranges::all_of(courses_, &Course::refused) ? SearchEnd::refused : SearchEnd::converged;
      check(first);
      told(place(added_ - first));
      if (!runner_.run(added_ * runs, stop)) return SearchEnd::stopped;
      if (whole) tell();
    }
    return SearchEnd::budget;
  }

 private:
  RunnerSettings keeping(RunnerSettings settings) {
    answers_.resize(plan_.most_runs());
    settings.ended = [this, also = std::move(settings.ended)](const Brief& run) {
      answers_[run.run] = run;
      also(run);
    };
    return settings;
  }

  std::vector<bool> present() { return journal_.present(plan_.most_runs()); }

  /// Adds the points that the searches request. Returns false if the budget ends within this generation.
  bool ask() {
    for (std::size_t s = 0; s < courses_.size(); ++s) {
      Course& course = courses_[s];
      course.points.clear();
      course.first = added_;
      course.added = 0;
      if (course.refused) continue;
      for (const Vector& point : course.search.ask()) {
        const auto start = std::ranges::find(course.starts, point, &Start::point);
        std::vector<std::string> values =
            start != course.starts.end() ? start->values : values_at(plan_.study(), course.combination, point);
        const auto [at, is_new] = memo_.try_emplace(std::move(values), added_);
        if (is_new && added_ == plan_.points().points()) return false;
        course.points.push_back(at->second);
        if (!is_new) continue;
        plan_.add(at->first);
        ++added_;
        ++course.added;
      }
    }
    return true;
  }

  /// Checks that the first new run of a search is at the requested point, if the journal contains that run already.
  void check(std::uint64_t first) {
    const std::uint64_t run = first * plan_.points().runs_of_point();
    if (run >= added_ * plan_.points().runs_of_point() || !before_[run]) return;
    if (journal_.row(run)[1] != plan_.row(run).point) {
      throw InputError(SourceLocation{"study.db"},
                       fmt::format("run {} is at another point than method {} of {} requires; choose another folder (--out)",
                                   run, name_of(plan_.study().method),
                                   enum_row(plan_.study().method).of_pagmo ? evolution_library() : "this build"));
    }
  }

  [[nodiscard]] SearchPlace place(std::uint64_t points) const {
    SearchPlace place{courses_.size(), 0, 0, points * plan_.points().runs_of_point()};
    for (const Course& course : courses_) {
      place.generation = std::max(place.generation, course.search.generation() + 1);
      place.restart = std::max(place.restart, course.search.restart());
    }
    return place;
  }

  [[nodiscard]] PointResult result(std::uint64_t point) const {
    const std::uint64_t runs = plan_.points().runs_of_point();
    return point_result(journal_.head(), std::span(answers_).subspan(point * runs, runs));
  }

  /// True if the scenario refused all runs of these points.
  [[nodiscard]] bool all_refused(const std::vector<std::uint64_t>& points) const {
    const std::uint64_t runs = plan_.points().runs_of_point();
    const auto refused = [](const Brief& run) { return run.outcome == "refused"; };
    return std::ranges::all_of(points, [&](std::uint64_t point) {
      return std::ranges::all_of(std::span(answers_).subspan(point * runs, runs), refused);
    });
  }

  void tell() {
    std::vector<Generation> generations;
    for (std::size_t s = 0; s < courses_.size(); ++s) {
      Course& course = courses_[s];
      if (course.points.empty()) continue;
      std::vector<Rating> ratings;
      Generation g{.search = s,
                   .generation = course.search.generation(),
                   .restart = course.search.restart(),
                   .first_run = course.first * plan_.points().runs_of_point(),
                   .runs = course.added * plan_.points().runs_of_point(),
                   .points = course.points.size(),
                   .spread = course.search.spread()};
      std::vector<double> kept;
      for (const std::uint64_t point : course.points) {
        const PointResult one = result(point);
        ratings.push_back(rating(one, journal_.head().objectives, plan_.longest()));
        if (one.kept()) kept.push_back(one.score.objective());
      }
      g.kept = kept.size();
      if (!kept.empty()) {
        const bool maximize = plan_.study().objectives.front().maximize;
        g.best = maximize ? std::ranges::max(kept) : std::ranges::min(kept);
        g.median = combined(std::move(kept), "median", 0.5);
      }
      generations.push_back(g);
      course.refused = g.generation == 0 && all_refused(course.points);
      course.search.tell(ratings);
    }
    journal_.write(generations);
  }

  Plan& plan_;
  Journal& journal_;
  std::vector<Brief> answers_;  ///< results by run number
  Runner runner_;
  std::vector<bool> before_;  ///< true if the journal contains the run with this index at the start
  std::vector<Course> courses_;
  std::map<std::vector<std::string>, std::uint64_t> memo_;  ///< numbers of points by their values
  std::uint64_t added_ = 0;                                 ///< number of points
};

}  // namespace

SearchEnd run_searches(Plan& plan, Journal& journal, RunnerSettings settings,
                       const std::function<void(const SearchPlace&)>& told, std::atomic<bool>& stop) {
  return Optimizer(plan, journal, std::move(settings)).run(told, stop);
}

}  // namespace gaitlab::studies
