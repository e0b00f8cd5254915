// report.html: a run as one file that a browser opens, with nothing beside it.
#pragma once
#include <string>
#include <string_view>

#include "report/page/page_data.h"

namespace gaitlab::report {

/// The page without a run, made by report/page: each of the marks /*TITLE*/, /*META*/ and /*DATA*/ stands in it once
/// (cmake/page.cmake sees to that).
std::string_view page_template();

/// The page of a run.
std::string page(const PageData& data);

}  // namespace gaitlab::report
