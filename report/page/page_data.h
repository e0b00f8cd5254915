// What a page knows of a run: names, robot, verdict and settings as JSON, and the signals of the run, packed.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "report/page/packing.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

/// Beyond so many characters of `data` every second row is left out, then every second of these ...
inline constexpr std::size_t kMostData = std::size_t{4} << 20;

struct PageData {
  std::string name;
  std::string meta;  ///< JSON without any `<`: it ends no script, and begins no comment
  std::string data;  ///< Packing::text()
};

/// docs/report.md has the members. No number is of the clock, and no folder is named: plugins by the names of their files.
/// missing: what the folder of the run does not hold, a sentence each. The same run gives the same bytes.
PageData page_data(const Scenario& scenario, const Recording& record, const Summary& summary, const Verdict& verdict,
                   std::vector<std::string> missing = {}, std::size_t most = kMostData);

/// What a page needs to unpack it.
nlohmann::ordered_json channels_json(const Packing& packing);

/// JSON that may stand in a script of a page: without any `<`.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace gaitlab::report
