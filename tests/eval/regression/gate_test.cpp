#include "eval/regression/gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace eval {
namespace {

constexpr const char* kAte = "/trajectory/ate_se3/rmse_m";
constexpr const char* kPrecision = "/association/decision/precision";
constexpr const char* kFp = "/association/decision/fp";

/// Cases of one arm whose figures differ from scene to scene by a factor of some 1.5.
GateCases Cases(int count) {
  GateCases cases;
  std::mt19937 random(5);
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(random() % 1000) / 1000;
    GateCase one{true, {}};
    one.figures[kAte] = 0.002 * (1 + share);
    one.figures[kPrecision] = 0.99 - 0.02 * share;
    one.figures[kFp] = static_cast<double>(random() % 3);
    one.figures[kFramesFigure] = 60.0;
    one.figures[kTrackedFigure] = 60.0;
    cases["desk-" + std::to_string(100 + i) + "/arm"] = one;
  }
  return cases;
}

Baseline BaselineOf(const GateCases& cases) { return {"s", "p", "v", "c", "r", cases}; }

/// The cases after `change` was made to each, which is told its number.
GateCases Changed(GateCases cases, const std::function<void(GateCase&, int)>& change) {
  int i = 0;
  for (auto& [key, one] : cases) change(one, i++);
  return cases;
}

std::vector<std::string> Worse(const GateReport& report) {
  std::vector<std::string> names;
  for (const MetricVerdict& found : report.metrics) {
    if (found.verdict == Verdict::kWorse) names.emplace_back(found.metric.figure);
  }
  for (const CountVerdict& found : report.counts) {
    if (found.worse) names.push_back(found.what);
  }
  return names;
}

TEST(Gate, UnchangedCasesAreTheSameAtOnce) {
  for (const int count : {1, 2, 20}) {
    const GateCases cases = Cases(count);
    const GateReport report = CompareWithBaseline(BaselineOf(cases), cases, {});
    EXPECT_FALSE(report.AnyWorse());
    EXPECT_THAT(report.UndecidedArms(), ::testing::IsEmpty());
    EXPECT_THAT(GateTable(report), ::testing::StartsWith("3 of 3 figures are the same"));
  }
}

TEST(Gate, AnErrorThatGrewByATenthIsWorse) {
  const GateCases cases = Cases(20);
  const GateCases worse =
      Changed(cases, [](GateCase& one, int) { one.figures[kAte] = 1.1 * *one.figures[kAte]; });
  const GateReport report = CompareWithBaseline(BaselineOf(cases), worse, {});
  EXPECT_THAT(Worse(report), ::testing::ElementsAre(kAte));
  EXPECT_THAT(GateTable(report), ::testing::HasSubstr("+10.00 %"));
  EXPECT_THAT(GateTable(report), ::testing::HasSubstr("replay desk-"));
}

TEST(Gate, AnErrorThatGrewByAHundredthIsTheSame) {
  const GateCases cases = Cases(20);
  const GateCases little =
      Changed(cases, [](GateCase& one, int) { one.figures[kAte] = 1.01 * *one.figures[kAte]; });
  const GateReport report = CompareWithBaseline(BaselineOf(cases), little, {});
  EXPECT_FALSE(report.AnyWorse());
  EXPECT_THAT(report.UndecidedArms(), ::testing::IsEmpty());
}

TEST(Gate, WhatVariesTooMuchIsUndecided) {
  const GateCases cases = Cases(20);
  const GateCases noisy = Changed(cases, [](GateCase& one, int i) {
    one.figures[kAte] = (i % 2 == 0 ? 1.5 : 0.7) * *one.figures[kAte];
  });
  const GateReport report = CompareWithBaseline(BaselineOf(cases), noisy, {});
  EXPECT_FALSE(report.AnyWorse());
  EXPECT_THAT(report.UndecidedArms(), ::testing::ElementsAre("arm"));
  EXPECT_THAT(GateTable(report), ::testing::HasSubstr(kAte));
  EXPECT_THAT(GateTable(report), ::testing::Not(::testing::HasSubstr("undecided times")));
}

