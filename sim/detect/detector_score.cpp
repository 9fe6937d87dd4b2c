#include "sim/detect/detector_score.h"

#include <algorithm>
#include <cstdio>

namespace sim {
namespace {

double Ratio(double a, double b) { return b > 0 ? a / b : 0.0; }

void AddTarget(DetectorFigures& figures, bool found, double iou, bool right, bool begins) {
  ++figures.targets;
  figures.found += found ? 1 : 0;
  figures.right_class += right ? 1 : 0;
  figures.iou_sum += found ? iou : 0.0;
  figures.runs += begins ? 1 : 0;
}

}  // namespace

double DetectorFigures::Recall() const {
  return Ratio(static_cast<double>(found), static_cast<double>(targets));
}
double DetectorFigures::MeanIou() const { return Ratio(iou_sum, static_cast<double>(found)); }
double DetectorFigures::RightShare() const {
  return Ratio(static_cast<double>(right_class), static_cast<double>(found));
}
double DetectorFigures::MeanMissRun() const {
  return Ratio(static_cast<double>(targets - found), static_cast<double>(runs));
}
double DetectorFigures::IndependentMissRun() const {
  return targets > found ? Ratio(1.0, Recall()) : 0.0;
}

double DetectorScore::Precision() const {
  return Ratio(static_cast<double>(all_.found), static_cast<double>(boxes_));
}

double BoxIou(const PixelBox& a, const PixelBox& b) {
  const double width = std::min(a.x1, b.x1) - std::max(a.x0, b.x0);
  const double height = std::min(a.y1, b.y1) - std::max(a.y0, b.y0);
  if (!(width > 0 && height > 0)) return 0;
  const double common = width * height;
  const auto area = [](const PixelBox& box) { return (box.x1 - box.x0) * (box.y1 - box.y0); };
  return common / (area(a) + area(b) - common);
}

void DetectorScore::Add(const std::vector<DetectionTarget>& targets,
                        const std::vector<Detection>& detections) {
  struct Match {
    double iou = 0;
    bool right = false;
  };
  std::vector<Match> best(targets.size());
  for (const Detection& detection : detections) {
    ++boxes_;
    double iou = 0;
    std::size_t at = 0;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const double overlap = BoxIou(targets[i].box, detection.box);
      if (overlap > iou) iou = overlap, at = i;
    }
    if (iou < kMinIou) {
      ++phantoms_;
    } else if (best[at].iou > 0) {
      ++doubles_;  // detections come by falling score: the first counts
    } else {
      best[at] = {iou, detection.class_name == targets[at].class_name};
    }
  }
  std::map<std::uint64_t, bool> missing;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const bool found = best[i].iou > 0;
    const auto before = missing_.find(targets[i].key);
    const bool begins = !found && (before == missing_.end() || !before->second);
    missing[targets[i].key] = !found;
    const double pixels = targets[i].pixels / (scale_ * scale_);
    const std::size_t size = pixels < kSmall ? 0 : pixels < kMedium ? 1 : 2;
    AddTarget(all_, found, best[i].iou, best[i].right, begins);
    AddTarget(by_size_[size], found, best[i].iou, best[i].right, begins);
  }
  missing_ = std::move(missing);
}

std::string ScoreTable(const DetectorScore& score) {
  std::string text =
      "          targets  recall  right class  mean IoU  miss run  (independent)\n";
  const auto line = [&](const char* name, const DetectorFigures& f) {
    char row[128];
    std::snprintf(row, sizeof row, "  %-7s %7ld  %6.3f  %11.3f  %8.3f  %8.1f  %13.1f\n", name,
                  f.targets, f.Recall(), f.RightShare(), f.MeanIou(), f.MeanMissRun(),
                  f.IndependentMissRun());
    text += row;
  };
  line("all", score.all());
  line("small", score.by_size()[0]);
  line("medium", score.by_size()[1]);
  line("large", score.by_size()[2]);
  char row[128];
  std::snprintf(row, sizeof row, "  precision %.3f: of %ld boxes %ld doubles, %ld phantoms\n",
                score.Precision(), score.boxes(), score.doubles(), score.phantoms());
  return text + row;
}

}  // namespace sim
