// The scenario's own values of a study's parameters.
#pragma once
#include <string>
#include <vector>

#include "core/settings/node.h"
#include "studies/study/scenarios.h"

namespace gaitlab::studies {

struct OwnValue {
  std::string text;     ///< value in the form of --set; empty if it is not known
  std::string missing;  ///< reason why it is not known or cannot be used: `is not a number of the scenario`
};

/// Node of a key of the scenario; null if there is none. A name in `joints` selects the joint's entry in a list per joint. A
/// single number for all joints is also the number of each joint.
const Node* find_key(const Node& root, const std::string& key, const std::vector<std::string>& joints);

/// The own value of each parameter, from the resolved scenario. A key of one joint or of one entry of a list has the value of
/// that entry. A default of joints (`cpg.amplitude.default`) has the value in the scenario's file. Free parameters have no own
/// value. A value beyond the parameter's range, or not among its listed values, is reported as missing.
std::vector<OwnValue> own_values(const Study& study, const StudyScenario& scenario);

}  // namespace gaitlab::studies
