// Reader of a study file STUDY.yaml, and the documentation of its keys.
#pragma once
#include <span>
#include <string>

#include "studies/study/guards.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// True if the file is a study, which has a key `gaitlab_study`. Throws InputError if the file cannot be read as YAML.
bool is_study(const std::string& file);

/// Command for which a study is read, which selects the method if the study names none: a grid or random points for `sweep`, a
/// search for `optimize`. For `evaluate` another program chooses the points; method and budget are then ignored.
enum class Purpose { sweep, optimize, evaluate };

/// Reads a study as strictly as a scenario. Throws InputError with every problem at FILE:LINE:COL. Parts that depend on the
/// scenario, such as keys of parameters and quantities, are checked by Plan.
Study read_study(const std::string& file, Purpose purpose = Purpose::sweep);

/// Text of `gaitlab explain study`.
std::string explain_study();
std::string study_page();
/// JSON Schema (draft 7) of `gaitlab schema --study`. The reader refuses everything that the schema refuses, and has further
/// checks.
std::string study_schema(std::span<const CheckOffer> checks);

/// Adds a problem for each pair of settings that contradict one another, except the number of runs.
void check_study(const Study& study, Problems& problems);

/// If the number of runs is impossible, adds a problem and takes the least possible number instead, so that the other checks
/// continue and all problems are printed together.
void check_budget(Study& study, Problems& problems);

}  // namespace gaitlab::studies
