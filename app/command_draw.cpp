#include <cstdio>

#include "app/app.h"
#include "app/console/console.h"
#include "eval/draw/draw_run.h"

namespace app {
namespace {

struct DrawArguments {
  std::string run, output, truth, camera;
  int frames = 12;
  bool force = false;
};

int RunDraw(const DrawArguments& arguments, bool quiet) {
  eval::DrawOptions options;
  options.frames = arguments.frames;
  options.camera = arguments.camera;
  options.warn = PrintWarning;
  options.output = arguments.output;
  options.force = arguments.force;
  if (!arguments.truth.empty()) options.truth = arguments.truth;
  const eval::Drawing drawing = eval::DrawRun(arguments.run, options);
  eval::WritePictures(drawing.pictures, arguments.output, arguments.force);
  if (quiet) return kDone;
  for (const eval::Picture& picture : drawing.pictures) {
    std::printf("%s\n", (std::filesystem::path(arguments.output) / picture.name).c_str());
  }
  for (const std::string& note : drawing.notes) std::printf("%s\n", note.c_str());
  return kDone;
}

}  // namespace

void AddDrawCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  CLI::App* draw = pas.add_subcommand(
      "draw",
      "Draws a run into pictures: contact_sheet.png (frames with their planes, map ids and\n"
      "decisions), top_view.png (estimated over true map, both camera paths, heights of level\n"
      "planes in mm) and, with a true trajectory, error_over_time.png (position in mm,\n"
      "rotation in degrees, lost spans).\n"
      "Run `pas slam --save-segmentation` for tinted segments; without it planes are mere\n"
      "outlines.");
  auto arguments = std::make_shared<DrawArguments>();
  draw->add_option("RUN", arguments->run, "Folder written by `pas slam`")
      ->required()
      ->type_name("DIR");
  draw->add_option("-o,--output", arguments->output, "Folder for the pictures")
      ->required()
      ->type_name("DIR");
  draw->add_option("--frames", arguments->frames, "Frames on the contact sheet")
      ->capture_default_str()
      ->check(CLI::Range(1, 120));
  draw->add_option("--truth", arguments->truth,
                   "Sequence with the images and the truth; default: the one named in run.json")
      ->type_name("SEQ");
  draw->add_option(
          "--camera", arguments->camera,
          "tum1, tum2, tum3 or a camera.yaml; default: SEQ/camera.yaml, else the camera of "
          "the run")
      ->type_name("CAMERA");
  draw->add_flag("--force", arguments->force, "Replace pictures in a folder that exists");
  draw->callback(
      [arguments, &globals, &exit_code] { exit_code = RunDraw(*arguments, globals.quiet); });
}

}  // namespace app
