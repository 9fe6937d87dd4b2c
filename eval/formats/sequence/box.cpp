#include "eval/formats/sequence/box.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace eval {

std::optional<Box> ReadBox(const JsonRecord& record, const std::string& key, cv::Size size,
                           bool may_be_thin) {
  const auto numbers = record.Numbers(key, 4);
  if (!numbers) return std::nullopt;
  const Box box{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
  const auto& [x0, y0, x1, y1] = box;
  const bool ordered = may_be_thin ? x0 <= x1 && y0 <= y1 : x0 < x1 && y0 < y1;
  // Pixel centres are whole, so the image reaches from -0.5 to size - 0.5; a box may as well be
  // given by pixel edges, 0 to size.
  const bool inside =
      size.empty() || (x0 >= -0.5 && y0 >= -0.5 && x1 <= size.width && y1 <= size.height);
  const std::string text = fmt::format("{}", *numbers);
  if (!ordered) {
    record.TellAt(key, text + " is not [x0, y0, x1, y1] with x0 < x1, y0 < y1",
                  "write the upper left corner first, not a width and height", Severity::kFlaw);
  } else if (!inside) {
    record.TellAt(
        key,
        fmt::format("{} leaves the image of {} x {} pixels", text, size.width, size.height),
        "clip the box to the image", Severity::kFlaw);
  }
  return box;
}

}  // namespace eval
