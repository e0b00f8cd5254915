// Manual of the verdict: its four words, and every check with its limit and remedy.
#pragma once
#include <string>

#include "report/verdict/verdict.h"

namespace gaitlab::report {

/// Text of `gaitlab explain verdict`: the four words, then one line per check.
std::string explain_verdict();
/// Text of `gaitlab explain CHECK`.
std::string explain_check(const CheckKind& kind);
/// Text of docs/reference/verdict.md.
std::string verdict_page();

}  // namespace gaitlab::report
