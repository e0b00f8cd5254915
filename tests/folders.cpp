#include "tests/folders.h"

namespace gaitlab::test {

const char* source_folder() { return GAITLAB_SOURCE_DIR; }
const char* build_folder() { return GAITLAB_BINARY_DIR; }

}  // namespace gaitlab::test
