// Stand-in for mjcf_model.cpp in a build without the headers of MuJoCo.
#include "core/errors.h"
#include "interchange/mjcf_model.h"

namespace gaitlab::interchange {

CompiledMjcf compile_mjcf(const std::string& /*text*/, const std::string& file) {
  throw InputError(
      SourceLocation{file},
      "is MJCF, which this build does not read; install libmujoco-dev 2.2.2 and build again, or convert it to URDF");
}

}  // namespace gaitlab::interchange
