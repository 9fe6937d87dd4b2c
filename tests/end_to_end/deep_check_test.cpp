// `pas check --deep` on sequences as `pas sim` writes them: it is silent about clean ones of
// every family, sensor and lens, and finds what truth is most often spoilt by.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "eval/check/check_folder.h"
#include "io/sha256.h"
#include "sim/families/families.h"
#include "sim/sensor/read_sensor.h"
#include "tests/support/file_contents.h"
#include "tests/support/image_files.h"
#include "tests/support/pipeline.h"

namespace {

namespace fs = std::filesystem;
using pipeline::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;

constexpr int kWidth = 160, kHeight = 120, kFrames = 9;
const sim::Lens kBarrel{.k1 = -0.15, .k2 = 0.05, .p1 = 0.002, .p2 = -0.001};

/// Three frames a second, or the camera would hardly move in so few; no prints, which take
/// time.
void Record(const std::string& family, const sim::Sensor& sensor, const sim::Lens& lens,
            const fs::path& folder) {
  sim::SequenceOptions options;
  options.rig.camera = sim::WithLens(sim::Resize(sim::Camera{}, kWidth, kHeight), lens);
  options.rig.camera.fps = 3;
  options.rig.sensor = sensor;
  options.frames = kFrames;
  options.threads = 2;
  options.version = "test";
  sim::WriteSequence(sim::MakeScene(family, 3, {{"texture", 0}}), options, folder);
}

std::string Faults(const fs::path& folder) {
  std::string text;
  for (const eval::Fault& fault : eval::CheckFolder(folder, true).faults) {
    text += eval::Describe(fault) + "\n";
  }
  return text;
}

/// Makes the manifest tell the hashes of the files as they are now.
void Rehash(const fs::path& folder) {
  std::ifstream in(folder / "manifest.json");
  nlohmann::ordered_json manifest = nlohmann::ordered_json::parse(in);
  for (auto& [file, sum] : manifest["sha256"].items()) {
    sum = io::Sha256OfFile(folder / file);
  }
  std::ofstream(folder / "manifest.json") << manifest.dump(1);
}

/// Replaces each image of a folder by what `change` makes of it.
void ChangeImages(const fs::path& folder,
                  const std::function<cv::Mat1w(const cv::Mat1w&)>& change) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const cv::Mat1w image = test_support::ReadImageFile(entry.path());
    test_support::WriteImageFile(entry.path(), change(image));
  }
}

TEST(CheckDeep, IsSilentAboutCleanSequencesOfEveryFamily) {
  const sim::SensorKind sensors[] = {sim::SensorKind::kIdeal, sim::SensorKind::kKinect1Clean,
                                     sim::SensorKind::kAzure, sim::SensorKind::kD435};
  std::size_t i = 0;
  for (const sim::Family& family : sim::Families()) {
    const TemporaryFolder folder;
    Record(family.name, sensors[i % 4], i % 2 == 0 ? kBarrel : sim::Lens{}, folder / "seq");
    EXPECT_EQ(Faults(folder / "seq"), "") << family.name << " with sensor " << i % 4;
    ++i;
  }
}

TEST(CheckDeep, IsSilentAboutSensorsOfTheUsersOwnAndAboutClocksThatErr) {
  sim::Sensor beside = sim::SensorKind::kIdeal, late = sim::SensorKind::kKinect1Clean;
  beside.calibration.registration_px = 1;
  late.timing.stamp_jitter_s = 0.008;
  const sim::Sensor noisy =
      sim::ParseSensor("base: kinect1-clean\nnoise_scale: 2\n", "noisy.yaml");
  for (const sim::Sensor& sensor : {beside, late, noisy}) {
    const TemporaryFolder folder;
    Record("desk", sensor, {}, folder / "seq");
    EXPECT_EQ(Faults(folder / "seq"), "") << sensor.name;
  }
}

struct Recorded {
  std::string family;
  sim::SensorKind sensor;
  bool lens;
};

/// The name of a test must not hold an address.
void PrintTo(const Recorded& recorded, std::ostream* out) { *out << recorded.family; }

sim::Camera CameraOf(const Recorded& recorded) {
  return sim::WithLens(sim::Resize(sim::Camera{}, kWidth, kHeight),
                       recorded.lens ? kBarrel : sim::Lens{});
}

