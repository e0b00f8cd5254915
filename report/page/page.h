// report.html: a run as one self-contained file for a browser.
#pragma once
#include <string>
#include <string_view>

#include "report/page/page_data.h"

namespace gaitlab::report {

/// The page without a run, made by report/page: it contains each of the marks /*TITLE*/, /*META*/ and /*DATA*/ once
/// (cmake/page.cmake ensures that).
std::string_view page_template();

/// The page of a run.
std::string page(const PageData& data);

}  // namespace gaitlab::report
