#include "eval/regression/gated_metrics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace eval {
namespace {

TEST(GatedMetrics, HarmIsPositiveForWhatIsWorse) {
  EXPECT_NEAR(Harm(MetricKind::kError, 0.002, 0.0022), std::log(1.1), 1e-6);
  EXPECT_DOUBLE_EQ(Harm(MetricKind::kScore, 0.97, 0.95), 0.97 - 0.95);
  EXPECT_DOUBLE_EQ(Harm(MetricKind::kCount, 0, 1), std::log(3.0));
  EXPECT_LT(Harm(MetricKind::kError, 0.002, 0.001), 0.0);
  EXPECT_LT(Harm(MetricKind::kScore, 0.5, 0.9), 0.0);
}

TEST(GatedMetrics, EqualFiguresHaveNoHarm) {
  for (const MetricKind kind :
       {MetricKind::kError, MetricKind::kScore, MetricKind::kCount, MetricKind::kTime}) {
    EXPECT_EQ(Harm(kind, 0.0, 0.0), 0.0);
    EXPECT_EQ(Harm(kind, 0.3, 0.3), 0.0);
  }
}

TEST(GatedMetrics, FivePercentOfATimeAreMoreThanMatters) {
  EXPECT_GT(Harm(MetricKind::kTime, 2.0, 2.1), MaxHarm(MetricKind::kTime));
  EXPECT_LT(Harm(MetricKind::kTime, 2.0, 2.04), MaxHarm(MetricKind::kTime));
}

TEST(GatedMetrics, HarmsAreToldAsChanges) {
  EXPECT_EQ(HarmText(MetricKind::kError, std::log(1.072)), "+7.20 %");
  EXPECT_EQ(HarmText(MetricKind::kScore, 0.013), "-0.0130");
}

}  // namespace
}  // namespace eval
