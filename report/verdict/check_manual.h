// The manual of the verdict: its words, and every check with its limit and remedy.
#pragma once
#include <string>

#include "report/verdict/verdict.h"

namespace gaitlab::report {

/// What `gaitlab explain verdict` prints: the words, then a line per check.
std::string explain_verdict();
/// What `gaitlab explain CHECK` prints.
std::string explain_check(const CheckKind& kind);
/// docs/reference/verdict.md.
std::string verdict_page();

}  // namespace gaitlab::report
