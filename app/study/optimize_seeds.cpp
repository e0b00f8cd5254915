#include "app/study/optimize_seeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <vector>

#include "app/app.h"
#include "app/shell/stop_on_signal.h"
#include "app/study/quantity_text.h"
#include "core/errors.h"
#include "core/settings/wording.h"
#include "studies/journal/study_folder.h"
#include "studies/search/world_trials.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;
constexpr std::string_view kSeedFolder = "seed-";

/// Best values of a search, by the first objective. NaN if no point is kept or verified.
struct SeedResult {
  std::uint64_t runs = 0, kept = 0;
  double best = std::nan(""), verified = std::nan("");
};

SeedResult result_of(studies::Journal& journal) {
  const studies::Results results = studies::results(journal);
  SeedResult found{results.runs, results.kept_runs};
  const std::vector<std::size_t> order = studies::ranked(results.points, journal.head().objectives.front().maximize);
  if (!order.empty() && results.points[order.front()].kept()) found.best = results.points[order.front()].score.objective();
  const std::vector<std::uint64_t> stood = studies::verified(journal.verifications());
  for (const studies::PointResult& point : results.points) {
    if (!stood.empty() && point.first_run == stood.front()) found.verified = point.score.objective();
  }
  return found;
}

std::string value_cell(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-"; }

void print_seeds(const SeedSearches& s) {
  std::vector<std::vector<std::string>> rows{{"seed", "runs", "kept", "best", "verified"}};
  std::vector<double> best;
  std::size_t verified = 0;
  std::string objective;
  for (std::int64_t seed = s.first; seed < s.first + s.count; ++seed) {
    studies::Journal journal(folder_of_seed(s.folder, seed) / studies::kJournalFile);
    const SeedResult found = result_of(journal);
    rows.push_back({std::to_string(seed), std::to_string(found.runs), std::to_string(found.kept), value_cell(found.best),
                    value_cell(found.verified)});
    if (std::isfinite(found.best)) best.push_back(found.best);
    verified += std::isfinite(found.verified) ? 1 : 0;
    objective = objective_text(journal.head());
  }
  fmt::print("\nfor each seed, the best kept point and the best verified point, by {}:\n{}", objective, aligned(rows, 2));
  fmt::print("{} of {} seeds verified a point", verified, s.count);
  if (!best.empty()) {
    fmt::print("; best of {}: median {:.4g}, from {:.4g} to {:.4g}", counted(best.size(), "seed"),
               studies::combined(best, "median", 0.5), std::ranges::min(best), std::ranges::max(best));
  }
  fmt::print("\n");
}

bool is_seed_folder(const fs::directory_entry& entry) {
  const std::string name = entry.path().filename().string();
  const std::string digits = name.substr(std::min(kSeedFolder.size(), name.size()));
  return name.starts_with(kSeedFolder) && !digits.empty() && digits.find_first_not_of("0123456789") == std::string::npos &&
         entry.is_directory();
}

}  // namespace

fs::path folder_of_seed(const fs::path& folder, std::int64_t seed) { return folder / fmt::format("{}{}", kSeedFolder, seed); }

fs::path seeds_folder(const std::optional<std::string>& out, const std::string& name, std::int64_t first,
                      const std::function<bool(const fs::path&)>& is_it) {
  if (!out)
    return studies::study_folder({}, name, [&](const fs::path& folder) { return is_it(folder_of_seed(folder, first)); });
  std::error_code none;
  std::vector<std::string> others;
  for (const fs::directory_entry& entry : fs::directory_iterator(*out, none)) {
    if (!is_seed_folder(entry)) others.push_back(entry.path().filename().string());
  }
  if (others.empty()) return *out;
  throw InputError(SourceLocation{"--out " + *out},
                   fmt::format("contains {}; expected a new folder, or one of `--seeds`, which contains only folders seed-N",
                               clipped(std::ranges::min(others))));
}

int search_seeds(const SeedSearches& s) {
  bool any = false, failed = false;
  for (std::int64_t seed = s.first; seed < s.first + s.count; ++seed) {
    if (!s.quiet) say(fmt::format("seed {}, {} of {}\n", seed, seed - s.first + 1, s.count));
    const int code = stopped() ? 1 : s.search(seed, folder_of_seed(s.folder, seed));
    if (stopped()) {
      say(fmt::format("{}: interrupted: {} of {} searches have ended; continue with\n{}\n", s.folder.string(), seed - s.first,
                      s.count, s.command));
      return 1;
    }
    any = any || code == 0;
    failed = failed || code == 1;
  }
  if (!s.quiet) print_seeds(s);
  return failed ? 1 : any ? 0 : 3;
}

}  // namespace gaitlab::app
