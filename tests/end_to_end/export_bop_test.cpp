// An exported data set against BOP's own rules, by code that shares nothing with the exporter.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <fstream>
#include <opencv2/imgproc.hpp>

#include "eval/export/bop.h"
#include "sim/families/families.h"
#include "tests/support/image_files.h"
#include "tests/support/pipeline.h"
#include "tests/support/refusal.h"

namespace export_bop {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using pipeline::TemporaryFolder;

json ReadJson(const fs::path& file) {
  std::ifstream stream(file);
  return json::parse(stream);
}
Eigen::Matrix3d Matrix(const json& list) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 9; ++i)
    m(i / 3, i % 3) = list.at(static_cast<std::size_t>(i)).get<double>();
  return m;
}
Eigen::Vector3d Vector(const json& list) {
  return Eigen::Vector3d(list.at(0).get<double>(), list.at(1).get<double>(),
                         list.at(2).get<double>());
}

/// Vertices of an ASCII PLY with normals.
std::vector<Eigen::Vector3d> PlyVertices(const fs::path& file) {
  std::ifstream stream(file);
  std::string word;
  std::size_t count = 0;
  while (stream >> word && word != "end_header") {
    if (word == "vertex") stream >> count;
  }
  std::vector<Eigen::Vector3d> vertices(count);
  for (Eigen::Vector3d& x : vertices) {
    Eigen::Vector3d n;
    stream >> x.x() >> x.y() >> x.z() >> n.x() >> n.y() >> n.z();
    EXPECT_NEAR(n.norm(), 1, 1e-9);
    EXPECT_GT(n.dot(x), 0);  // outwards: the origin is inside
  }
  EXPECT_TRUE(stream);
  return vertices;
}

std::string Number(int n) {
  std::string text = std::to_string(n);
  return std::string(6 - text.size(), '0') + text;
}

cv::Mat Read(const fs::path& file) { return test_support::ReadImageFile(file); }

/// [x, y, last x - x, last y - y] of what is on.
json BoxOf(const cv::Mat& mask) {
  const cv::Rect box = cv::boundingRect(mask);
  return {box.x, box.y, box.width - 1, box.height - 1};
}

class BopRules {
 public:
  BopRules(const fs::path& folder, std::string scene)
      : folder_(folder), scene_(folder / "train" / std::move(scene)) {
    const json all_models = ReadJson(folder / "models/models_info.json");
    for (const auto& [id, about] : all_models.items()) {
      models_[std::stoi(id)] =
          PlyVertices(folder / ("models/obj_" + Number(std::stoi(id)) + ".ply"));
      CheckModel(std::stoi(id), about);
    }
    gt = ReadJson(scene_ / "scene_gt.json");
    info = ReadJson(scene_ / "scene_gt_info.json");
    cameras = ReadJson(scene_ / "scene_camera.json");
  }

  std::vector<std::string> Complaints() {
    for (const auto& [image, poses] : gt.items()) {
      if (!cameras.contains(image) || info.at(image).size() != poses.size())
        Say(image, "lists");
      const int im = std::stoi(image);
      const cv::Mat rgb = Read(scene_ / "rgb" / (Number(im) + ".png"));
      const cv::Mat depth = Read(scene_ / "depth" / (Number(im) + ".png"));
      if (rgb.type() != CV_8UC3 || depth.type() != CV_16UC1 || rgb.size() != depth.size()) {
        Say(image, "images");
      }
      for (std::size_t i = 0; i < poses.size(); ++i) Check(im, i, poses[i], depth);
    }
    return complaints_;
  }

  json gt, info, cameras;
  int instances = 0;

 private:
  void Say(const std::string& where, const std::string& what) {
    complaints_.push_back(where + ": " + what);
  }

  void CheckModel(int id, const json& about) {
    const auto& vertices = models_[id];
    Eigen::AlignedBox3d box;
    double diameter = 0;
    for (const auto& a : vertices) {
      box.extend(a);
      for (const auto& b : vertices) diameter = std::max(diameter, (a - b).norm());
    }
    const Eigen::Vector3d low = Vector(json{about["min_x"], about["min_y"], about["min_z"]});
    const Eigen::Vector3d size =
        Vector(json{about["size_x"], about["size_y"], about["size_z"]});
    if ((low - box.min()).norm() > 1e-3 || (size - box.sizes()).norm() > 1e-3) {
      Say("model " + std::to_string(id), "bounds");
    }
    if (box.center().norm() > 1e-3) Say("model " + std::to_string(id), "centre");
    if (std::abs(diameter - about["diameter"].get<double>()) > 1e-3) {
      Say("model " + std::to_string(id), "diameter");
    }
  }

