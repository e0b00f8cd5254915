#include "report/verdict/check_manual.h"

#include <fmt/format.h>

#include "core/settings/wording.h"
#include "core/simulation/step_error.h"
#include "report/verdict/evidence.h"
#include "report/verdict/numbers/number_texts.h"
#include "report/verdict/trust.h"

namespace gaitlab::report {

namespace {

constexpr const char* kAbout =
    "The verdict answers one question: can the actual robot do this gait? Every known limit is a check: a number of the run "
    "compared with a limit. A limit that is not stated is not judged, and never assumed to be kept.";

constexpr std::size_t kTerminal = 80, kPage = 120;  // columns

struct Meaning {
  Word word;
  std::string meaning;
};

std::vector<Meaning> meanings() {
  return {
      {Word::feasible,
       "No check fails, and none is too close to its limit. At least one limit of the motors was judged, and for a "
       "floating base on a ground also fall and in_ground. The run is evidence: long enough, borne by the ground, and "
       "accurate. With contact.law bullet, whose solver keeps bodies apart, fall and in_ground may be missing, and unknown "
       "evidence (torque error, the ground's share of the weight) is named beside the verdict."},
      {Word::infeasible,
       fmt::format("A check fails, in a run that is accurate and shows the gait. In a run that is too short, or whose gait "
                   "is not at full size, only a check of the whole run counts (fall, upright, stops, collision, in_ground, "
                   "brownout, gear_peak, docks, a rated speed), because more time cannot undo it. With a torque error above "
                   "limits.torque_error (at most {}) and up to {}, only voltage, current, stall, heat, gears and docks "
                   "count, and only if one fails even with its value reduced by the torque error of its joint. If friction or "
                   "inertia of "
                   "servos is chosen, `run` simulates once more without it; if that run is feasible, the sentence ends `with "
                   "the friction chosen; feasible without`.",
                   texts::percent(Limits::kMostTorqueError), texts::percent(kMostError))},
      {Word::not_judged,
       "Anything else. The sentence names all missing evidence, its settings where they are known, and the failing check "
       "so far; if a number is impossible, it names only this number. If all settings are known, a line `judge by` has the "
       "command with them. If only the accuracy is missing, or a value is too close to its limit, `run` simulates once "
       "more, more accurately, if that takes less than 10 s by its estimate (not with --no-retry)."},
      {Word::failed, "The run ended early."}};
}

std::string about_evidence() {
  return fmt::format(
      "Evidence. Long enough, from the start of the gait on (the end of a ramp, the last change of `at`, the landing): two "
      "periods, if the motion repeats within {settled}, of which one is judged; otherwise three periods of the set points; if "
      "the set points do not repeat, {time:g} s. At full size: a ramp or rate of the cpg ends within the run; for other cpgs "
      "the range of a set point grows by at most {growth} in three periods after the run, which the cpg computes without the "
      "robot; mean and RMS of a set point in the first and the last period of the window differ by at most {drift} of its "
      "range; some set point changes by more than {moves} of its range. Borne, for a floating base: the ground carries at "
      "least half of the weight on average. Accurate: torque error at most limits.torque_error (and {torque}, whatever that "
      "limit), at most {residual} of the energy unaccounted for, at most {coarse} of the time coarser than physics.accuracy, "
      "and no motor whose efficiency x Kt exceeds Ks. Possible: density, moments of inertia, stall torque and power are "
      "physically possible (docs/modules.md), or `accept` of the scenario names the row; else the run is not judged, whatever "
      "its checks say. Predictable: if gravity times {disturbed} changes the torques, all of four equally valid rollouts must "
      "pass a check, or all must fail it; otherwise its value is too close to its limit. Limits that the scenario changes, and "
      "numbers that it accepts, are beside the verdict, or under `rests on`.",
      fmt::arg("settled", texts::percent(kSettled)), fmt::arg("time", kLeastTime),
      fmt::arg("growth", texts::percent(Gait::kMostGrowth)), fmt::arg("drift", texts::percent(Gait::kMostDrift)),
      fmt::arg("moves", texts::percent(kMoves)), fmt::arg("torque", texts::percent(Limits::kMostTorqueError)),
      fmt::arg("residual", texts::percent(kTrustedResidual)), fmt::arg("coarse", texts::percent(kTrustedCoarse)),
      fmt::arg("disturbed", disturbed(StepError::kChaotic)));
}

constexpr const char* kAboutMargins =
    "Margin of a check: (limit - value) / limit, for the limit at which the check fails. A lower limit reverses the sign, a "
    "limit of 0 does not divide, and of several limits the least margin counts. Below 0 the check fails, or is too close to "
    "its limit. The worst joint, body, dock or foot has the least margin. A value is too close to its limit if its error bar "
    "contains the limit, unless another part exceeds its limit by more than its own error. Voltage, current, stall, heat, "
    "gears and docks have an error bar, from the estimated error of the torques.";

/// Paragraph with a head. Its further lines are indented by the width of the head.
std::string hanging(const std::string& head, const std::string& text, std::size_t width) {
  return head + wrapped(text, head.size(), width).substr(head.size());
}

const char* of(CheckSpan span) { return span == CheckSpan::window ? "the judged window" : "the whole run"; }

}  // namespace

std::string explain_verdict() {
  std::string text = wrapped(kAbout) + "\n";
  for (const Meaning& one : meanings()) text += hanging(fmt::format("  {:<11} ", name_of(one.word)), one.meaning, kTerminal);
  text += "\n" + wrapped(about_evidence()) + "\n" + wrapped(kAboutMargins) + "\nchecks (gaitlab explain CHECK)\n";
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
  line("warns", kind.warns.empty() ? "never" : kind.warns);
  line("setting", kind.key);
  line("remedy", kind.remedy);
  return text;
}

std::string verdict_page() {
  std::string text = fmt::format(
      "# Verdict\n\n<!-- Written by `tests/gates/reference.sh build/release --renew`; CI fails where it is stale. -->\n\n{}\n",
      wrapped(kAbout, 0, kPage));
  for (const Meaning& one : meanings()) text += hanging("- ", fmt::format("`{}`: {}", name_of(one.word), one.meaning), kPage);
  text += fmt::format("\n{}\n{}\n", wrapped(about_evidence(), 0, kPage), wrapped(kAboutMargins, 0, kPage));
  text += "| check | group | value | over | fails | warns | setting | remedy |\n|---|---|---|---|---|---|---|---|\n";
  for (const CheckKind& kind : check_kinds()) {
    text +=
        fmt::format("| `{}` | {} | {}{} | {} | {} | {} | `{}` | {} |\n", kind.id, name_of(kind.group), kind.definition,
                    *kind.unit == '\0' ? "" : fmt::format(", {}", kind.unit), of(kind.span),
                    kind.can_fail() ? kind.fails : "never", kind.warns.empty() ? "never" : kind.warns, kind.key, kind.remedy);
  }
  return text;
}

}  // namespace gaitlab::report