TEST(Gate, FewPairsThatDifferDecideNothing) {
  const GateCases cases = Cases(3);
  const GateCases worse =
      Changed(cases, [](GateCase& one, int) { one.figures[kAte] = 2 * *one.figures[kAte]; });
  const GateReport report = CompareWithBaseline(BaselineOf(cases), worse, {});
  EXPECT_FALSE(report.AnyWorse());
  EXPECT_THAT(report.UndecidedArms(), ::testing::SizeIs(1));
}

TEST(Gate, BetterIsTheSame) {
  const GateCases cases = Cases(20);
  const GateCases better = Changed(cases, [](GateCase& one, int) {
    one.figures[kAte] = 0.5 * *one.figures[kAte];
    one.figures[kPrecision] = 1.0;
  });
  const GateReport report = CompareWithBaseline(BaselineOf(cases), better, {});
  EXPECT_FALSE(report.AnyWorse());
  EXPECT_THAT(report.UndecidedArms(), ::testing::IsEmpty());
}

TEST(Gate, OneMoreWrongAssociationInEachRunIsWorse) {
  const GateCases cases = Cases(20);
  const GateCases worse =
      Changed(cases, [](GateCase& one, int) { one.figures[kFp] = *one.figures[kFp] + 1; });
  EXPECT_THAT(Worse(CompareWithBaseline(BaselineOf(cases), worse, {})),
              ::testing::ElementsAre(kFp));
}

TEST(Gate, FailuresAreWorseAndNeverDropped) {
  const GateCases cases = Cases(20);
  const GateCases one_failed = Changed(cases, [](GateCase& one, int i) {
    if (i == 3) one = {};
  });
  EXPECT_THAT(Worse(CompareWithBaseline(BaselineOf(cases), one_failed, {})),
              ::testing::ElementsAre("failed cases"));
  const GateCases half_failed = Changed(cases, [](GateCase& one, int i) {
    if (i % 2 == 0) one = {};
  });
  const GateReport report = CompareWithBaseline(BaselineOf(cases), half_failed, {});
  EXPECT_THAT(Worse(report), ::testing::Contains(kAte));
  EXPECT_EQ(report.metrics.front().pairs, 20u);
}

TEST(Gate, WhatFailedBeforeIsNoHarm) {
  const GateCases cases = Cases(20);
  const GateCases failed = Changed(cases, [](GateCase& one, int i) {
    if (i == 3) one = {};
  });
  for (const GateCases& now : {cases, failed}) {
    EXPECT_FALSE(CompareWithBaseline(BaselineOf(failed), now, {}).AnyWorse());
  }
}

TEST(Gate, ManyThatFailedBeforeAndAreDoneNowAreNoHarm) {
  const GateCases cases = Cases(20);
  const GateCases failed = Changed(cases, [](GateCase& one, int i) {
    if (i < 15) one = {};
  });
  EXPECT_FALSE(CompareWithBaseline(BaselineOf(failed), cases, {}).AnyWorse());
  EXPECT_TRUE(CompareWithBaseline(BaselineOf(cases), failed, {}).AnyWorse());
}

TEST(Gate, FailuresThatAreMendedHideNothing) {
  const GateCases cases = Cases(26);
  const GateCases failed = Changed(cases, [](GateCase& one, int i) {
    if (i < 4) one = {};
  });
  const GateCases worse =
      Changed(cases, [](GateCase& one, int) { one.figures[kAte] = 1.5 * *one.figures[kAte]; });
  EXPECT_THAT(Worse(CompareWithBaseline(BaselineOf(failed), worse, {})),
              ::testing::ElementsAre(kAte));
}

