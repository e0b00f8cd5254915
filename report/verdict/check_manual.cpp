#include "report/verdict/check_manual.h"

#include <fmt/format.h>

#include "core/settings/wording.h"

namespace gaitlab::report {

namespace {

constexpr const char* kAbout =
    "The verdict answers one question: can the actual robot do this gait? Every known limit is a check: a number of the run "
    "compared with a limit. A limit that is not stated is not judged, and never assumed to be kept.";

constexpr std::size_t kTerminal = 80, kPage = 120;  // columns

struct Meaning {
  Word word;
  const char* meaning;
};
constexpr Meaning kWords[] = {
    {Word::feasible,
     "No check fails, and none is too close to its limit. At least one limit of the motors was judged, and for a floating base "
     "on a ground also fall and in_ground. The run is evidence: long enough, borne by the ground, and accurate."},
    {Word::infeasible,
     "A check fails, in a run that is accurate. In one that is too short only a check of the whole run counts (docks, gears, "
     "collision, stops, fall ...), because more time cannot undo it. With a torque error above limits.torque_error, at most 50 "
     "%, only a check of motors, gears or docks counts that fails even with its value reduced by that error."},
    {Word::not_judged,
     "Anything else. The sentence names all missing evidence, the settings that give it, and the failing check so far; a line "
     "`judge by` has the command with these settings. `run` simulates again by itself if only the accuracy is missing and the "
     "run takes less than 10 s (not with --no-retry)."},
    {Word::failed, "The run ended early."},
};

constexpr const char* kEvidence =
    "Evidence. Long enough: a whole period of a limit cycle that repeats within 1 %; else three periods of the set "
    "points after the start of the gait; where set points do not repeat, 2 s. At full size: a ramp or rate of the cpg ends "
    "within the run; the range of a set point grows by at most 2 % in three periods after the run, in which the cpg goes on "
    "alone; its mean and RMS in the first and the last period of the window differ by at most 1 % of the range; a set point "
    "changes. Borne, for a floating base: the ground carries at least half of the weight on average. Accurate: torque error at "
    "most limits.torque_error (and 10 %, whatever that limit), at most 5 % of the energy unaccounted for, at most 10 % of the "
    "time coarser than physics.accuracy, and no motor whose efficiency x Kt exceeds Ks. Possible: no mass, moment of inertia, "
    "stall torque or power that no robot has (docs/modules.md), unless `accept` of the scenario names it; this precedes all "
    "checks. Limits that the scenario changes, and numbers that it accepts, are beside the word.";

constexpr const char* kMargin =
    "Margin of a check: (limit - value) / limit, where limit is the one at which the check fails; with the opposite sign for a "
    "lower limit; the least margin if there are several limits; not divided for a limit of 0. Below 0 the check fails. The "
    "worst joint, body, dock or "
    "foot has the least margin. A value is too close to its limit if its error bar, from the estimated error of the torques, "
    "contains the limit, unless another part exceeds its limit by more than its own error.";

/// Paragraph with a head. Its further lines are indented by the width of the head.
std::string hanging(const std::string& head, const std::string& text, std::size_t width) {
  return head + wrapped(text, head.size(), width).substr(head.size());
}

const char* of(CheckSpan span) { return span == CheckSpan::window ? "the judged window" : "the whole run"; }

}  // namespace

std::string explain_verdict() {
  std::string text = wrapped(kAbout) + "\n";
  for (const Meaning& one : kWords) text += hanging(fmt::format("  {:<11} ", name_of(one.word)), one.meaning, kTerminal);
  text += "\n" + wrapped(kEvidence) + "\n" + wrapped(kMargin) + "\nchecks (gaitlab explain CHECK)\n";
  for (const CheckKind& kind : check_kinds()) text += fmt::format("  {:<16} {}\n", kind.id, kind.title);
  return text;
}

std::string explain_check(const CheckKind& kind) {
  std::string text = fmt::format("{}: {}\n", kind.id, kind.title);
  const auto line = [&](const char* title, const std::string& what) {
    if (!what.empty()) text += hanging(fmt::format("  {:<8} ", title), what, kTerminal);
  };
  line("value", fmt::format("{}{}", kind.definition, *kind.unit == '\0' ? "" : fmt::format(", {}", kind.unit)));
  line("over", of(kind.span));
  line("fails", kind.can_fail() ? kind.fails : "never");
  line("warns", *kind.warns == '\0' ? "never" : kind.warns);
  line("setting", kind.key);
  line("remedy", kind.remedy);
  return text;
}

std::string verdict_page() {
  std::string text = fmt::format(
      "# Verdict\n\n<!-- Written by `tests/gates/reference.sh build/release --renew`; CI fails where it is stale. -->\n\n{}\n",
      wrapped(kAbout, 0, kPage));
  for (const Meaning& one : kWords) text += hanging("- ", fmt::format("`{}`: {}", name_of(one.word), one.meaning), kPage);
  text += fmt::format("\n{}\n{}\n", wrapped(kEvidence, 0, kPage), wrapped(kMargin, 0, kPage));
  text += "| check | group | value | over | fails | warns | setting | remedy |\n|---|---|---|---|---|---|---|---|\n";
  for (const CheckKind& kind : check_kinds()) {
    text +=
        fmt::format("| `{}` | {} | {}{} | {} | {} | {} | `{}` | {} |\n", kind.id, name_of(kind.group), kind.definition,
                    *kind.unit == '\0' ? "" : fmt::format(", {}", kind.unit), of(kind.span),
                    kind.can_fail() ? kind.fails : "never", *kind.warns == '\0' ? "never" : kind.warns, kind.key, kind.remedy);
  }
  return text;
}

}  // namespace gaitlab::report
