// The first screen of a run on a terminal: the verdict, failed checks and warnings, and the gait, in few lines.
#pragma once
#include <string>
#include <vector>

#include "report/verdict/numbers/numbers.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

enum class Tone { plain, good, doubtful, bad };

}  // namespace gaitlab::report

template <>
struct gaitlab::EnumNames<gaitlab::report::Tone> {
  using enum gaitlab::report::Tone;
  static constexpr EnumName<gaitlab::report::Tone> kTable[] = {
      {plain, "plain"}, {good, "good"}, {doubtful, "doubtful"}, {bad, "bad"}};
};

namespace gaitlab::report {

inline constexpr std::size_t kColumns = 100;  ///< width of a summary that is not on a terminal

struct ScreenLine {
  std::string title;  ///< "" if the line continues the previous line
  std::string text;
  Tone tone = Tone::plain;
};

/// Lines of at most `columns` columns (40 or more) unless a word is longer, in this order: the word with its reason; the
/// tightest check; a line for each check that fails, is too close or warns; the ids of the checks that were not judged; the
/// gait; the sources of the limits. If more than `most` checks of one status exist, the further ones are listed by id.
std::vector<ScreenLine> first_screen(const RunData& run, const Verdict& verdict, std::size_t most,
                                     std::size_t columns = kColumns);

/// Text `dock bending of m5, margin 6 %` on the tightest check; empty if no margin is known.
std::string tightest_text(const Verdict& verdict);

}  // namespace gaitlab::report
