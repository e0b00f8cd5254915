#include "report/analysis/loads.h"

namespace gaitlab::report {

Trace loads_at_rows(const Recording& r) {
  const Trace& loads = r.loads;
  const Series time = r.series("t");
  Trace made;
  made.columns = loads.columns;
  if (loads.rows() == 0) return made;
  made.values.reserve(time.size() * loads.columns.size());
  std::size_t next = 0;  // the first tick at or after the row
  for (std::size_t row = 0; row < time.size(); ++row) {
    while (next + 1 < loads.rows() && loads.at(next, 0) < time[row]) ++next;
    const std::size_t before = next > 0 ? next - 1 : 0;
    const double from = loads.at(before, 0);
    const double to = loads.at(next, 0);
    const double share = time[row] < to && to > from ? (time[row] - from) / (to - from) : 1;
    made.values.push_back(time[row]);
    for (std::size_t c = 1; c < loads.columns.size(); ++c) {
      const double at = loads.at(next, c);
      made.values.push_back(share < 1 ? loads.at(before, c) + share * (at - loads.at(before, c)) : at);
    }
  }
  return made;
}

}  // namespace gaitlab::report
