#include "report/page_overlay.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace gaitlab::report {

PageData overlaid(const PageData& a, const PageData& b, const PageOverlay& overlay) {
  using Json = nlohmann::ordered_json;
  Json strays = Json::array();
  for (const Stray& stray : overlay.strays) {
    strays.push_back({{"signal", stray.signal},
                      {"unit", stray.unit},
                      {"ratio", stray.ratio},
                      {"tolerance", stray.tolerance},
                      {"from", stray.from ? Json(*stray.from) : Json()}});
  }
  Json meta = Json::parse(a.meta);
  meta["overlay"] = {{"labels", overlay.labels},
                     {"differs", overlay.differs},
                     {"strayed", overlay.strayed.empty() ? Json() : Json(overlay.strayed)},
                     {"strays", std::move(strays)},
                     {"run", Json::parse(b.meta)}};
  return {a.name == b.name ? a.name : a.name + ", " + b.name, json_text(meta), a.data + "\n" + b.data};
}

}  // namespace gaitlab::report
