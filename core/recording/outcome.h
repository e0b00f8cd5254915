// The way in which a run ended.
#pragma once
#include <string>

#include "core/names.h"

namespace gaitlab {

/// plugin: one threw; stopped: by a rule of a study; not_run: a robot that was only checked; early: its folder, which is of an
/// older format, does not say how.
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
  std::string message = {};  ///< why it ended early, with step and time

  [[nodiscard]] bool done() const { return ended == Ended::done; }
  /// `done`, `not run` or the message: what trace, summary and page hold.
  [[nodiscard]] std::string text() const { return message.empty() ? name_of(ended) : message; }
  /// The outcome with that text: Ended::early of a message.
  [[nodiscard]] static Outcome of(const std::string& text) {
    const bool done = text == name_of(Ended::done);
    return done ? Outcome() : Outcome{Ended::early, text};
  }
};

}  // namespace gaitlab
