// The first screen of a run on a terminal: the verdict, its failures and warnings, and the gait, in few lines.
#pragma once
#include <string>
#include <vector>

#include "report/verdict/numbers.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

enum class Tone { plain, good, doubtful, bad };

struct ScreenLine {
  std::string title;  ///< "": continues the previous line
  std::string text;
  Tone tone = Tone::plain;
};

/// Lines of at most 100 columns: the word and its reason, the tightest limit; a line per check that fails, is too close or
/// warns (if there are more than `most` of a kind, the rest by name); the checks that were not judged, by name; the gait; the
/// source of the limits.
std::vector<ScreenLine> first_screen(const RunData& run, const Verdict& verdict, std::size_t most);

/// `dock bending of m5, margin 6 %`; empty: no margin is known.
std::string tightest_text(const Verdict& verdict);

}  // namespace gaitlab::report
