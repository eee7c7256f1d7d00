#include "face/warp.h"

#include <opencv2/imgproc.hpp>

namespace faceprobe::face {
namespace {

// OpenCV has no read-only view; nothing writes through this one.
cv::Mat view_of(const Image& picture) {
  return {picture.height(), picture.width(), CV_32FC(picture.channels()), const_cast<float*>(picture.data())};
}

}  // namespace

Image half_size(const Image& picture) {
  Image half(picture.width() / 2, picture.height() / 2, picture.channels());
  cv::Mat to = view_of(half);  // of the right size and type, so that it is written into
  // An odd last column or row would be squeezed in by a plain resize and shift everything; it is dropped instead.
  const cv::Rect even(0, 0, 2 * half.width(), 2 * half.height());
  cv::resize(view_of(picture)(even), to, to.size(), 0, 0, cv::INTER_AREA);
  return half;
}

Image warp_square(const Image& picture, const Affine& source_from_sample, int size) {
  Image out(size, size, picture.channels());
  cv::Mat to = view_of(out);
  const Affine& m = source_from_sample;
  const cv::Matx23d matrix(m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2));
  cv::warpAffine(view_of(picture), to, matrix, to.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT,
                 cv::Scalar::all(0));
  return out;
}

}  // namespace faceprobe::face