  void Check(int im, std::size_t index, const json& pose, const cv::Mat& depth) {
    ++instances;
    const std::string where = std::to_string(im) + "/" + std::to_string(index);
    const std::string name = Number(im) + "_" + Number(static_cast<int>(index)) + ".png";
    const cv::Mat mask = Read(scene_ / "mask" / name),
                  seen = Read(scene_ / "mask_visib" / name);
    const json& about = info.at(std::to_string(im)).at(index);
    const json& camera = cameras.at(std::to_string(im));
    const Eigen::Matrix3d K = Matrix(camera["cam_K"]), R = Matrix(pose["cam_R_m2c"]);
    const Eigen::Vector3d t = Vector(pose["cam_t_m2c"]);
    if ((R * R.transpose() - Eigen::Matrix3d::Identity()).norm() > 1e-9 ||
        R.determinant() < 0) {
      Say(where, "rotation");
    }
    if (mask.type() != CV_8UC1 || seen.size() != depth.size() || mask.size() != depth.size()) {
      Say(where, "mask images");
      return;
    }
    if (cv::countNonZero(mask == 255) != cv::countNonZero(mask))
      Say(where, "mask is not 0, 255");
    if (cv::countNonZero(seen & ~mask) > 0) Say(where, "visible outside the silhouette");
    const int visible = cv::countNonZero(seen), all = about["px_count_all"];
    if (about["px_count_visib"] != visible) Say(where, "px_count_visib");
    if (all < cv::countNonZero(mask)) Say(where, "px_count_all");
    if (about["px_count_valid"] != cv::countNonZero(mask & (depth != 0))) {
      Say(where, "px_count_valid");
    }
    if (std::abs(about["visib_fract"].get<double>() - visible / static_cast<double>(all)) >
        1e-9) {
      Say(where, "visib_fract");
    }
    if (about["bbox_visib"] != BoxOf(seen)) Say(where, "bbox_visib");
    CheckProjection(where, models_.at(pose["obj_id"]), K, R, t, about["bbox_obj"],
                    depth.size());
    CheckDepth(where, pose, K, R, t, seen, depth, camera["depth_scale"]);
  }

  /// The model, moved and projected, fills bbox_obj as far as three images by three reach; its
  /// centre is inside.
  void CheckProjection(const std::string& where, const std::vector<Eigen::Vector3d>& model,
                       const Eigen::Matrix3d& K, const Eigen::Matrix3d& R,
                       const Eigen::Vector3d& t, const json& box, const cv::Size& image) {
    Eigen::AlignedBox2d bounds;
    for (const Eigen::Vector3d& x : model) bounds.extend((K * (R * x + t)).hnormalized());
    bounds = bounds.intersection({Eigen::Vector2d(-image.width, -image.height),
                                  Eigen::Vector2d(2 * image.width, 2 * image.height)});
    const Eigen::Vector2d centre = (K * t).hnormalized();
    const double x = box[0], y = box[1], w = box[2], h = box[3];
    if (centre.x() < x - 1 || centre.x() > x + w + 1 || centre.y() < y - 1 ||
        centre.y() > y + h + 1) {
      Say(where, "the centre projects outside bbox_obj");
    }
    // Pixel centres reach no further than the outline, and up to a sharp corner not quite.
    constexpr double kOver_px = 0.05, kShort_px = 4;
    const auto off = [](double beyond) { return beyond < -kOver_px || beyond > kShort_px; };
    if (off(x - bounds.min().x()) || off(y - bounds.min().y()) ||
        off(bounds.max().x() - (x + w)) || off(bounds.max().y() - (y + h))) {
      Say(where, "the model projects to other bounds than bbox_obj");
    }
  }

  /// Exact depth, scaled to millimetres, lies on the model where the object is visible.
  void CheckDepth(const std::string& where, const json& pose, const Eigen::Matrix3d& K,
                  const Eigen::Matrix3d& R, const Eigen::Vector3d& t, const cv::Mat& seen,
                  const cv::Mat& depth, double scale) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& x : models_.at(pose["obj_id"])) box.extend(x);
    int pixels = 0, off = 0;
    for (int v = 0; v < seen.rows; ++v) {
      for (int u = 0; u < seen.cols; ++u) {
        if (seen.at<uchar>(v, u) == 0 || depth.at<std::uint16_t>(v, u) == 0) continue;
        const double z = scale * depth.at<std::uint16_t>(v, u);
        const Eigen::Vector3d x_m =
            R.transpose() * (z * (K.inverse() * Eigen::Vector3d(u, v, 1)) - t);
        const double inside = (x_m.cwiseAbs() - box.max()).maxCoeff();
        ++pixels;
        off += std::abs(inside) > 0.2 ? 1 : 0;  // the depth step is 0.2 mm
      }
    }
    if (pixels == 0 || off > 0) Say(where, "depth lies off the model");
  }

  fs::path folder_, scene_;
  std::map<int, std::vector<Eigen::Vector3d>> models_;
  std::vector<std::string> complaints_;
};

