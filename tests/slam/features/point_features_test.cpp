#include "slam/features/point_features.h"
#include "slam/features/read_depths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <tuple>
#include <utility>

#include "slam/features/match_features.h"
#include "tests/support/normal_draws.h"
#include "tests/support/textured_world.h"

namespace slam {
namespace {

Camera CameraOf(const cv::Mat1b& image) { return CameraOfSize(image.cols, image.rows); }

std::vector<PointFeature> Extract(const cv::Mat1b& image,
                                  const PointFeatureConfig& config = {}) {
  return ExtractPointFeatures(image, CameraOf(image), config);
}

cv::Mat1b PatternImage(int width, int height) {
  return BlockPattern(std::max(width, height), 5)(cv::Rect(0, 0, width, height)).clone();
}

TEST(PointFeatures, AreSpreadOverTheWholeImageEvenWhenOneSideHasTheStrongerPrint) {
  cv::Mat1b image = PatternImage(640, 480);
  cv::Mat1b pale = image(cv::Rect(0, 0, 320, 480));
  pale.convertTo(pale, CV_8U, 0.25, 96);
  std::array<int, 16> counts{};
  for (const PointFeature& f : Extract(image)) {
    const int c = std::clamp(static_cast<int>(f.u_px.x() / 160), 0, 3);
    const int r = std::clamp(static_cast<int>(f.u_px.y() / 120), 0, 3);
    ++counts[static_cast<std::size_t>(4 * r + c)];
  }
  // 1000 features on 16 equal cells are 62 a cell; no cell has less than a third of it.
  EXPECT_GE(*std::min_element(counts.begin(), counts.end()), 20);
}

// A cell that has a corner is not searched again, wherever in it the corner lies. Cells are 30.4
// px wide here: their borders fall between pixels.
TEST(PointFeatures, NameNoCornerTwice) {
  for (int shift = 0; shift < 31; ++shift) {
    cv::Mat1b image(480, 640, std::uint8_t{100});
    for (int x = 20 + shift; x < 600; x += 61) {
      for (int y = 20 + shift; y < 440; y += 64) image(cv::Rect(x, y, 4, 4)) = 200;
    }
    std::vector<PointFeature> features = Extract(image);
    ASSERT_GT(features.size(), 30u);
    const auto place = [](const PointFeature& f) {
      return std::tuple(f.octave, f.u_px.x(), f.u_px.y());
    };
    std::sort(features.begin(), features.end(),
              [&](const auto& a, const auto& b) { return place(a) < place(b); });
    const auto twice =
        std::adjacent_find(features.begin(), features.end(),
                           [&](const auto& a, const auto& b) { return place(a) == place(b); });
    EXPECT_EQ(twice, features.end()) << shift;
  }
}

TEST(PointFeatures, ComeInTheNumberAskedFor) {
  const cv::Mat1b image = PatternImage(640, 480);
  for (const int count : {200, 1000}) {
    PointFeatureConfig config;
    config.count = count;
    const auto features = Extract(image, config);
    const int found = static_cast<int>(features.size());
    EXPECT_GE(found, count - 20);
    EXPECT_LE(found, count + 24);  // two more in each of eight octaves, and rounding
    // Of each octave as many as its image is wide.
    const auto of_octave = [&](int octave) {
      return std::count_if(features.begin(), features.end(),
                           [&](const PointFeature& f) { return f.octave == octave; });
    };
    for (int octave = 1; octave < config.scale.octaves; ++octave)
      EXPECT_NEAR(static_cast<double>(of_octave(octave)),
                  static_cast<double>(of_octave(0)) / config.scale.Scale(octave), 4.0);
  }
}

TEST(PointFeatures, AreFoundAgainAndLookAlikeUnderAKnownHomography) {
  const cv::Mat1b image = PatternImage(640, 480);
  // Turned by 20 degrees, smaller by 1.15, a little perspective.
  const double a = 20.0 * M_PI / 180, s = 1 / 1.15;
  const cv::Matx33d to_centre(1, 0, -320, 0, 1, -240, 0, 0, 1);
  const cv::Matx33d from_centre(1, 0, 320, 0, 1, 240, 0, 0, 1);
  const cv::Matx33d turn(s * std::cos(a), -s * std::sin(a), 0, s * std::sin(a), s * std::cos(a),
                         0, 1e-4, -5e-5, 1);
  const cv::Matx33d H = from_centre * turn * to_centre;
  cv::Mat1b warped;
  cv::warpPerspective(image, warped, H, image.size());

  const auto first = Extract(image), second = Extract(warped);
  int visible = 0, repeated = 0;
  const auto image_of = [&](const PointFeature& f) -> Eigen::Vector2d {
    const cv::Vec3d h = H * cv::Vec3d(f.u_px.x(), f.u_px.y(), 1);
    return {h[0] / h[2], h[1] / h[2]};
  };
  for (const PointFeature& f : first) {
    const Eigen::Vector2d expected = image_of(f);
    if (expected.x() < 20 || expected.x() > 619 || expected.y() < 20 || expected.y() > 459) {
      continue;
    }
    ++visible;
    repeated += std::any_of(second.begin(), second.end(), [&](const PointFeature& g) {
      return (g.u_px - expected).norm() < 2.0 * FeatureScale{}.Scale(f.octave);
    });
  }
  EXPECT_GE(repeated, 0.6 * visible);

  int right = 0;
  const auto pairs = MatchDescriptors(first, second, {}, {64, 0.8});
  for (const FeaturePair& pair : pairs) {
    const PointFeature& f = first[static_cast<std::size_t>(pair.first)];
    const PointFeature& g = second[static_cast<std::size_t>(pair.second)];
    if ((g.u_px - image_of(f)).norm() < 3.0 * FeatureScale{}.Scale(f.octave)) ++right;
  }
  EXPECT_GE(pairs.size(), 150u);
  EXPECT_GE(right, 0.9 * static_cast<double>(pairs.size()));
}

/// The image with white noise, from a seed.
cv::Mat1b Noisy(const cv::Mat1b& image, double sigma, std::uint64_t seed) {
  Random random{seed, 5};
  cv::Mat1b noisy = image.clone();
  for (std::uint8_t& grey : noisy) {
    grey = cv::saturate_cast<std::uint8_t>(grey + sigma * BoundedNormal(random));
  }
  return noisy;
}

TEST(PointFeatures, AreFoundAgainAndLookAlikeUnderTheNoiseOfASensor) {
  cv::Mat1b image = PatternImage(640, 480);
  image.convertTo(image, CV_8U, 0.5, 64);
  for (const auto& [sigma, found, alike] : {std::tuple{2.0, 0.7, 0.5}, {6.0, 0.5, 0.33}}) {
    const auto first = Extract(Noisy(image, sigma, 1)),
               second = Extract(Noisy(image, sigma, 2));
    const auto same_place = [](const PointFeature& f, const PointFeature& g) {
      return (f.u_px - g.u_px).norm() < 1.5 * FeatureScale{}.Scale(f.octave);
    };
    int repeated = 0;
    for (const PointFeature& f : first) {
      repeated += std::any_of(second.begin(), second.end(), [&](const PointFeature& g) {
        return std::abs(f.octave - g.octave) <= 1 && same_place(f, g);
      });
    }
    const auto count = static_cast<double>(first.size());
    EXPECT_GE(repeated, found * count) << sigma;

    int right = 0;
    const auto pairs = MatchDescriptors(first, second, {}, {50, 0.8});
    for (const FeaturePair& pair : pairs) {
      right += same_place(first[static_cast<std::size_t>(pair.first)],
                          second[static_cast<std::size_t>(pair.second)]);
    }
    EXPECT_GE(right, alike * count) << sigma;
    EXPECT_GE(right, 0.97 * static_cast<double>(pairs.size())) << sigma;
  }
}

TEST(PointFeatures, TurnTheirAngleWithTheImage) {
  const cv::Mat1b image = PatternImage(240, 240);
  cv::Mat1b turned;
  cv::rotate(image, turned, cv::ROTATE_90_CLOCKWISE);
  const auto first = Extract(image), second = Extract(turned);
  int found = 0, agree = 0;
  for (const PointFeature& f : first) {
    if (f.octave != 0) continue;
    const Eigen::Vector2d expected(239 - f.u_px.y(), f.u_px.x());
    for (const PointFeature& g : second) {
      if (g.octave != 0 || (g.u_px - expected).norm() > 0.01) continue;
      ++found;
      const double turn_deg = g.angle_deg - f.angle_deg - 90.0;
      agree += std::abs(std::remainder(turn_deg, 360.0)) < 0.1;
    }
  }
  EXPECT_GE(found, 50);
  EXPECT_EQ(agree, found);
}

// The sides of an octave are whole pixels: columns and rows are not scaled alike.
TEST(PointFeatures, LieInTheMirrorWhereTheImageHasThemInEveryOctave) {
  constexpr int kWidth = 203, kHeight = 149;
  const cv::Mat1b image = PatternImage(kWidth, kHeight);
  const auto first = Extract(image);
  for (const bool upside_down : {false, true}) {
    cv::Mat1b mirrored;
    cv::flip(image, mirrored, upside_down ? 0 : 1);
    const auto second = Extract(mirrored);
    std::vector<int> all(8), found(8);
    for (const PointFeature& f : first) {
      Eigen::Vector2d expected = f.u_px;
      if (upside_down) expected.y() = kHeight - 1 - expected.y();
      if (!upside_down) expected.x() = kWidth - 1 - expected.x();
      ++all[Index(f.octave)];
      found[Index(f.octave)] +=
          std::any_of(second.begin(), second.end(), [&](const PointFeature& g) {
            return g.octave == f.octave && (g.u_px - expected).norm() < 0.01;
          });
    }
    for (std::size_t o = 0; o < all.size(); ++o) {
      EXPECT_GE(all[o], 10) << o;
      EXPECT_GE(found[o], 0.6 * all[o]) << o;
    }
  }
}

TEST(PointFeatures, AreNoneInABlackImage) {
  EXPECT_TRUE(Extract(cv::Mat1b(480, 640, std::uint8_t{0})).empty());
}

TEST(PointFeatures, ComeFromSmallImagesToo) {
  EXPECT_GE(Extract(PatternImage(64, 48)).size(), 20u);
  EXPECT_GE(Extract(PatternImage(160, 120)).size(), 150u);
  EXPECT_NO_THROW(Extract(PatternImage(70, 400)));
}

TEST(PointFeatures, AreTheSameBytesTwice) {
  const cv::Mat1b image = PatternImage(320, 240);
  const auto first = Extract(image), second = Extract(image);
  ASSERT_FALSE(first.empty());
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].u_px, second[i].u_px);
    EXPECT_EQ(first[i].angle_deg, second[i].angle_deg);
    EXPECT_EQ(first[i].descriptor, second[i].descriptor);
  }
}

