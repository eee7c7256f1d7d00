#include "arrays.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/limits.h"

#include <algorithm>

namespace faceprobe::python {

namespace {

std::string shape_text(const std::vector<py::ssize_t>& shape, const std::string& any) {
  std::string text = "(";
  for (const py::ssize_t size : shape) text += (text.size() > 1 ? ", " : "") + (size < 0 ? any : std::to_string(size));
  return text + (shape.size() == 1 ? ",)" : ")");
}

bool fits(const py::array& array, const std::vector<py::ssize_t>& shape) {
  if (array.ndim() != static_cast<py::ssize_t>(shape.size())) return false;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const py::ssize_t found = array.shape(static_cast<py::ssize_t>(i));
    if (shape[i] == kAnySize ? found == 0 : found != shape[i]) return false;
  }
  return true;
}

}  // namespace

void refuse_type(const py::array& array, const std::string& what, const std::string& wanted) {
  throw py::type_error(what + " must be an array of " + wanted + ", found " + std::string(py::str(array.dtype())) +
                       "; convert it yourself, so that you know what is lost.");
}

void check_layout(const py::array& array, const std::string& what, const std::vector<py::ssize_t>& shape) {
  if (py::isinstance(array, py::module_::import("numpy").attr("ma").attr("MaskedArray"))) {
    throw py::type_error(what + " is a masked array, and its mask would be lost; array.filled(value) says what stands " +
                         "where it hides.");
  }
  if (!fits(array, shape)) {
    const std::vector<py::ssize_t> found(array.shape(), array.shape() + array.ndim());
    throw py::value_error(what + " must be of shape " + shape_text(shape, "N") + " with N above 0, found " +
                          shape_text(found, "") + ".");
  }
  constexpr int kNeeded = py::detail::npy_api::NPY_ARRAY_C_CONTIGUOUS_ | py::detail::npy_api::NPY_ARRAY_ALIGNED_;
  if ((array.flags() & kNeeded) != kNeeded) {
    throw py::value_error(what + " must lie row by row in memory (C-contiguous); numpy.ascontiguousarray makes it so.");
  }
}

template <class T>
BasicImage<T> image_from(const py::array& array, const std::string& what, int channels) {
  std::vector<py::ssize_t> shape{kAnySize, kAnySize};
  if (channels != 1) shape.push_back(channels);
  check_array<T>(array, what, shape);
  const int limit = io::Limits{}.max_side_px;
  if (std::max(array.shape(0), array.shape(1)) > limit) {
    throw Error(ExitCode::kInput, what + " is " + std::to_string(array.shape(1)) + " x " +
                                      std::to_string(array.shape(0)) + " pixels; a side may have " +
                                      std::to_string(limit) + ". Make it smaller.");
  }
  BasicImage<T> image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)), channels);
  std::copy_n(static_cast<const T*>(array.data()), image.values().size(), image.data());
  return image;
}

template BasicImage<float> image_from(const py::array&, const std::string&, int);
template BasicImage<std::uint8_t> image_from(const py::array&, const std::string&, int);

Eigen::MatrixX3f rows_of_three(const py::array& array, const std::string& what) {
  check_array<float>(array, what, {kAnySize, 3});
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  Eigen::MatrixX3f rows = Eigen::Map<const Rows>(static_cast<const float*>(array.data()), array.shape(0), 3);
  if (!rows.allFinite()) throw py::value_error(what + " holds values that are infinite or not numbers.");
  return rows;
}

}  // namespace faceprobe::python
