// Keys of the scenario that are computed from free parameters of a study.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "studies/study/formula.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// Settings made by the parameters of a study: a parameter that is a key of the scenario sets it; a free parameter sets the
/// keys that follow it, each by an expression over all parameters.
class Followers {
 public:
  /// Faults of expressions are added to the problems at their places; then this object must not be used.
  Followers(const std::vector<Parameter>& parameters, Problems& problems);

  /// Key and value of each setting of a point, from the values of its parameters.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> settings(const std::vector<std::string>& values) const;

 private:
  struct One {
    std::string key;
    std::vector<std::pair<std::string, Formula>> sets = {};  ///< empty: the key is the scenario's
  };
  std::vector<One> all_;
};

/// Lines of a definition for the keys that follow a parameter: `legs sets cpg.offset: 0.3*legs - 0.1`.
std::string followers_text(const Parameter& parameter);
/// Sets the followers of a journal's parameters from its definition.
void read_followers(std::vector<Parameter>& parameters, const std::string& definition);

}  // namespace gaitlab::studies
