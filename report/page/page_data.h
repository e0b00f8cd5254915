// Data of a run in its page: names, robot, verdict and settings as JSON, and the packed signals.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "report/page/packing.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

/// Largest length of PageData::data in characters. Above it every second row is left out, repeatedly.
inline constexpr std::size_t kMostData = std::size_t{4} << 20;

struct PageData {
  std::string name;
  std::string meta;  ///< JSON text without the character `<`, so that it cannot end a script or begin a comment
  std::string data;  ///< text from Packing::text()
};

/// Data of a run's page; docs/report.md describes its members. `missing` contains one sentence for each part that is missing in
/// the run's folder. The data contain no wall-clock times and no folders, so that the same run produces the same
/// bytes. Plugins have only their file names.
PageData page_data(const Scenario& scenario, const Recording& record, const Summary& summary, const Verdict& verdict,
                   std::vector<std::string> missing = {}, std::size_t most = kMostData);

/// JSON description of the packed channels, from which the page unpacks them.
nlohmann::ordered_json channels_json(const Packing& packing);

/// JSON text without the character `<`, for a script of a page.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace gaitlab::report
