#include "slam/segment/largest_component.h"

#include <opencv2/imgproc.hpp>

namespace slam {

cv::Mat1b LargestComponent(const cv::Mat1b& mask) {
  constexpr int kNeighbours = 4;
  cv::Mat1i component, figures;
  cv::Mat1d centroids;
  const int count = cv::connectedComponentsWithStats(mask, component, figures, centroids,
                                                     kNeighbours, CV_32S);
  // Number 0 is what is not in the mask; the others are in order of their first entries.
  int largest = count > 1 ? 1 : -1;
  for (int k = 2; k < count; ++k) {
    if (figures(k, cv::CC_STAT_AREA) > figures(largest, cv::CC_STAT_AREA)) largest = k;
  }
  return cv::Mat(component == largest);
}

}  // namespace slam
