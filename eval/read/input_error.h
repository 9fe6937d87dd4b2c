#pragma once

#include <stdexcept>
#include <string>

namespace eval {

/// Bad data from outside: a file, a line, a key. The message says where, what was expected and
/// how to mend it. Caught once, in `app`; exit code 2.
class InputError : public std::runtime_error {
 public:
  /// @param where  "file", "file:line" or "file: key"
  InputError(const std::string& where, const std::string& what)
      : std::runtime_error(where + ": " + what) {}
};

}  // namespace eval
