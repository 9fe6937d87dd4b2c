#include "eval/surfaces/find_surfaces.h"

#include <algorithm>

#include "eval/surfaces/cut_sheet.h"
#include "eval/surfaces/depth_error.h"
#include "eval/surfaces/grow_planes.h"
#include "eval/surfaces/local_normals.h"
#include "eval/surfaces/outline.h"
#include "eval/surfaces/sheet.h"
#include "eval/surfaces/surfel_cloud.h"

namespace eval {
namespace {

constexpr int kStride = 2;                  // of the pixels that are taken, each way
constexpr std::size_t kMaxViews = 300;      // of a long recording, evenly: more tell little new
constexpr std::size_t kMaxNoiseViews = 15;  // that the noise is measured in
constexpr double kMinNoise_per_m = 1e-4;    // rounding to a fifth of a millimetre, at 1 m
// Of the least area, that a patch must have to be joined.
constexpr double kMinPatchShare = 0.3;

/// Indices of at most `count` views, evenly.
std::vector<std::size_t> Evenly(std::size_t views, std::size_t count) {
  const std::size_t step = (views + count - 1) / count;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < views; i += step) chosen.push_back(i);
  return chosen;
}

}  // namespace

double MeasureNoise(const DepthViews& views) {
  std::vector<double> noise_per_m;
  for (const std::size_t i : Evenly(views.size(), kMaxNoiseViews)) {
    const double noise = NoiseOf(FitLocalNormals(views.Read(i).depth_m, views.rays(), kStride));
    if (noise > 0) noise_per_m.push_back(noise);
  }
  if (noise_per_m.empty()) return kMinNoise_per_m;
  std::sort(noise_per_m.begin(), noise_per_m.end());
  return std::max(kMinNoise_per_m, noise_per_m[noise_per_m.size() / 2]);
}

SurfaceFile FindSurfaces(const DepthViews& views, double min_area_m2,
                         const TellProgress& tell) {
  SurfaceFile file;
  file.min_area_m2 = min_area_m2;
  file.noise_per_m = MeasureNoise(views);
  const std::vector<std::size_t> chosen = Evenly(views.size(), kMaxViews);
  const auto for_each_view = [&](const char* pass, const auto& use) {
    int done = 0;
    for (const std::size_t i : chosen) {
      const DepthView view = views.Read(i);
      use(view, FitLocalNormals(view.depth_m, views.rays(), kStride));
      if (tell) tell(pass, ++done, int(chosen.size()));
    }
  };

  // Planes, from what all views saw together.
  SurfelCloud cloud;
  for_each_view("finding planes", [&](const DepthView& view, const LocalNormals& local) {
    cloud.Add(view, views.rays(), local, file.noise_per_m);
  });
  const std::vector<PlanePatch> patches = GrowPlanes(
      DrawnTogether(cloud.Surfels(), file.noise_per_m), kMinPatchShare * min_area_m2);

  // Pixels on the planes, and from them the surfaces.
  std::vector<Sheet> sheets;
  sheets.reserve(patches.size());
  for (const PlanePatch& patch : patches) sheets.push_back(SheetOver(patch));
  for_each_view("outlining them", [&](const DepthView& view, const LocalNormals& local) {
    AddToSheets(view, views.rays(), local, kStride, file.noise_per_m, sheets);
  });
  for (Sheet& sheet : sheets) {
    MeanOverHits(sheet);
    for (const CellMask& mask : CutSheet(sheet, min_area_m2, file.noise_per_m)) {
      file.surfaces.push_back(OutlinedSurface(sheet, mask));
    }
  }
  std::stable_sort(file.surfaces.begin(), file.surfaces.end(),
                   [](const Surface& a, const Surface& b) { return AreaOf(a) > AreaOf(b); });
  for (std::size_t i = 0; i < file.surfaces.size(); ++i) file.surfaces[i].id = int(i) + 1;
  return file;
}

}  // namespace eval