TEST(PointFeatures, CarryDepthAndItsVirtualRightCoordinate) {
  const cv::Mat1b image = PatternImage(320, 240);
  const cv::Mat1f depth_m(240, 320, 2.0f);
  auto features = ExtractPointFeatures(image, CameraOf(image), {});
  ReadDepths(depth_m, CameraOf(image), {}, {}, {}, features);
  ASSERT_FALSE(features.empty());
  for (const PointFeature& f : features) {
    EXPECT_DOUBLE_EQ(f.depth_m, 2.0);
  }
}

TEST(PointFeatures, LieOnTheUndistortedImage) {
  const cv::Mat1b image = PatternImage(640, 480);
  const Camera lens = TumCamera("tum1");
  Camera pinhole = lens;
  pinhole.k1 = pinhole.k2 = pinhole.k3 = pinhole.p1 = pinhole.p2 = 0;
  const auto ideal = ExtractPointFeatures(image, lens, {});
  const auto recorded = ExtractPointFeatures(image, pinhole, {});
  ASSERT_EQ(ideal.size(), recorded.size());
  for (std::size_t i = 0; i < ideal.size(); ++i) {
    const Eigen::Vector2d back =
        lens.ProjectDistorted(lens.Backproject(ideal[i].u_px, 1.0)) - recorded[i].u_px;
    EXPECT_LT(back.norm(), 1e-6);
  }
}