class BopExport : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const pipeline::Recording exact{.frames = 2, .sensor = sim::SensorKind::kIdeal};
    pipeline::Record(sim::MakeScene("desk", 3), exact, *folder_ / "a");
    pipeline::Recording other = exact;
    other.seed = 9;
    pipeline::Record(sim::MakeScene("desk", 3), other, *folder_ / "b");
    TellAWrongFocalLength(*folder_ / "b");
    summary_ = eval::ExportBop({*folder_ / "a", *folder_ / "b"}, *folder_ / "out", {});
  }
  /// What the estimator is told of the camera errs by 3 %; the truth has the camera as it is.
  static void TellAWrongFocalLength(const fs::path& sequence) {
    fs::copy_file(sequence / "camera.yaml", sequence / "gt/camera.yaml");
    std::ifstream is(sequence / "gt/camera.yaml");
    std::ofstream told(sequence / "camera.yaml");
    for (std::string line; std::getline(is, line);) {
      if (line.rfind("fx: ", 0) == 0)
        line = "fx: " + std::to_string(1.03 * std::stod(line.substr(4)));
      told << line << "\n";
    }
  }
  static void TearDownTestSuite() { delete folder_; }
  static inline TemporaryFolder* folder_ = nullptr;
  static inline eval::ExportSummary summary_;
};

TEST_F(BopExport, KeepsEveryRuleOfTheFormat) {
  int instances = 0;
  for (const char* scene : {"000000", "000001"}) {
    BopRules rules(*folder_ / "out", scene);
    EXPECT_THAT(rules.Complaints(), testing::IsEmpty()) << scene;
    instances += rules.instances;
  }
  EXPECT_GT(instances, 20);
  EXPECT_EQ(instances, summary_.instances);
  EXPECT_EQ(summary_.images, 4);
  const json camera = ReadJson(*folder_ / "out/camera.json");
  EXPECT_EQ(camera["depth_scale"], 0.2);
  EXPECT_EQ(camera["width"], 320);
}

TEST_F(BopExport, IsSeenToBeWrongWhenItIs) {
  const auto spoilt = [&](const std::function<void(BopRules&)>& spoil) {
    BopRules rules(*folder_ / "out", "000000");
    spoil(rules);
    return rules.Complaints().size();
  };
  EXPECT_GT(spoilt([](BopRules& r) {
              json& list = r.gt["0"][0]["cam_R_m2c"];
              std::swap(list[1], list[3]);
              std::swap(list[2], list[6]);
              std::swap(list[5], list[7]);
            }),
            0u);
  EXPECT_GT(spoilt([](BopRules& r) {
              for (json& t : r.gt["0"][0]["cam_t_m2c"]) t = t.get<double>() / 1000;
            }),
            0u);
  EXPECT_GT(spoilt([](BopRules& r) { r.cameras["1"]["depth_scale"] = 1.0; }), 0u);
  EXPECT_GT(spoilt([](BopRules& r) { r.info["0"][0]["px_count_valid"] = 0; }), 0u);
}

TEST_F(BopExport, PutsTheWorldWhereTheTruthHasIt) {
  const json scene = ReadJson(*folder_ / "a/gt/scene.json");
  const json gt = ReadJson(*folder_ / "out/train/000000/scene_gt.json")["1"];
  const json camera = ReadJson(*folder_ / "out/train/000000/scene_camera.json")["1"];
  const Eigen::Matrix3d R_w2c = Matrix(camera["cam_R_w2c"]);
  const Eigen::Vector3d t_w2c = Vector(camera["cam_t_w2c"]);
  ASSERT_FALSE(gt.empty());
  for (const json& pose : gt) {
    const Eigen::Vector3d centre_w = R_w2c.transpose() * (Vector(pose["cam_t_m2c"]) - t_w2c);
    double nearest = 1e9;
    for (const json& object : scene["objects"]) {
      nearest = std::min(nearest, (1000 * Vector(object["center"]) - centre_w).norm());
    }
    EXPECT_LT(nearest, 1e-6);
  }
}

TEST_F(BopExport, GivesTheSameSceneTheSameModels) {
  const auto count =
      std::distance(fs::directory_iterator(*folder_ / "out/models"), fs::directory_iterator());
  EXPECT_EQ(count, summary_.kinds + 1);  // and models_info.json
  EXPECT_LE(summary_.kinds, static_cast<int>(sim::MakeScene("desk", 3).objects.size()));
}

TEST_F(BopExport, RefusesALens) {
  std::ofstream(*folder_ / "b/gt/camera.yaml", std::ios::app) << "k1: 0.1\n";
  const auto exporting = [] { eval::ExportBop({*folder_ / "b"}, *folder_ / "bent", {}); };
  EXPECT_THAT(test_support::RefusalOf(exporting), testing::HasSubstr("distortion"));
}

}  // namespace
}  // namespace export_bop
