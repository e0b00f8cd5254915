// Results without a run: rows of other studies, and points that are requested twice.
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

/// Rows of another study's journal that answer runs of this one: same point, replicate, seed and draws. Scores are computed
/// again, so that objective, constraints and guards may differ.
class Answers {
 public:
  /// `journal`: study.db, or its folder. The plan must outlive this object. Throws InputError if it is not a journal, lacks a
  /// quantity that this study needs, has other rules for stopping, or was written by another build than `build`, unless `any`
  /// is given.
  Answers(const Plan& plan, std::filesystem::path journal, const std::string& build, Journal::Build taken);

  /// The row of a run with the known values of Plan::row; nothing: not found. One thread at a time.
  [[nodiscard]] std::optional<Row> find(const Row& wanted);

 private:
  [[nodiscard]] bool same_values(const Row& wanted, const std::vector<std::string>& there) const;

  const Plan& plan_;
  std::unique_ptr<Journal> journal_;
  std::map<std::string, std::uint64_t> runs_;     ///< by point, replicate, seed and scenario
  std::vector<std::size_t> values_, quantities_;  ///< columns in that journal of this study's columns
  std::size_t outcome_ = 0, message_ = 0, simulated_ = 0, verdict_ = 0;
};

/// An executor that searches the answers first, and runs points with the same values once: repeated ones get the row of the
/// first. The rows do not depend on which one is run. `taken`: receives the number of answered rows; may be null.
Executor remembering(Executor executor, std::vector<Answers>& answers, std::uint64_t* taken = nullptr);

}  // namespace gaitlab::studies
