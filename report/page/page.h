// report.html, which shows a run as one self-contained file for a browser.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "report/page/page_data.h"

namespace gaitlab::report {

/// Page without data, built from the TypeScript in report/page. It contains each of the marks /*TITLE*/, /*META*/ and /*DATA*/
/// once (cmake/page.cmake ensures that).
std::string_view page_template();

/// HTML text of the page of a run.
std::string page(const PageData& data);

/// A page of `gaitlab watch`: the page of the run with this number, 1 or more, which looks for a newer run in its folder every
/// half second, and may load pictures from there for this purpose (report/page/src/watch.ts).
std::string watched_page(std::string page, int run);
/// The picture stamp.svg beside a watched page: its width is the number of the newest run, and its height is 2 if the scenario
/// has an error since, otherwise 1.
std::string stamp(int run, bool error);
/// The picture error.svg beside a watched page: a message in lines of at most 110 characters, at most 20 of them.
std::string picture_of(std::string_view message);
/// Number of the run in a text of stamp(); nothing for other texts.
std::optional<int> stamped(std::string_view text);

}  // namespace gaitlab::report
