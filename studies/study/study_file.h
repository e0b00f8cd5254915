// STUDY.yaml, and its manual.
#pragma once
#include <span>
#include <string>

#include "studies/study/guards.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// Whether the file is a study: it has a key `gaitlab_study`. InputError: it cannot be read as YAML.
bool is_study(const std::string& file);

/// What a study is read for: a file that names no method is a grid or drawn at random, or a search. Of `evaluate` the points
/// come from another program; method and budget do not count.
enum class Purpose { sweep, optimize, evaluate };

/// Reads it as strictly as a scenario. InputError with every problem at FILE:LINE:COL; what needs the scenario (keys of
/// parameters, quantities) is checked by Plan.
Study read_study(const std::string& file, Purpose purpose = Purpose::sweep);

/// `gaitlab explain study` and docs/reference/study.md.
std::string explain_study();
std::string study_page();
/// `gaitlab schema --study`: JSON Schema (draft 7). What it refuses, the reader refuses; the reader knows more.
std::string study_schema(std::span<const CheckOffer> checks);

/// Finds what a study's settings among themselves rule out.
void check_study(const Study& study, const SourceLocation& place, Problems& problems);

}  // namespace gaitlab::studies
