// Results without simulation: rows of other studies, and points that were requested twice.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "studies/run/executor.h"

namespace gaitlab::studies {

/// Rows of another study's journal that are results of this study's runs: same point, replicate, seed and draws. Scores are
/// computed anew, so that objective, constraints and guards may differ.
class Answers {
 public:
  /// Opens the journal (study.db, or its folder). The plan must outlive this object. Throws InputError if the file is not a
  /// journal, lacks a quantity that this study needs, or has other stop rules, except `hopeless`. Throws InputError also if a
  /// build other than `build` wrote the journal, unless `taken` is `any`.
  Answers(const Plan& plan, std::filesystem::path journal, const std::string& build, Journal::Build taken);

  /// The row of a run, found by the values that Plan::row gives; nothing if the journal lacks it, or if a rule stopped the run
  /// that may not stop it in this study: only one of them has the rule `hopeless`, or their guards differ. Only one thread at a
  /// time may call this.
  [[nodiscard]] std::optional<Row> find(const Row& wanted);

 private:
  [[nodiscard]] bool same_values(const Row& wanted, const std::vector<std::string>& there) const;

  const Plan& plan_;
  std::unique_ptr<Journal> journal_;
  std::map<std::string, std::uint64_t> runs_;     ///< run numbers by point, replicate, seed and scenario
  std::vector<std::size_t> values_, quantities_;  ///< columns of that journal for the values and quantities of this study
  bool stops_alike_ = false;                      ///< true if the runs that are stopped as hopeless are the same
  std::size_t outcome_ = 0, message_ = 0, simulated_ = 0, verdict_ = 0;
};

/// An executor that first searches the answers, and simulates points with equal values only once: each repetition gets a copy
/// of the first row. The rows do not depend on the choice of the simulated run. The number of rows found in answers is added to
/// `taken`, unless it is null.
Executor remembering(Executor executor, std::vector<Answers>& answers, std::uint64_t* taken = nullptr);

}  // namespace gaitlab::studies
