#pragma once

#include <stdexcept>
#include <string>

namespace slam {

/// Checks a promise of the caller (unit normal, equal sizes); always armed, O(1) checks only.
/// @throws std::invalid_argument with `message` when `condition` is false.
inline void Require(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(message);
}

/// Bad data from outside: a file, a key, an image. The message says where, what was expected
/// and how to mend it. Caught once, in `app`; exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  InputError(const std::string& where, const std::string& what)
      : std::runtime_error(where + ": " + what) {}
};

}  // namespace slam
