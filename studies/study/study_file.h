// Study file STUDY.yaml, and its manual.
#pragma once
#include <span>
#include <string>

#include "studies/study/guards.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// Whether the file is a study: it has a key `gaitlab_study`. Throws InputError if it cannot be read as YAML.
bool is_study(const std::string& file);

/// Command for which a study is read: without a method it is a grid or drawn at random, or a search. For `evaluate` the points
/// come from another program; method and budget do not count.
enum class Purpose { sweep, optimize, evaluate };

/// Reads a study as strictly as a scenario. Throws InputError with every problem at FILE:LINE:COL; Plan checks the parts that
/// need the scenario (keys of parameters, quantities).
Study read_study(const std::string& file, Purpose purpose = Purpose::sweep);

/// Text of `gaitlab explain study` and docs/reference/study.md.
std::string explain_study();
std::string study_page();
/// JSON Schema (draft 7) of `gaitlab schema --study`. The reader refuses everything that it refuses, and checks more.
std::string study_schema(std::span<const CheckOffer> checks);

/// Adds a problem for settings that contradict one another.
void check_study(const Study& study, const SourceLocation& place, Problems& problems);

}  // namespace gaitlab::studies
