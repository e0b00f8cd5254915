#include "report/page/page_overlay.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "report/page/packing.h"

namespace gaitlab::report {

PageData overlaid(const PageData& a, const PageData& b, const PageOverlay& overlay) {
  using Json = nlohmann::ordered_json;
  Json strays = Json::array();
  Packing differences;
  for (const Stray& stray : overlay.strays) {
    double largest = 0;
    for (const double d : stray.difference) largest = std::isfinite(d) ? std::max(largest, std::abs(d)) : largest;
    // The quantum is limited, so that the tolerance remains visible beside a large deviation.
    differences.add(stray.signal, stray.unit, quantum_of(std::min(largest, 20 * stray.tolerance), 1), stray.difference);
    strays.push_back({{"signal", stray.signal},
                      {"unit", stray.unit},
                      {"ratio", stray.ratio},
                      {"tolerance", stray.tolerance},
                      {"from", stray.from ? Json(*stray.from) : Json()}});
  }
  Json meta = Json::parse(a.meta);
  meta["overlay"] = {{"labels", overlay.labels},    {"folders", overlay.folders},
                     {"differs", overlay.differs},  {"strayed", overlay.strayed.empty() ? Json() : Json(overlay.strayed)},
                     {"strays", std::move(strays)}, {"differences", channels_json(differences)},
                     {"run", Json::parse(b.meta)}};
  return {a.name == b.name ? a.name : a.name + ", " + b.name, json_text(meta),
          a.data + "\n" + b.data + (overlay.strays.empty() ? "" : "\n" + differences.text())};
}

}  // namespace gaitlab::report
