// An exported data set against COCO's own rules, by code that shares nothing with the exporter.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgproc.hpp>
#include <set>

#include "eval/export/coco.h"
#include "sim/families/families.h"
#include "tests/support/image_files.h"
#include "tests/support/pipeline.h"
#include "tests/support/refusal.h"

namespace export_coco {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using pipeline::TemporaryFolder;

json ReadJson(const fs::path& file) {
  std::ifstream stream(file);
  return json::parse(stream);
}

/// The mask of compressed counts, after the decoder of the format's API; empty when they do not
/// fill the image exactly.
cv::Mat1b Decode(const std::string& text, int height, int width) {
  std::vector<long> runs;
  for (std::size_t at = 0; at < text.size();) {
    long value = 0;
    int shift = 0;
    bool more = true;
    while (more && at < text.size()) {
      const long c = text[at++] - 48;
      value |= (c & 0x1f) << shift;
      more = (c & 0x20) != 0;
      shift += 5;
      if (!more && (c & 0x10) != 0) value |= -1L << shift;
    }
    if (runs.size() > 2) value += runs[runs.size() - 2];
    runs.push_back(value);
  }
  cv::Mat1b mask(height, width, uchar{0});
  long pixel = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (long k = 0; k < runs[i]; ++k, ++pixel) {
      if (pixel >= static_cast<long>(height) * width) return {};
      if (i % 2 == 1)
        mask(static_cast<int>(pixel % height), static_cast<int>(pixel / height)) = 1;
    }
  }
  return pixel == static_cast<long>(height) * width ? mask : cv::Mat1b();
}

template <typename... Part>
std::string Say(const Part&... part) {
  std::ostringstream text;
  (text << ... << part);
  return text.str();
}

/// Everything in the folder that breaks a rule of the format.
std::vector<std::string> Complaints(const fs::path& folder, const json& root) {
  std::vector<std::string> bad;
  const auto require = [&](const json& object, std::initializer_list<const char*> keys) {
    for (const char* key : keys) {
      if (!object.contains(key)) bad.push_back(Say("no key ", key, " in ", object.dump()));
    }
  };
  require(root, {"info", "licenses", "images", "annotations", "categories"});
  std::set<int> categories, annotations;
  std::map<int, json> images;
  for (const json& category : root["categories"]) {
    require(category, {"id", "name", "supercategory"});
    if (!categories.insert(category["id"].get<int>()).second) bad.push_back("category twice");
  }
  for (const json& image : root["images"]) {
    require(image, {"id", "width", "height", "file_name"});
    if (!images.emplace(image["id"].get<int>(), image).second) bad.push_back("image twice");
    const cv::Mat pixels =
        test_support::ReadImageFile(folder / "images" / image["file_name"].get<std::string>());
    if (pixels.cols != image["width"] || pixels.rows != image["height"]) {
      bad.push_back(Say("size of ", image["file_name"]));
    }
  }
  std::map<int, cv::Mat1b> taken;
  for (const json& a : root["annotations"]) {
    require(a, {"id", "image_id", "category_id", "segmentation", "area", "bbox", "iscrowd"});
    const int id = a["id"];
    if (id < 1 || !annotations.insert(id).second) bad.push_back(Say("annotation id ", id));
    if (categories.count(a["category_id"]) == 0) bad.push_back(Say("category of ", id));
    if (images.count(a["image_id"]) == 0) {
      bad.push_back(Say("image of ", id));
      continue;
    }
    const json& image = images.at(a["image_id"]);
    const int height = image["height"], width = image["width"];
    if (a["segmentation"]["size"] != json{height, width}) bad.push_back(Say("size of ", id));
    const cv::Mat1b mask = Decode(a["segmentation"]["counts"], height, width);
    if (mask.empty()) {
      bad.push_back(Say("runs of ", id, " do not fill the image"));
      continue;
    }
    const cv::Rect box = cv::boundingRect(mask);
    if (a["bbox"] != json{box.x, box.y, box.width, box.height})
      bad.push_back(Say("box of ", id));
    if (a["area"] != cv::countNonZero(mask)) bad.push_back(Say("area of ", id));
    cv::Mat1b& all = taken[a["image_id"]];
    if (all.empty()) all = cv::Mat1b(height, width, uchar{0});
    if (cv::countNonZero(all & mask) > 0) bad.push_back(Say("overlap of ", id));
    all |= mask;
  }
  return bad;
}

class CocoExport : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    scene_ = new sim::Scene(sim::MakeScene("desk", 3));
    pipeline::Record(*scene_, {.frames = 3}, *folder_ / "a");
    pipeline::Record(*scene_, {.frames = 2, .seed = 9}, *folder_ / "b");
    summary_ = eval::ExportCoco({*folder_ / "a", *folder_ / "b"}, *folder_ / "out", {});
    root_ = new json(ReadJson(*folder_ / "out/annotations/instances.json"));
  }
  static void TearDownTestSuite() {
    delete folder_;
    delete scene_;
    delete root_;
  }
  static inline TemporaryFolder* folder_ = nullptr;
  static inline sim::Scene* scene_ = nullptr;
  static inline json* root_ = nullptr;
  static inline eval::ExportSummary summary_;
};

