#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace io {

/// "file:line", lines counted from 1.
inline std::string Where(const std::filesystem::path& file, int line) {
  return file.string() + ":" + std::to_string(line);
}

/// Text of a file as messages quote it: without control characters, and cut off when it is
/// long.
inline std::string Quoted(const std::string& text) {
  constexpr std::size_t kMaxShown = 40;  // characters
  std::string shown = "`";
  for (const char c : text.substr(0, kMaxShown)) shown += c >= ' ' && c != 127 ? c : '?';
  return shown + (text.size() > kMaxShown ? "...`" : "`");
}

/// Bad data from outside: a file, a key, a value, a place that cannot be written to. The
/// message says where ("desk.yaml:12"), what was expected and how to mend it. Caught once, in
/// `app`; exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  InputError(const std::string& where, const std::string& what)
      : std::runtime_error(where + ": " + what) {}
};

}  // namespace io
