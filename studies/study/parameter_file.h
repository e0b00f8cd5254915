// Reader of parameters, replicates and start points in a study file or on the command line.
#pragma once
#include <string>

#include "core/settings/node.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// Reads the keys `parameters` and `replicates` of a study. Every fault is a problem at its place.
void read_parameters(const Node& node, Study& study, Problems& problems);
void read_replicates(const Node& node, Replicates& replicates, Problems& problems);

/// Reads `start`: points given by values of the study's parameters, which must have been read before.
void read_starts(const Node& node, Study& study, Problems& problems);

/// Reads the value of an option: `--random` (KEY=A:B, KEY=log:A:B or KEY=v,v,v) if `drawn`, otherwise `--grid` (KEY=A:B:N,
/// KEY=log:A:B:N or KEY=v,v,v).
Parameter read_parameter(const std::string& option, const std::string& text, bool drawn, Problems& problems);

}  // namespace gaitlab::studies
