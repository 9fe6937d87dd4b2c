#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "property_tests/generators/numbers.h"
#include "slam/detect/box_tracks.h"
#include "slam/geometry/box.h"

namespace slam {
namespace {

const Box kImage{{0, 0}, {639, 479}};
constexpr double kFrame_s = 1.0 / 30;

using generators::AnyInt;

/// Any box inside the image with a class out of three.
Detection AnyDetection() {
  const int u = AnyInt(0, 560), v = AnyInt(0, 400);
  Detection d;
  d.class_name = *rc::gen::element<std::string>("book", "laptop", "person");
  d.kind = d.class_name == "person" ? ClassKind::kUnstructured : ClassKind::kRegular;
  d.score = AnyInt(1, 100) / 100.0;
  d.box_px = {Eigen::Vector2d(u, v), Eigen::Vector2d(u + AnyInt(4, 79), v + AnyInt(4, 79))};
  return d;
}

/// A box with corners in whole pixels, so that areas are exact; every eighth has no area.
Box AnyPixelBox() {
  const int u = AnyInt(-50, 640), v = AnyInt(-50, 480);
  const int width = AnyInt(0, 7) == 0 ? 0 : AnyInt(1, 300), height = AnyInt(1, 300);
  return {Eigen::Vector2d(u, v), Eigen::Vector2d(u + width, v + height)};
}

RC_GTEST_PROP(BoxIou, IsSymmetricToTheBitAndTheShareOfUnitSquares, ()) {
  const Box a = AnyPixelBox(), b = AnyPixelBox();
  const double iou = Iou(a, b);
  RC_ASSERT(iou == Iou(b, a));
  RC_ASSERT(iou >= 0 && iou <= 1);
  RC_ASSERT(Iou(a, a) == (a.area() > 0 ? 1.0 : 0.0));
  // By counting rows and columns of unit squares that lie in both.
  const auto common = [](double low_1, double high_1, double low_2, double high_2) {
    int count = 0;
    for (int i = -50; i < 1000; ++i)
      count += i >= low_1 && i + 1 <= high_1 && i >= low_2 && i + 1 <= high_2 ? 1 : 0;
    return count;
  };
  const double both = common(a.min.x(), a.max.x(), b.min.x(), b.max.x()) *
                      common(a.min.y(), a.max.y(), b.min.y(), b.max.y());
  const double either = a.area() + b.area() - both;
  RC_ASSERT(iou == (either > 0 ? both / either : 0.0));
  // Side by side they touch; moved together nothing changes.
  const Eigen::Vector2d beside(a.width(), 0), step(AnyInt(-99, 99), AnyInt(-99, 99));
  RC_ASSERT(Iou(a, {a.min + beside, a.max + beside}) == 0.0);
  RC_ASSERT(Iou({a.min + step, a.max + step}, {b.min + step, b.max + step}) == iou);
}

std::vector<std::vector<Detection>> AnyFrames() {
  std::vector<std::vector<Detection>> frames(static_cast<std::size_t>(AnyInt(1, 12)));
  for (auto& frame : frames) {
    // Half the boxes stay near those of a fixed desk, so that tracks form and are lost.
    for (int i = 0; i < 4; ++i) {
      if (AnyInt(0, 3) == 0) continue;
      Detection d;
      d.class_name = i % 2 ? "book" : "laptop";
      d.kind = ClassKind::kRegular;
      d.score = 0.8;
      d.box_px.min = Eigen::Vector2d(20 + 150 * i + AnyInt(-3, 3), 100 + AnyInt(-3, 3));
      d.box_px.max = d.box_px.min + Eigen::Vector2d(90, 70);
      frame.push_back(d);
    }
    for (int i = AnyInt(0, 3); i > 0; --i) frame.push_back(AnyDetection());
  }
  return frames;
}

bool Same(const Detection& a, const Detection& b) {
  return a.class_name == b.class_name && a.kind == b.kind && a.score == b.score &&
         a.box_px.min == b.box_px.min && a.box_px.max == b.box_px.max &&
         a.compensated == b.compensated;
}

std::vector<Detection> Sorted(std::vector<Detection> list) {
  std::sort(list.begin(), list.end(), [](const Detection& a, const Detection& b) {
    const auto key = [](const Detection& d) {
      return std::make_tuple(d.box_px.min.x(), d.box_px.min.y(), d.box_px.max.x(),
                             d.box_px.max.y(), d.class_name, d.score);
    };
    return key(a) < key(b);
  });
  return list;
}

RC_GTEST_PROP(BoxTracks, DoNotDependOnTheOrderOfTheDetections, ()) {
  BoxTracks one({}, kImage), other({}, kImage);
  double t = 0;
  for (const auto& frame : AnyFrames()) {
    auto shuffled = frame;
    for (std::size_t i = shuffled.size(); i > 1; --i)
      std::swap(shuffled[i - 1],
                shuffled[static_cast<std::size_t>(AnyInt(0, static_cast<int>(i) - 1))]);
    t += kFrame_s;
    const auto a = Sorted(one.Update(t, frame)), b = Sorted(other.Update(t, shuffled));
    RC_ASSERT(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) RC_ASSERT(Same(a[i], b[i]));
  }
}

RC_GTEST_PROP(BoxTracks, MakeNothingFromNothing, ()) {
  BoxTracks tracks({}, kImage);
  for (int i = AnyInt(1, 30); i > 0; --i)
    RC_ASSERT(tracks.Update(1.0 - i * kFrame_s, {}).empty());
}

RC_GTEST_PROP(BoxTracks, LeavePerfectDetectionsAsTheyAre, ()) {
  // A desk of separate boxes that sways as one; every box is seen in every frame.
  BoxTracks tracks({}, kImage);
  const int speed_u = AnyInt(-8, 8), speed_v = AnyInt(-8, 8), count = AnyInt(1, 4);
  for (int frame = 0; frame < 10; ++frame) {
    std::vector<Detection> seen;
    for (int i = 0; i < count; ++i) {
      Detection d;
      d.class_name = i % 2 ? "book" : "laptop";
      d.kind = ClassKind::kRegular;
      d.score = 0.9;
      d.box_px.min = Eigen::Vector2d(100 + 110 * i + speed_u * frame, 200 + speed_v * frame);
      d.box_px.max = d.box_px.min + Eigen::Vector2d(90, 70);
      seen.push_back(d);
    }
    const auto answer = tracks.Update(frame * kFrame_s, seen);
    RC_ASSERT(answer.size() == seen.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      RC_ASSERT(answer[i].class_name == seen[i].class_name);
      RC_ASSERT(answer[i].score == seen[i].score);
      RC_ASSERT(answer[i].box_px.min == seen[i].box_px.min);
      RC_ASSERT(answer[i].box_px.max == seen[i].box_px.max);
      RC_ASSERT(!answer[i].compensated);
    }
  }
}

RC_GTEST_PROP(BoxTracks, GiveBoxesInsideTheImageWithScoresBetweenZeroAndOne, ()) {
  BoxTracks tracks({}, kImage);
  double t = 0;
  for (const auto& frame : AnyFrames()) {
    t += kFrame_s;
    for (const Detection& d : tracks.Update(t, frame)) {
      RC_ASSERT(kImage.Contains(d.box_px.min) && kImage.Contains(d.box_px.max));
      RC_ASSERT(!d.box_px.empty());
      RC_ASSERT(d.score >= 0 && d.score <= 1);
    }
  }
}

}  // namespace
}  // namespace slam
