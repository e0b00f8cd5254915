// report.html, which shows a run as one self-contained file for a browser.
#pragma once
#include <string>
#include <string_view>

#include "report/page/page_data.h"

namespace gaitlab::report {

/// Page without data, built from the TypeScript in report/page. It contains each of the marks /*TITLE*/, /*META*/ and /*DATA*/
/// once (cmake/page.cmake ensures that).
std::string_view page_template();

/// HTML text of the page of a run.
std::string page(const PageData& data);

}  // namespace gaitlab::report