/// Features within `radius_px` of a place.
std::vector<PointFeature> Around(const std::vector<PointFeature>& features,
                                 const Eigen::Vector2d& at_px, double radius_px) {
  std::vector<PointFeature> near;
  for (const PointFeature& f : features) {
    if ((f.u_px - at_px).norm() < radius_px) near.push_back(f);
  }
  return near;
}

bool OnEdge(const PointFeature& f) { return f.on_edge; }

TEST(PointFeatures, AreWhereTheCameraOfTheMiddleRowSawThem) {
  const cv::Mat1b image = PatternImage(640, 480);
  Camera camera = CameraOf(image);
  camera.k1 = 0.1;
  Readout readout;
  readout.taken_out_s = 0.03;
  readout.speed << 0.4, -0.3, 0.2, 0.5, -0.8, 1.0;
  const auto as_read = ExtractPointFeatures(image, camera, {});
  // A wall before the camera of the middle row, and nothing measured at all.
  const double wall_m = 1.5;
  for (const cv::Mat1f& depth_m : {cv::Mat1f(image.size(), 1.5f), cv::Mat1f()}) {
    auto features = as_read;
    ReadDepths(depth_m, camera, {}, {}, readout, features);
    ASSERT_EQ(features.size(), as_read.size());
    double largest_px = 0.0;
    for (std::size_t i = 0; i < features.size(); ++i) {
      const double row = camera.ProjectDistorted(camera.Backproject(as_read[i].u_px, 1.0)).y();
      const Pose T_rc = readout.T_rc(row / 479 - 0.5);
      const bool measured = !depth_m.empty() && features[i].depth_m > 0;
      const Eigen::Vector3d x_c = camera.Backproject(features[i].u_px, measured ? wall_m : 1e6);
      EXPECT_LT((camera.Project(T_rc * x_c) - as_read[i].u_px).norm(), 1e-3);
      EXPECT_NEAR(features[i].depth_m, measured ? wall_m : 0.0, 1e-5);
      largest_px = std::max(largest_px, (features[i].u_px - as_read[i].u_px).norm());
    }
    EXPECT_GT(largest_px, 5.0);
  }
}

