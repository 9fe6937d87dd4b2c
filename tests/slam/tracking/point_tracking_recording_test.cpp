#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <string>

#include "tests/slam/tracking/point_odometer.h"
#include "tests/support/image_files.h"
#include "tests/support/shared_data.h"

namespace slam {
namespace {

std::vector<std::vector<std::string>> Rows(const std::filesystem::path& file) {
  std::vector<std::vector<std::string>> rows;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    rows.emplace_back(std::istream_iterator<std::string>(words),
                      std::istream_iterator<std::string>());
  }
  return rows;
}

struct Sighting {
  double time_s;
  Eigen::Vector3d camera_w;
};

/// Position of the motion capture at a time, between its two neighbours.
Eigen::Vector3d At(const std::vector<Sighting>& truth, double time_s) {
  const auto after =
      std::find_if(truth.begin() + 1, truth.end() - 1,
                   [&](const Sighting& sighting) { return sighting.time_s >= time_s; });
  const auto before = after - 1;
  const double share = (time_s - before->time_s) / (after->time_s - before->time_s);
  return before->camera_w + share * (after->camera_w - before->camera_w);
}

/// Root mean square distance after the best rigid alignment (Horn 1987).
double AlignedError(const Eigen::Matrix3Xd& estimate, const Eigen::Matrix3Xd& truth) {
  const Eigen::Vector3d mean_e = estimate.rowwise().mean(), mean_t = truth.rowwise().mean();
  const Eigen::Matrix3Xd e = estimate.colwise() - mean_e, t = truth.colwise() - mean_t;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(t * e.transpose(),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d D = Eigen::Matrix3d::Identity();
  D(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  const Eigen::Matrix3d R = svd.matrixU() * D * svd.matrixV().transpose();
  return std::sqrt((R * e - t).colwise().squaredNorm().mean());
}

TEST(PointTrackingOfARecording, StaysWithin7MillimetresOfTheMotionCapture) {
  const std::filesystem::path folder = test_support::TumRecording();
  SKIP_WITHOUT(folder);
  std::vector<Sighting> truth;
  for (const auto& row : Rows(folder / "groundtruth.txt")) {
    truth.push_back(
        {std::stod(row[0]), {std::stod(row[1]), std::stod(row[2]), std::stod(row[3])}});
  }
  const auto rows = Rows(folder / "associations.txt");
  PointOdometer odometer(TumCamera("tum1"));
  Eigen::Matrix3Xd estimated(3, static_cast<long>(rows.size()));
  Eigen::Matrix3Xd true_positions(3, static_cast<long>(rows.size()));
  for (int i = 0; i < static_cast<int>(rows.size()); ++i) {
    const auto& row = rows[static_cast<std::size_t>(i)];
    Frame frame;
    frame.index = i;
    frame.timestamp_s = std::stod(row[0]);
    cv::cvtColor(test_support::ReadImageFile(folder / row[1]), frame.gray, cv::COLOR_BGR2GRAY);
    test_support::ReadImageFile(folder / row[3])
        .convertTo(frame.depth_m, CV_32F, 1.0 / odometer.camera.depth_factor);
    ASSERT_EQ(odometer.Step(frame).state, TrackState::kTracking) << "frame " << i;
    estimated.col(i) = Inverse(frame.T_cw).t;
    true_positions.col(i) = At(truth, std::stod(row[0]));
  }
  // Measured 5.0 mm; the recording's depth lags its colour by up to 17 ms.
  EXPECT_LT(AlignedError(estimated, true_positions), 0.007);
}

}  // namespace
}  // namespace slam
