#include "app/options/surfaces_option.h"

#include <fmt/format.h>

#include <filesystem>

#include "eval/draw/draw_camera.h"
#include "eval/surfaces/draw_surfaces.h"
#include "eval/surfaces/label_surfaces.h"
#include "io/image/encode_png.h"
#include "io/output_folder.h"

namespace app {
namespace {

constexpr std::size_t kWorstFrames = 12;               // that are drawn
constexpr const char* kFirstPicture = "worst_01.png";  // marks a folder of pictures
constexpr const char* kTruth = "true";
constexpr const char* kTruthOnDepth = "true-on-depth";

void WriteWorstFrames(io::OutputFolder& folder, const eval::SurfaceScore& score,
                      const eval::Run& run, const eval::DepthViews& views,
                      const eval::LabelView& label) {
  int rank = 0;
  for (const eval::FrameWholeness& frame : eval::WorstFrames(score, kWorstFrames)) {
    const std::string name = fmt::format("worst_{:02}.png", ++rank);
    folder.Write(name, io::EncodePng(eval::DrawCutSurfaces(label(views.Read(frame.view)), run,
                                                           views, frame)));
  }
  folder.Commit();
}

}  // namespace

void AddRegistrationOption(CLI::App& command, std::string& registration) {
  command
      .add_option("--depth-registration", registration,
                  "YAML file with the intrinsics of the depth and of the colour camera and the "
                  "way from one to the other, for a recording whose depth is not laid on "
                  "colour (docs/surfaces.md). pas slam has no such option: it takes depth that "
                  "is laid on colour")
      ->type_name("FILE");
}

eval::DepthViews ViewsOf(const eval::Sequence& sequence, const eval::Run& run,
                         const DepthCamera& choice) {
  auto camera = eval::ChooseCamera(choice.camera, sequence, run);
  std::optional<eval::DepthRegistration> registration;
  if (!choice.registration.empty()) {
    registration = eval::ReadDepthRegistration(choice.registration);
  }
  if (!camera) {
    throw io::InputError(sequence.folder.string(),
                         "has no camera.yaml; give a camera with --camera tum1|tum2|tum3|FILE");
  }
  return {sequence, *camera, registration};
}

void AddSurfacesOption(CLI::App& command, SurfacesOption& option) {
  CLI::Option* file = command.add_option(
      "--surfaces", option.file,
      "File of `pas surfaces`: also score segments and landmarks on the large surfaces of a "
      "recording without planes of truth; needs RUN/segmentation/. `true`: on the true planes "
      "of a simulated sequence, as far as they are as large; `true-on-depth`: on those of "
      "their pixels whose depth lies on the plane");
  command
      .add_option("--surface-pictures", option.pictures,
                  "Folder for pictures of the worst frames: surfaces, and what the run made of "
                  "them")
      ->needs(file)
      ->type_name("DIR");
  command
      .add_option("--surface-min-area", option.min_area_m2,
                  "With --surfaces true: square metres that all frames together must show")
      ->needs(file)
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  command
      .add_option("--camera", option.camera.camera,
                  "tum1, tum2, tum3 or a camera.yaml; default: SEQ/camera.yaml, else the "
                  "camera of the run")
      ->needs(file)
      ->type_name("CAMERA");
  AddRegistrationOption(command, option.camera.registration);
}

eval::LabelView LabelsOf(const std::string& file, double min_area_m2,
                         const eval::Sequence& sequence, const eval::DepthViews& views) {
  if (file == kTruth || file == kTruthOnDepth) {
    const auto pixels =
        file == kTruth ? eval::TruePixels::kWithDepth : eval::TruePixels::kDepthOnPlane;
    return [&views, labeller = eval::TrueSurfaceLabeller(sequence, views, min_area_m2, pixels)](
               const eval::DepthView& view) { return labeller.Label(view, views.rays()); };
  }
  return [&views, labeller = eval::SurfaceLabeller(eval::ReadSurfaces(file))](
             const eval::DepthView& view) { return labeller.Label(view, views.rays()); };
}

std::optional<eval::SurfaceScore> ScoreOnSurfaces(const eval::Run& run,
                                                  const eval::Sequence& sequence,
                                                  const SurfacesOption& option, bool force) {
  if (option.file.empty()) return std::nullopt;
  std::optional<io::OutputFolder> pictures;  // refused before the work
  if (!option.pictures.empty()) pictures.emplace(option.pictures, kFirstPicture, force);
  const eval::DepthViews views = ViewsOf(sequence, run, option.camera);
  const eval::LabelView label = LabelsOf(option.file, option.min_area_m2, sequence, views);
  eval::SurfaceScore score = eval::ScoreSurfaces(run, views, label);
  if (pictures) WriteWorstFrames(*pictures, score, run, views, label);
  return score;
}

}  // namespace app
