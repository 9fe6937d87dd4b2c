#include "eval/report/table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace eval {
namespace {

TEST(MetricsTable, CutsNeitherALongReasonNorTheLineOfALongName) {
  const std::string reason(400, 'r'), name(400, 'm');
  Evaluation evaluation;
  evaluation.trajectory.no_ate_se3 = reason;
  evaluation.timing = TimingScore{{{name, 1.0, 2.0, 3.0}, {"mt", 4.0, 5.0, 6.0}}, {}, {}};
  const std::string table = MetricsTable(evaluation);
  EXPECT_THAT(table, ::testing::HasSubstr("-  (" + reason + ")\n"));
  EXPECT_THAT(table, ::testing::HasSubstr(
                         "  " + name +
                         " mean     1.00   median     2.00   95 % below     3.00\n  mt "));
}

}  // namespace
}  // namespace eval