TEST(Gate, AnArmOfWhichNothingIsDoneIsNotTheSame) {
  const GateCases failed = Changed(Cases(20), [](GateCase& one, int) { one = {}; });
  EXPECT_TRUE(CompareWithBaseline(BaselineOf(failed), failed, {}).AnyWorse());
}

TEST(Gate, AFailureThatTheBaselineLacksIsWorse) {
  GateCases cases = Cases(20);
  const Baseline baseline = BaselineOf(cases);
  cases["new-1/arm"] = {};
  EXPECT_THAT(Worse(CompareWithBaseline(baseline, cases, {})),
              ::testing::ElementsAre("failed, and not in the baseline"));
}

TEST(Gate, FiguresThatTheBaselineLacksAreTold) {
  const GateCases cases = Cases(20);
  GateCases more = cases;
  for (auto& [key, one] : more) one.figures["/extraction/pq"] = 0.5;
  EXPECT_THAT(GateTable(CompareWithBaseline(BaselineOf(cases), more, {})),
              ::testing::HasSubstr("not compared: /extraction/pq;"));
  EXPECT_THAT(GateTable(CompareWithBaseline(BaselineOf(more), more, {})),
              ::testing::Not(::testing::HasSubstr("/extraction/pq")));
}

/// Thirteen scenes of these many seeds; the figure of those of "s3" changed.
GateReport OneSceneChanged(int seeds, const char* figure,
                           const std::function<double(double, int)>& change) {
  GateCases cases, now;
  for (int scene = 0; scene < 13; ++scene) {
    for (int seed = 0; seed < seeds; ++seed) {
      const std::string key = "s" + std::to_string(scene) + "-" + std::to_string(seed) + "/arm";
      cases[key] = now[key] = Cases(1).begin()->second;
      double& value = *now[key].figures[figure];
      if (scene == 3) value = change(value, seed);
    }
  }
  return CompareWithBaseline(BaselineOf(cases), now, {});
}

// A thirteenth of the cases moves the mean by little, whatever becomes of them.
TEST(Gate, ASceneThatIsMuchWorseInEverySeedIsWorse) {
  const auto doubled = [](double value, int) { return 2.01 * value; };
  const GateReport report = OneSceneChanged(3, kAte, doubled);
  ASSERT_EQ(report.scenes.size(), 1u);
  EXPECT_EQ(report.scenes.front().scene, "s3");
  EXPECT_TRUE(report.AnyWorse());
  EXPECT_THAT(GateTable(report), ::testing::HasSubstr("s3 of arm, in every seed"));
  EXPECT_THAT(GateTable(report), ::testing::HasSubstr("replay s3-0/arm"));
  EXPECT_TRUE(OneSceneChanged(3, kPrecision, [](double value, int) {
                return value - 0.11;
              }).AnyWorse());
}

TEST(Gate, ScenesWhoseNamesBeginAlikeAreJudgedEachByItself) {
  GateCases cases, now;
  for (const std::string scene : {"board-thin", "board-thick", "board"}) {
    for (const char* seed : {"-1", "-2", "-3"}) {
      const std::string key = scene + seed + "/arm";
      cases[key] = now[key] = Cases(1).begin()->second;
      if (scene == "board-thin") now[key].figures[kAte] = 3 * *now[key].figures[kAte];
    }
  }
  const GateReport report = CompareWithBaseline(BaselineOf(cases), now, {});
  ASSERT_EQ(report.scenes.size(), 1u);
  EXPECT_EQ(report.scenes.front().scene, "board-thin");
  EXPECT_EQ(report.scenes.front().pairs, 3u);
  EXPECT_EQ(report.scenes.front().verdict, Verdict::kWorse);
}

TEST(Gate, TwoSeedsOfASceneAskForMore) {
  const auto doubled = [](double value, int) { return 2.01 * value; };
  const GateReport report = OneSceneChanged(2, kAte, doubled);
  EXPECT_FALSE(report.AnyWorse());
  EXPECT_THAT(report.UndecidedArms(), ::testing::ElementsAre("arm"));
}

