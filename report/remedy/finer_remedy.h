// Remedy of a run that is `not judged` only for its accuracy.
#pragma once
#include <atomic>

#include "core/errors.h"
#include "report/remedy/remedy.h"

namespace gaitlab::report {

/// Remedy of the run with the settings Verdict::retry, which make it accurate enough for a verdict. Throws no_verdict() if that
/// run is also without a verdict, and the exceptions of remedy().
Remedy remedy_of_finer_run(const RemedyTask& task, std::atomic<bool>& stop);

/// Error for a run without a verdict.
InputError no_verdict(const RemedyTask& task);

}  // namespace gaitlab::report
