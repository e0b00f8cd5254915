// Folders of the sources and of the build. Their paths are compiled in one file, so that clones in other folders share compiled
// tests.
#pragma once

namespace gaitlab::test {

/// The root of the project.
const char* source_folder();
/// The folder of the build, with bin/gaitlab and plugins/.
const char* build_folder();

}  // namespace gaitlab::test
