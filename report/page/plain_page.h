// A page without scripts: head and style around a body.
#pragma once
#include <string>

namespace gaitlab::report {

/// HTML text of a page in one file that asks for nothing else. `style` is CSS behind that of all such pages, which has the
/// colours of the light and the dark theme; `body` is HTML.
std::string plain_page(const std::string& title, const std::string& style, const std::string& body);

}  // namespace gaitlab::report