TEST(PointFeatures, TellACornerThatSlidesAlongAStraightEdge) {
  // A slanting edge, soft as a lens makes it, with noise; the corners of a box; a dot.
  cv::Mat1b image(480, 640, std::uint8_t{70});
  cv::fillConvexPoly(image, std::vector<cv::Point>{{40, 20}, {200, 20}, {280, 460}, {40, 460}},
                     180);
  cv::rectangle(image, {400, 100, 150, 120}, 180, cv::FILLED);
  cv::circle(image, {450, 350}, 4, 180, cv::FILLED);
  cv::GaussianBlur(image, image, cv::Size(5, 5), 1.0);
  PointFeatureConfig config;
  config.scale.octaves = 1;
  std::size_t along = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const auto features = Extract(Noisy(image, 4.0, seed), config);
    for (const PointFeature& f : features) {
      const double edge_u_px = 200 + (f.u_px.y() - 20) * 80 / 440;
      const bool here = f.u_px.y() > 60 && f.u_px.y() < 420;
      if (!here || std::abs(f.u_px.x() - edge_u_px) > 1.5) continue;
      EXPECT_TRUE(f.on_edge) << f.u_px.transpose();
      ++along;
    }
    for (const Eigen::Vector2d& place_px :
         {Eigen::Vector2d(400, 100), {549, 219}, {450, 350}}) {
      const auto there = Around(features, place_px, 4.0);
      EXPECT_FALSE(there.empty()) << place_px.transpose();
      EXPECT_TRUE(std::none_of(there.begin(), there.end(), OnEdge)) << place_px.transpose();
    }
  }
  EXPECT_GE(along, 20u);
}

