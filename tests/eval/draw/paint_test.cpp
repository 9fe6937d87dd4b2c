#include "eval/draw/paint.h"

#include <gtest/gtest.h>

namespace eval {
namespace {

TEST(Fitted, IsNoWiderThanItMayBeWithItsDots) {
  const TextStyle style{12, Colour(0, 0, 0), false, Align::kLeft};
  const std::string text = "keyboard on desk_a, 0.12 m2, seen in 311 frames";
  const double whole = TextWidth(text, style);
  EXPECT_EQ(Fitted(text, style, whole + 1), text);
  for (double width_px = 40; width_px < whole; width_px += 7) {
    const std::string fitted = Fitted(text, style, width_px);
    EXPECT_TRUE(fitted.ends_with("...")) << fitted;
    EXPECT_LE(TextWidth(fitted, style), width_px) << fitted;
    EXPECT_GT(TextWidth(fitted, style), width_px - 30) << fitted;
  }
}

}  // namespace
}  // namespace eval
