// The only header that a plugin outside this source tree includes, with the interfaces and the macro GAITLAB_PLUGIN.
// A plugin library contains, for example, GAITLAB_PLUGIN(registry) { add_cpg<Mine>(registry, ...); }
#pragma once
#include "core/plugin/registry.h"

#define GAITLAB_ABI_TEXT2(x) #x
#define GAITLAB_ABI_TEXT(x) GAITLAB_ABI_TEXT2(x)
#if defined(__clang__)
#define GAITLAB_ABI_COMPILER "clang " GAITLAB_ABI_TEXT(__clang_major__)
#else
#define GAITLAB_ABI_COMPILER "g++ " GAITLAB_ABI_TEXT(__GNUC__)
#endif
#if defined(_LIBCPP_VERSION)
#define GAITLAB_ABI_LIBRARY "libc++ " GAITLAB_ABI_TEXT(_LIBCPP_VERSION)
#else
#define GAITLAB_ABI_LIBRARY "libstdc++ " GAITLAB_ABI_TEXT(_GLIBCXX_RELEASE) " cxx11 " GAITLAB_ABI_TEXT(_GLIBCXX_USE_CXX11_ABI)
#endif
/// Number of the interface, compiler, and standard library. A plugin is loaded only if all three equal those of the program.
#define GAITLAB_ABI "gaitlab-19, " GAITLAB_ABI_COMPILER ", " GAITLAB_ABI_LIBRARY

// NOLINTBEGIN(bugprone-macro-parentheses): a parameter's name cannot be in parentheses
#define GAITLAB_PLUGIN(registry)                               \
  extern "C" const char* gaitlab_abi() { return GAITLAB_ABI; } \
  extern "C" void gaitlab_register(gaitlab::Registry& registry)
// NOLINTEND(bugprone-macro-parentheses)
