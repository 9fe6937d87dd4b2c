// `pas scene show`: each object stands somewhere in what it prints.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/program.h"

namespace {

using namespace program;
using testing::ContainsRegex;

TEST(SceneShow, ListsWhatMovesAmongThatWithoutPlanes) {
  const TemporaryFolder folder;
  const std::string text = Pas().string(), scene = (folder / "scene.yaml").string();
  std::ofstream(scene) << "format: pas-scene/1\nname: own\nobjects:\n"
                          "  - {id: 1, name: floor, class: floor, role: structure,"
                          " size_m: [4, 4, 0.1], center_m: [0, 0, -0.05]}\n"
                          "  - {id: 2, name: ball, class: ball, role: unstructured, shape: toy,"
                          " size_m: [0.1, 0.1, 0.1], center_m: [1, 0, 0.05]}\n"
                          "  - {id: 3, name: drawer, class: box, role: unstructured,"
                          " size_m: [0.2, 0.2, 0.2], way: [{time_s: 0, center_m: [0, 0, 0.2]},"
                          " {time_s: 1, center_m: [0, 1, 0.2]}]}\n";
  const Outcome outcome =
      Process({"/bin/sh", "-c", text + " scene show " + scene + " >&2"}, {}, folder / "errors")
          .Wait();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(outcome.errors, ContainsRegex("ball +ball +unstructured +no planes"));
  EXPECT_THAT(outcome.errors, ContainsRegex("drawer +box +unstructured +no planes"));
  EXPECT_THAT(outcome.errors,
              testing::Not(ContainsRegex("floor +floor +structure +no planes")));
}

}  // namespace
