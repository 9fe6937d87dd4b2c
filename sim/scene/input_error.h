#pragma once

#include <stdexcept>
#include <string>

namespace sim {

/// Bad data from outside: a file, a key, a value. The message says where ("desk.yaml:12"), what
/// was expected and how to mend it. Caught once, in `app`; exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  InputError(const std::string& where, const std::string& what)
      : std::runtime_error(where + ": " + what) {}
};

}  // namespace sim