TEST(PointFeatures, HaveDoublesOnTheStepsOfAThinSlantingLine) {
  // A thin line is a staircase of pixels, whose steps are corners; the corners of a box are alone.
  cv::Mat1b image(480, 640, std::uint8_t{70});
  cv::line(image, {200, 20}, {280, 460}, 180);
  cv::rectangle(image, {400, 100, 150, 120}, 180, cv::FILLED);
  const auto features = Extract(Noisy(image, 2.0, 1), {});
  const FeatureGrid grid(features, CameraOf(image));
  const auto has_double = [&](const PointFeature& f) {
    return HasDouble(f, features, grid, {}, 30, 50);
  };
  int along = 0, by_patch = 0, by_both = 0;
  for (const PointFeature& f : features) {
    const double edge_u_px = 200 + (f.u_px.y() - 20) * 80 / 440;
    const bool here = f.u_px.y() > 60 && f.u_px.y() < 420;
    if (!here || std::abs(f.u_px.x() - edge_u_px) > 3) continue;
    ++along;
    if (f.on_edge) ++by_patch;
    if (f.on_edge || has_double(f)) ++by_both;
  }
  EXPECT_GE(along, 50);
  EXPECT_LE(by_patch, along / 2) << "the patch tells by itself";
  EXPECT_GE(by_both, along * 4 / 5);
  for (const Eigen::Vector2d& place_px : {Eigen::Vector2d(400, 100), {549, 219}}) {
    const auto there = Around(features, place_px, 4.0);
    EXPECT_FALSE(there.empty());
    EXPECT_TRUE(std::none_of(there.begin(), there.end(), has_double)) << place_px.transpose();
  }
}

// Waves as long as the window that is looked at: its sums do not depend on where it lies, and the
// eigenvalues of its tensor are as the squares of the two waves.
TEST(PointFeatures, LieOnAnEdgeFromTenTimesTheContrastAcrossItOn) {
  for (const auto& [ratio, on_edge] : {std::pair{8.0, false}, {12.5, true}}) {
    for (const bool upright : {false, true}) {
      cv::Mat1b image(480, 640);
      const double strong = 85.0, weak = strong / std::sqrt(ratio);
      for (int v = 0; v < image.rows; ++v) {
        for (int u = 0; u < image.cols; ++u) {
          const double across = std::cos(2 * M_PI * (upright ? u : v) / 7);
          const double along = std::cos(2 * M_PI * (upright ? v : u) / 7);
          image(v, u) = cv::saturate_cast<std::uint8_t>(128 + strong * across + weak * along);
        }
      }
      PointFeatureConfig config;
      config.scale.octaves = 1;
      const auto features = Extract(image, config);
      ASSERT_GE(features.size(), 100u);
      EXPECT_EQ(std::count_if(features.begin(), features.end(), OnEdge),
                on_edge ? std::ssize(features) : 0)
          << ratio;
    }
  }
}

TEST(PointFeatures, RefuseImagesOfAnotherSize) {
  const cv::Mat1b image = PatternImage(320, 240);
  EXPECT_THROW(ExtractPointFeatures(image, CameraOfSize(640, 480), {}), std::invalid_argument);
  std::vector<PointFeature> none;
  EXPECT_THROW(ReadDepths(cv::Mat1f(10, 10, 1.0f), CameraOf(image), {}, {}, {}, none),
               std::invalid_argument);
}

}  // namespace
}  // namespace slam
