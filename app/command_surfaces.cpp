#include <cstdio>
#include <filesystem>

#include "app/app.h"
#include "app/console/console.h"
#include "app/eval/eval_modes.h"
#include "app/options/surfaces_option.h"
#include "eval/surfaces/draw_surfaces.h"
#include "eval/surfaces/find_surfaces.h"
#include "io/image/encode_png.h"
#include "io/output_file.h"

namespace app {
namespace {

struct SurfacesArguments {
  std::string sequence, output, camera, picture, registration;
  double min_area_m2 = 0.15;
  bool force = false;
};

int RunSurfaces(const SurfacesArguments& arguments, bool quiet) {
  const io::OutputRules rules{
      .force = arguments.force,
      .inputs = {arguments.sequence, arguments.camera, arguments.registration}};
  io::RefuseSameFile({arguments.output, arguments.picture});
  const io::OutputFile output(arguments.output, rules);
  std::optional<io::OutputFile> picture;
  if (!arguments.picture.empty()) picture.emplace(arguments.picture, rules);
  const eval::Sequence sequence = eval::ReadSequence(arguments.sequence);
  PrintWarnings(sequence.warnings, sequence.folder);
  const eval::DepthViews views =
      ViewsOf(sequence, {}, {arguments.camera, arguments.registration});
  PassProgress progress(quiet);
  eval::SurfaceFile file = eval::FindSurfaces(
      views, arguments.min_area_m2,
      [&](const char* pass, int done, int total) { progress.Update(pass, done, total); });
  progress.End();
  if (file.surfaces.empty()) {
    std::fprintf(
        stderr,
        "pas: nothing is written, because no surface of %g m2 or more was found in %zu "
        "frames; does their depth measure anything, and is --min-area too large?\n",
        arguments.min_area_m2, views.size());
    return kFailure;
  }
  file.sequence = arguments.sequence;
  std::vector<io::OutputFile::Content> contents{{&output, eval::SurfacesText(file)}};
  if (picture) {
    contents.push_back({&*picture, io::EncodePng(eval::DrawSurfaces(file, views))});
  }
  io::OutputFile::WriteTogether(contents);
  if (quiet) return kDone;
  double area_m2 = 0.0;
  for (const eval::Surface& surface : file.surfaces) area_m2 += eval::AreaOf(surface);
  std::printf("%zu surfaces of %.2f m2 in all, from %zu frames; wrote %s\n",
              file.surfaces.size(), area_m2, views.size(), arguments.output.c_str());
  if (!arguments.picture.empty()) std::printf("wrote %s\n", arguments.picture.c_str());
  return kDone;
}

}  // namespace

void AddSurfacesCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  CLI::App* surfaces = pas.add_subcommand(
      "surfaces",
      "Finds the large flat surfaces of a recording: its depth is laid together with its own\n"
      "camera truth (groundtruth.txt). A file to be looked at and edited by hand, then given\n"
      "to `pas eval RUN --surfaces FILE`, which scores plane extraction and association on\n"
      "any RGB-D recording with camera truth (docs/surfaces.md). Writes\n"
      "nothing, with exit code 1, when there is no such surface.");
  auto arguments = std::make_shared<SurfacesArguments>();
  surfaces->add_option("SEQ", arguments->sequence, "Sequence folder with groundtruth.txt")
      ->required()
      ->type_name("DIR");
  surfaces->add_option("-o,--output", arguments->output, "File to write (YAML)")
      ->required()
      ->type_name("FILE");
  surfaces
      ->add_option("--camera", arguments->camera,
                   "tum1, tum2, tum3 or a camera.yaml; default: SEQ/camera.yaml")
      ->type_name("CAMERA");
  surfaces
      ->add_option("--picture", arguments->picture,
                   "Also draw a page (PNG): plan, list, frames with tinted surfaces and ids")
      ->type_name("FILE");
  surfaces
      ->add_option("--min-area", arguments->min_area_m2,
                   "Square metres; smaller surfaces are left out")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  AddRegistrationOption(*surfaces, arguments->registration);
  surfaces->add_flag("--force", arguments->force, "Replace files that exist");
  surfaces->callback([arguments, &globals, &exit_code] {
    exit_code = RunSurfaces(*arguments, globals.quiet);
  });
}

}  // namespace app
