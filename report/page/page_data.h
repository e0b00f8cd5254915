// Data of a run in its page: names, robot, verdict and settings as JSON, and the packed signals.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "report/page/packing.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

/// Characters of `data` above which every second row is left out, repeatedly.
inline constexpr std::size_t kMostData = std::size_t{4} << 20;

struct PageData {
  std::string name;
  std::string meta;  ///< JSON without any `<`, which cannot end a script or begin a comment
  std::string data;  ///< Packing::text()
};

/// Data of a run's page; docs/report.md describes the members. No number is of the clock, and folders are removed: plugins have
/// only their file names. missing: one sentence for each missing part of the run's folder. The same run gives the same bytes.
PageData page_data(const Scenario& scenario, const Recording& record, const Summary& summary, const Verdict& verdict,
                   std::vector<std::string> missing = {}, std::size_t most = kMostData);

/// Description of the packed channels for unpacking.
nlohmann::ordered_json channels_json(const Packing& packing);

/// JSON for a script of a page: without any `<`.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace gaitlab::report
