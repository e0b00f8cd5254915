// Outcome of a run: its end, with the reason.
#pragma once
#include <string>

#include "core/names.h"

namespace gaitlab {

/// End of a run. `plugin` means that a plugin threw an exception, `stopped` that a rule of a study ended the run, `not_run`
/// that the robot was only checked. `early` is an early end of which only the text is known.
enum class Ended { done, diverged, plugin, stopped, interrupted, not_run, early };

template <>
struct EnumNames<Ended> {
  using enum Ended;
  static constexpr EnumName<Ended> kTable[] = {{done, "done"},       {diverged, "diverged"},       {plugin, "plugin"},
                                               {stopped, "stopped"}, {interrupted, "interrupted"}, {not_run, "not run"},
                                               {early, "early"}};
};

struct Outcome {
  Ended ended = Ended::done;
  std::string message = {};  ///< reason of an early end, with step and time

  [[nodiscard]] bool done() const { return ended == Ended::done; }
  /// Text `done`, `not run` or the message, as printed in trace, summary and page.
  [[nodiscard]] std::string text() const { return message.empty() ? name_of(ended) : message; }
  /// Outcome with the text `text`; Ended::early for every text but `done`.
  [[nodiscard]] static Outcome of(const std::string& text) {
    const bool done = text == name_of(Ended::done);
    return done ? Outcome() : Outcome{Ended::early, text};
  }
};

}  // namespace gaitlab
