#include "report/figures/run/run_sheet.h"

namespace gaitlab::report {

void draw_run_title(Canvas& canvas, const std::string& title) {
  const double size = fitting_size(title, 18, 10, kWidth - 80);
  canvas.text({kWidth / 2, 28}, title, {.size = size, .anchor = Anchor::middle, .bold = true});
}

}  // namespace gaitlab::report
