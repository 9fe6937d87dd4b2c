#pragma once

#include <string>

#include "io/input_error.h"

namespace test_support {

/// What the call says of its input where it refuses it; empty where it takes it.
template <typename Call>
std::string RefusalOf(const Call& call) {
  try {
    call();
  } catch (const io::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace test_support