TEST(Gate, ASceneThatIsWorseByLessOrNotInEverySeedIsLeftToTheTests) {
  for (const GateReport& report :
       {OneSceneChanged(3, kAte, [](double value, int) { return 1.9 * value; }),
        OneSceneChanged(3, kPrecision, [](double value, int) { return value - 0.09; }),
        OneSceneChanged(3, kAte,
                        [](double value, int seed) { return seed == 1 ? value : 9 * value; }),
        OneSceneChanged(3, kFp, [](double value, int) { return value + 9; })}) {
    EXPECT_THAT(report.scenes, ::testing::IsEmpty());
  }
}

TEST(Gate, LostFramesOfWhatFailedBeforeAreNoHarm) {
  const GateCases lost = Changed(Cases(20), [](GateCase& one, int i) {
    if (i < 2) one.figures[kTrackedFigure] = 30.0;
  });
  const GateCases failed = Changed(Cases(20), [](GateCase& one, int i) {
    if (i < 2) one = {};
  });
  EXPECT_FALSE(CompareWithBaseline(BaselineOf(failed), lost, {}).AnyWorse());
}

TEST(Gate, LostFramesAreCounted) {
  const GateCases cases = Cases(20);
  const GateCases lost = Changed(cases, [](GateCase& one, int i) {
    if (i < 2) one.figures[kTrackedFigure] = 50.0;  // 20 of 1200
  });
  EXPECT_THAT(Worse(CompareWithBaseline(BaselineOf(cases), lost, {})),
              ::testing::ElementsAre("frames without a pose"));
  // A hundredth of all frames is let pass, whatever was lost before and in whichever case.
  for (const double lost_before : {0.0, 40.0}) {
    const auto with = [&](double more) {
      return Changed(cases, [&](GateCase& one, int i) {
        if (i == 3) *one.figures[kTrackedFigure] -= lost_before;
        if (i == 7) *one.figures[kTrackedFigure] -= more;
      });
    };
    const Baseline before = BaselineOf(with(0));
    EXPECT_FALSE(CompareWithBaseline(before, with(12), {}).AnyWorse()) << lost_before;
    EXPECT_TRUE(CompareWithBaseline(before, with(13), {}).AnyWorse()) << lost_before;
  }
}

TEST(Gate, AFigureThatIsGoneIsWorse) {
  const GateCases cases = Cases(20);
  const GateCases gone =
      Changed(cases, [](GateCase& one, int) { one.figures[kAte] = std::nullopt; });
  EXPECT_THAT(Worse(CompareWithBaseline(BaselineOf(cases), gone, {})),
              ::testing::ElementsAre(kAte));
}

TEST(Gate, BoundsHoldForEachCaseByItself) {
  GateCases cases = Cases(20);
  cases.begin()->second.figures[kPrecision] = 0.5;
  GateRules rules;
  rules.worst[kPrecision] = 0.9;
  const GateReport report = CompareWithBaseline(BaselineOf(cases), cases, rules);
  EXPECT_THAT(Worse(report),
              ::testing::ElementsAre(std::string(kPrecision) + " beyond its bound"));
  EXPECT_THAT(GateTable(report), ::testing::HasSubstr("desk-100/arm"));
}

TEST(Gate, WhatIsAtItsBoundIsNotBeyondIt) {
  for (const double less : {-1e-9, 0.0, 1e-9}) {
    const Figures figures = {{kAte, 0.02 - less}, {kPrecision, 0.9 - less}};
    EXPECT_EQ(BeyondBounds(figures, {{kAte, 0.02}}).size(), less < 0 ? 1u : 0u);
    EXPECT_EQ(BeyondBounds(figures, {{kPrecision, 0.9}}).size(), less > 0 ? 1u : 0u);
  }
}

