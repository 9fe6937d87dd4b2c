#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace io {

/// The shortest decimal text that reads back to the same double; the same in every locale.
std::string NumberText(double number);

/// The finite number that fills the whole text, the decimal point being a point in any locale;
/// nothing when the text is no number, NaN, infinite or too large for a double.
std::optional<double> ParseNumber(std::string_view text);

/// The whole number, without a plus sign, that fills the text; nothing when its type does not hold it.
template <typename Whole>
std::optional<Whole> ParseWhole(std::string_view text) {
  Whole number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace io
