#include <fmt/core.h>

#include <opencv2/core/utility.hpp>

#include "app/app.h"
#include "app/console/console.h"
#include "io/folder_kind.h"
#include "io/input_error.h"
#include "io/output_file.h"
#include "slam/features/point_features.h"
#include "slam/input/camera_reader.h"
#include "slam/input/sequence_reader.h"
#include "slam/places/train_vocabulary.h"
#include "slam/run/config.h"

namespace app {
namespace {

struct VocabularyArguments {
  std::vector<std::string> sequences;
  std::string output, camera;
  int every = 10;
  bool force = false;
  slam::TrainingConfig training;
};

/// Descriptors of every n-th image, by image.
std::vector<std::vector<slam::Descriptor>> Describe(const VocabularyArguments& arguments,
                                                    bool quiet) {
  std::vector<std::vector<slam::Descriptor>> images;
  const slam::Config config;
  Progress progress("sequences", static_cast<int>(arguments.sequences.size()), quiet);
  int done = 0;
  for (const std::string& sequence : arguments.sequences) {
    const slam::Camera camera = slam::ChooseCamera(arguments.camera, sequence).camera;
    slam::SequenceReader reader(sequence, camera, {.prefetch = false});
    for (const std::string& warning : reader.warnings()) PrintWarning(warning);
    for (int i = 0; i < reader.size(); i += arguments.every) {
      const slam::RecordedFrame frame = reader.Read(i);
      images.emplace_back();
      for (const slam::PointFeature& feature :
           slam::ExtractPointFeatures(frame.gray, camera, config.point_features)) {
        images.back().push_back(feature.descriptor);
      }
    }
    progress.Update(++done);
  }
  return images;
}

int TrainWords(const VocabularyArguments& arguments, bool quiet) {
  std::vector<std::filesystem::path> inputs(arguments.sequences.begin(),
                                            arguments.sequences.end());
  if (!arguments.camera.empty()) inputs.emplace_back(arguments.camera);
  const io::OutputFile output(arguments.output, {.force = arguments.force, .inputs = inputs});
  for (const std::string& sequence : arguments.sequences) io::RequireRecording(sequence);
  cv::setNumThreads(1);
  const auto images = Describe(arguments, quiet);
  std::size_t descriptors = 0;
  for (const auto& image : images) descriptors += image.size();
  if (descriptors == 0) {
    throw io::InputError("pas vocabulary", "no image of these sequences has a feature");
  }
  slam::Vocabulary vocabulary = [&] {
    Progress progress("words", 100, quiet);
    return slam::TrainVocabulary(images, arguments.training, [&](double part) {
      progress.Update(static_cast<int>(100 * part));
    });
  }();
  const std::string bytes = vocabulary.Bytes();
  output.Write(bytes);
  if (!quiet) {
    fmt::print("{}: {} words from {} descriptors of {} images, {} bytes\n", arguments.output,
               vocabulary.words(), descriptors, images.size(), bytes.size());
  }
  return kDone;
}

}  // namespace

void AddVocabularyCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  CLI::App* command = pas.add_subcommand(
      "vocabulary",
      "Train the binary words by which a lost camera finds its place. Some come with pas\n"
      "slam, built into the program: no command reads the file. It takes the place of\n"
      "slam/places/orb_words.bin in the source; build the program anew then.");
  auto arguments = std::make_shared<VocabularyArguments>();
  command->add_option("SEQ", arguments->sequences, "Sequences whose images to learn from")
      ->required();
  command->add_option("-o,--output", arguments->output, "File to write")->required();
  command->add_flag("--force", arguments->force, "Replace the output when it exists");
  command->add_option("--camera", arguments->camera,
                      "tum1 | tum2 | tum3 | a camera.yaml; default: SEQ/camera.yaml");
  command->add_option("--every", arguments->every, "Learn from every n-th frame")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--branching", arguments->training.branching, "Children of a node")
      ->check(CLI::Range(2, 256))
      ->capture_default_str();
  command->add_option("--depth", arguments->training.depth, "Levels of the tree")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  command->add_option("--seed", arguments->training.seed, "Of the first centres")
      ->capture_default_str();
  command->callback(
      [arguments, &globals, &exit_code] { exit_code = TrainWords(*arguments, globals.quiet); });
}

}  // namespace app