TEST(Gate, MoreLooksAskForMoreEvidence) {
  const GateCases cases = Cases(9);  // 2^-9, times three figures by Holm, is 0.0059
  const GateCases worse =
      Changed(cases, [](GateCase& one, int) { one.figures[kAte] = 1.1 * *one.figures[kAte]; });
  GateRules rules;
  EXPECT_TRUE(CompareWithBaseline(BaselineOf(cases), worse, rules).AnyWorse());
  rules.looks = 2;
  EXPECT_FALSE(CompareWithBaseline(BaselineOf(cases), worse, rules).AnyWorse());
}

TEST(Gate, TimesAreLeftOutWhenTheRulesSaySo) {
  GateCases cases = Cases(20);
  for (auto& [key, one] : cases) one.figures["/time_ratio/da"] = 2.0;
  const GateCases slower =
      Changed(cases, [](GateCase& one, int) { one.figures["/time_ratio/da"] = 2.1; });
  GateRules rules;
  EXPECT_THAT(Worse(CompareWithBaseline(BaselineOf(cases), slower, rules)),
              ::testing::ElementsAre("/time_ratio/da"));
  rules.times = false;
  EXPECT_FALSE(CompareWithBaseline(BaselineOf(cases), slower, rules).AnyWorse());
}

TEST(Gate, TimesThatVaryAreToldAndPass) {
  GateCases cases = Cases(20);
  for (auto& [key, one] : cases) one.figures["/time_ratio/da"] = 2.0;
  const GateCases varied = Changed(cases, [](GateCase& one, int i) {
    one.figures["/time_ratio/da"] = i % 2 == 0 ? 3.0 : 1.5;
  });
  const GateReport report = CompareWithBaseline(BaselineOf(cases), varied, {});
  EXPECT_FALSE(report.AnyWorse());
  EXPECT_THAT(report.UndecidedArms(), ::testing::IsEmpty());
  EXPECT_THAT(GateTable(report), ::testing::HasSubstr("undecided times pass"));
}

TEST(Gate, CasesThatTheBaselineLacksAreTold) {
  GateCases cases = Cases(20);
  const Baseline baseline = BaselineOf(cases);
  cases["new-1/arm"] = cases.begin()->second;
  const GateReport report = CompareWithBaseline(baseline, cases, {});
  EXPECT_EQ(report.unknown_cases, 1u);
  const auto told = ::testing::HasSubstr("1 cases are not in the baseline");
  EXPECT_THAT(GateTable(report), told);
  const GateReport known = CompareWithBaseline(BaselineOf(cases), cases, {});
  EXPECT_THAT(GateTable(known), ::testing::Not(::testing::HasSubstr("not in the baseline")));
}

TEST(Gate, AFigureThatIsNotDefinedIsNotWithinItsBound) {
  const Baseline nothing = BaselineOf({});
  GateCases cases = Cases(3);
  GateRules rules;
  rules.worst[kAte] = 1.0;
  EXPECT_FALSE(CompareWithBaseline(nothing, cases, rules).AnyWorse());
  cases.begin()->second.figures[kAte] = std::nullopt;
  const GateReport report = CompareWithBaseline(nothing, cases, rules);
  EXPECT_THAT(Worse(report),
              ::testing::ElementsAre(std::string(kAte) + " is bounded, but not defined"));
  EXPECT_THAT(GateTable(report), ::testing::HasSubstr("desk-100/arm"));
}

TEST(Gate, AFailureIsNotToldAgainForEachOfItsBounds) {
  GateCases cases = Cases(1);
  cases.begin()->second = {};
  GateRules rules;
  rules.worst[kAte] = 1.0;
  EXPECT_THAT(Worse(CompareWithBaseline(BaselineOf({}), cases, rules)),
              ::testing::ElementsAre("failed, and not in the baseline"));
}

}  // namespace
}  // namespace eval
