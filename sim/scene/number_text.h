#pragma once

#include <array>
#include <charconv>
#include <string>

namespace sim {

/// The shortest decimal text that reads back to the same double; the same in every locale.
inline std::string NumberText(double number) {
  std::array<char, 40> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), number);
  return {text.data(), result.ptr};
}

}  // namespace sim