void LengthenDepth(const fs::path& folder, const sim::Camera& camera) {
  ChangeImages(folder / "depth", [&](const cv::Mat1w& depth) {
    cv::Mat1w longer = depth.clone();
    for (int v = 0; v < depth.rows; ++v) {
      for (int u = 0; u < depth.cols; ++u) {
        longer(v, u) = cv::saturate_cast<ushort>(depth(v, u) * camera.Ray(u, v).norm());
      }
    }
    return longer;
  });
}

void ShiftIds(const fs::path& folder) {
  for (const char* ids : {"gt/plane_id", "gt/object_id"}) {
    ChangeImages(folder / ids, [](const cv::Mat1w& image) {
      cv::Mat1w shifted = image.clone();
      image.rowRange(0, image.rows - 1).copyTo(shifted.rowRange(1, image.rows));
      return shifted;
    });
  }
}

/// The inverse rotation with the same position: a forgotten transpose.
void TransposePoses(const fs::path& folder) {
  std::istringstream in(test_support::ReadText(folder / "groundtruth.txt"));
  std::ostringstream out;
  out.precision(17);
  for (std::string line; std::getline(in, line);) {
    std::istringstream numbers(line);
    std::string stamp;
    double x = 0, y = 0, z = 0, qx = 0, qy = 0, qz = 0, qw = 0;
    if (line.starts_with('#') || !(numbers >> stamp >> x >> y >> z >> qx >> qy >> qz >> qw)) {
      out << line << '\n';
      continue;
    }
    out << stamp << ' ' << x << ' ' << y << ' ' << z << ' ' << -qx << ' ' << -qy << ' ' << -qz
        << ' ' << qw << '\n';
  }
  std::ofstream(folder / "groundtruth.txt") << out.str();
}

void MovePrincipalPoint(const fs::path& folder) {
  std::string text = test_support::ReadText(folder / "camera.yaml");
  const std::size_t at = text.find("cx: ");
  const double cx = std::stod(text.substr(at + 4));
  text.replace(at, text.find('\n', at) - at, "cx: " + std::to_string(cx + 1));
  std::ofstream(folder / "camera.yaml") << text;
}

// Depth that bends, comes late and lies beside its colour is not a fault of the truth.
TEST(CheckDeep, IsSilentAboutTheFirstKinectAsRecorded) {
  for (const char* family : {"desk", "room", "stack"}) {
    const TemporaryFolder folder;
    pipeline::Record(sim::MakeScene(family, 4, {{"texture", 0}}),
                     {.frames = 24, .sensor = sim::SensorKind::kKinect1}, folder / "seq");
    EXPECT_EQ(Faults(folder / "seq"), "") << family;
    TransposePoses(folder / "seq");
    Rehash(folder / "seq");
    EXPECT_THAT(Faults(folder / "seq"), HasSubstr("depth is off what the truth predicts"));
  }
}

class PlantedFaults : public testing::TestWithParam<Recorded> {};

TEST_P(PlantedFaults, AreFoundAndNamed) {
  const TemporaryFolder folder;
  Record(GetParam().family, GetParam().sensor, GetParam().lens ? kBarrel : sim::Lens{},
         folder / "seq");
  const auto faults_after = [&](const std::string& name, const auto& plant) {
    fs::copy(folder / "seq", folder / name, fs::copy_options::recursive);
    plant(folder / name);
    Rehash(folder / name);
    return Faults(folder / name);
  };
  const sim::Camera camera = CameraOf(GetParam());
  EXPECT_THAT(faults_after("depth along the ray",
                           [&](const fs::path& at) { LengthenDepth(at, camera); }),
              HasSubstr("length of the ray"));
  EXPECT_THAT(faults_after("shifted ids", ShiftIds),
              AllOf(HasSubstr("outside the face"), HasSubstr("shifted by (0, 1) px")));
  EXPECT_THAT(
      faults_after("transposed rotations", TransposePoses),
      AllOf(HasSubstr("outside the face"), HasSubstr("depth is off what the truth predicts")));
  EXPECT_THAT(faults_after("principal point", MovePrincipalPoint),
              HasSubstr("outside the face"));
}

INSTANTIATE_TEST_SUITE_P(Sequences, PlantedFaults,
                         testing::Values(Recorded{"desk", sim::SensorKind::kKinect1Clean, true},
                                         Recorded{"stack", sim::SensorKind::kAzure, false},
                                         Recorded{"office", sim::SensorKind::kD435, true}),
                         [](const auto& at) { return at.param.family; });

}  // namespace
