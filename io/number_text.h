#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace io {

/// The shortest decimal text that reads back to the same double; the same in every locale.
std::string NumberText(double number);

/// The finite number that fills the whole text, the decimal point being a point in any locale;
/// nothing when the text is no number, NaN, infinite or too large for a double.
std::optional<double> ParseNumber(std::string_view text);

}  // namespace io
