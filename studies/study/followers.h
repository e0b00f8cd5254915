// Keys of the scenario that are computed from free parameters of a study.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "studies/study/formula.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// Settings that the parameters of a study define. A parameter that is a key of the scenario sets that key. A free parameter
/// sets each of its followers by an expression over all parameters.
class Followers {
 public:
  /// Adds the faults of expressions to the problems at their places. After a fault, this object must not be used.
  Followers(const std::vector<Parameter>& parameters, Problems& problems);

  /// Key and value of each setting of a point, computed from the values of its parameters.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> settings(const std::vector<std::string>& values) const;

 private:
  struct One {
    std::string key;
    std::vector<std::pair<std::string, Formula>> sets = {};  ///< empty if `key` is a key of the scenario
  };
  std::vector<One> all_;
};

/// Lines of a definition for the keys that follow a parameter, as in `legs sets cpg.offset: 0.3*legs - 0.1`.
std::string followers_text(const Parameter& parameter);
/// Sets the followers of a journal's parameters from the text of its definition.
void read_followers(std::vector<Parameter>& parameters, const std::string& definition);

}  // namespace gaitlab::studies