TEST_F(CocoExport, KeepsEveryRuleOfTheFormat) {
  EXPECT_THAT(Complaints(*folder_ / "out", *root_), testing::IsEmpty());
  EXPECT_EQ(summary_.images, 5);
  EXPECT_EQ((*root_)["images"].size(), 5u);
  EXPECT_GT(summary_.instances, 20);
}

TEST_F(CocoExport, MasksAreThePixelsOfTheObjectsAndNothingElse) {
  std::map<int, int> role_group;  // object -> group, 0 = structure
  std::map<int, std::string> class_of;
  for (const sim::Object& object : scene_->objects) {
    role_group[object.id] = object.role == sim::Role::kStructure ? 0
                            : object.detection_group > 0         ? 1000 + object.detection_group
                                                                 : object.id;
    class_of[role_group[object.id]] = object.class_name;
  }
  std::map<int, std::string> name_of;
  for (const json& c : (*root_)["categories"]) name_of[c["id"]] = c["name"];
  ASSERT_FALSE((*root_)["annotations"].empty());
  for (const json& image : (*root_)["images"]) {
    const std::string file = image["file_name"];
    const fs::path seq = *folder_ / (file.substr(0, 6) == "000000" ? "a" : "b");
    const cv::Mat ids = test_support::ReadImageFile(seq / "gt/object_id" / file.substr(7));
    cv::Mat1i expected(ids.size(), 0);
    std::set<int> groups;
    for (int v = 0; v < ids.rows; ++v) {
      for (int u = 0; u < ids.cols; ++u) {
        expected(v, u) = role_group[ids.at<std::uint16_t>(v, u)];
        if (expected(v, u) != 0) groups.insert(expected(v, u));
      }
    }
    std::size_t instances = 0;
    for (const json& a : (*root_)["annotations"]) {
      if (a["image_id"] != image["id"]) continue;
      ++instances;
      const cv::Mat1b mask = Decode(a["segmentation"]["counts"], ids.rows, ids.cols);
      std::vector<cv::Point> on;
      cv::findNonZero(mask, on);
      const int group = expected(on.at(0));
      EXPECT_EQ(cv::countNonZero((expected == group) != (mask != 0)), 0);
      EXPECT_EQ(name_of[a["category_id"]], class_of[group]);
    }
    EXPECT_EQ(instances, groups.size());
  }
}

TEST_F(CocoExport, KeepsTheIdsThatCocoGivesItsClasses) {
  const std::map<std::string, int> theirs{
      {"book", 84}, {"keyboard", 76}, {"cell phone", 77}, {"tv", 72}, {"mouse", 74}};
  int known = 0;
  for (const json& category : (*root_)["categories"]) {
    const auto found = theirs.find(category["name"]);
    if (found == theirs.end()) continue;
    ++known;
    EXPECT_EQ(category["id"], found->second) << found->first;
  }
  EXPECT_GE(known, 3);
}

TEST_F(CocoExport, IsSeenToBeWrongWhenItIs) {
  const auto spoilt = [&](const std::function<void(json&)>& spoil) {
    json root = *root_;
    spoil(root);
    return Complaints(*folder_ / "out", root).size();
  };
  EXPECT_GT(spoilt([](json& r) { r["annotations"][0]["bbox"][2] = 1; }), 0u);
  EXPECT_GT(spoilt([](json& r) { r["annotations"][0]["area"] = 3; }), 0u);
  EXPECT_GT(spoilt([](json& r) { r["annotations"][1]["id"] = r["annotations"][0]["id"]; }), 0u);
  EXPECT_GT(spoilt([](json& r) { r["annotations"][0]["category_id"] = 9999; }), 0u);
  EXPECT_GT(spoilt([](json& r) { r["images"][0]["width"] = 10; }), 0u);
  EXPECT_GT(spoilt([](json& r) { r["annotations"][0]["segmentation"]["counts"] = "61X1"; }),
            0u);
}

TEST_F(CocoExport, RefusesAFolderThatIsNoExportEvenWithForce) {
  EXPECT_THROW(eval::ExportCoco({*folder_ / "a"}, *folder_ / "out", {}), std::runtime_error);
  EXPECT_THROW(eval::ExportCoco({*folder_ / "a"}, *folder_ / "b", {.force = true}),
               std::runtime_error);
  EXPECT_TRUE(fs::exists(*folder_ / "b/manifest.json"));
  EXPECT_THROW(eval::ExportCoco({*folder_ / "none"}, *folder_ / "new", {}), std::runtime_error);
  EXPECT_FALSE(fs::exists(*folder_ / "new"));
  eval::ExportCoco({*folder_ / "a"}, *folder_ / "twice", {});
  const auto before = pipeline::Contents(*folder_ / "twice");
  eval::ExportCoco({*folder_ / "a"}, *folder_ / "twice", {.force = true});
  EXPECT_EQ(pipeline::Contents(*folder_ / "twice"), before);
}

TEST_F(CocoExport, NamesTheTruthThatIsMissing) {
  fs::copy(*folder_ / "b", *folder_ / "blind", fs::copy_options::recursive);
  fs::remove_all(*folder_ / "blind/gt/object_id");
  const auto exporting = [] {
    eval::ExportCoco({*folder_ / "blind"}, *folder_ / "from_blind", {});
  };
  EXPECT_THAT(test_support::RefusalOf(exporting), testing::HasSubstr("gt/object_id"));
  EXPECT_FALSE(fs::exists(*folder_ / "from_blind"));
}

}  // namespace
}  // namespace export_coco
