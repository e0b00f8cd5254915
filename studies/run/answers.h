// Runs that are known already need not be done: those of other studies, and points that are asked for twice.
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

/// The rows of another study's journal that answer runs of this one: of the same point, replicate, seed and draws. Scores are
/// computed again, so that objective, constraints and guards may be others.
class Answers {
 public:
  /// `journal`: study.db, or the folder that holds it. The plan must outlive it. InputError: it is not a journal; it lacks a
  /// quantity that this study needs; its rules for stopping are others; another build wrote it than `build`, unless `any` is
  /// taken.
  Answers(const Plan& plan, std::filesystem::path journal, const std::string& build, Journal::Build taken);

  /// The row of a run, of which Plan::row is known; nothing: it is not there. One thread at a time.
  [[nodiscard]] std::optional<Row> find(const Row& wanted);

 private:
  [[nodiscard]] bool same_values(const Row& wanted, const std::vector<std::string>& there) const;

  const Plan& plan_;
  std::unique_ptr<Journal> journal_;
  std::map<std::string, std::uint64_t> runs_;     ///< by point, replicate, seed and scenario
  std::vector<std::size_t> values_, quantities_;  ///< columns there of this study's
  std::size_t outcome_ = 0, message_ = 0, simulated_ = 0, verdict_ = 0;
};

/// An executor that asks the answers first, and does points with the same values once: those that come again get the row of the
/// first. Which is done and which is copied makes no difference to any row. `taken`: how many rows were answered, may be null.
Executor remembering(Executor executor, std::vector<Answers>& answers, std::uint64_t* taken = nullptr);

}  // namespace gaitlab::studies
