// Keys of the scenario that follow numbers of a study's own.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "studies/study/formula.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// What the parameters of a study set: a key of the scenario its value; a number of the study's own nothing but the keys that
/// follow it, each by an expression over all parameters.
class Followers {
 public:
  /// Faults of expressions are problems at their places; then it is not to be used.
  Followers(const std::vector<Parameter>& parameters, Problems& problems);

  /// Key and value of each setting of a point, of the values of its parameters.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> settings(const std::vector<std::string>& values) const;

 private:
  struct One {
    std::string key;
    std::vector<std::pair<std::string, Formula>> sets = {};  ///< none: the key is the scenario's
  };
  std::vector<One> all_;
};

/// What a definition says of the keys that follow a parameter, a line each: `legs sets cpg.offset: 0.3*legs - 0.1`.
std::string followers_text(const Parameter& parameter);
/// Of parameters of a journal, what follows them, as its definition says.
void read_followers(std::vector<Parameter>& parameters, const std::string& definition);

}  // namespace gaitlab::studies
