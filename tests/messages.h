// The message of an error, for tests that pin it.
#pragma once
#include <string>

#include "core/errors.h"

namespace gaitlab::test {

inline constexpr const char* kNoError = "no error";

/// Text of the Error that `act` throws, or kNoError. Other exceptions end the test.
template <class Error = InputError, class Act>
std::string message_of(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return kNoError;
}

}  // namespace gaitlab::test
