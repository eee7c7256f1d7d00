#pragma once
// Pictures and tables between C++ and NumPy. Out: pictures are read-only views that keep their owner alive, small tables are copies. In: an
// array is what was asked for, to the element type, or it is refused; nothing is converted behind the caller's back.
//
//   view(face, face->albedo)                                         // std::shared_ptr<FaceEstimate> face
//   const Image light = image_from<float>(array, "photo", 3);        // H x W x 3, copied

#include "faceprobe/core/image.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::python {

namespace py = pybind11;

// H x W x C, or H x W for one channel.
template <class T>
py::array_t<T> view(std::shared_ptr<const void> owner, const BasicImage<T>& image) {
  std::vector<py::ssize_t> shape{image.height(), image.width()};
  if (image.channels() != 1) shape.push_back(image.channels());
  const py::capsule base(new std::shared_ptr<const void>(std::move(owner)),
                         [](void* kept) { delete static_cast<std::shared_ptr<const void>*>(kept); });
  py::array_t<T> array(shape, image.data(), base);
  // The same memory is seen by every view, and by what is computed from the result later.
  array.attr("flags").attr("writeable") = false;
  return array;
}

// C-contiguous copy: rows x columns, or as long as a vector.
template <class Derived>
py::array_t<typename Derived::Scalar> table(const Eigen::MatrixBase<Derived>& values) {
  using Scalar = typename Derived::Scalar;
  std::vector<py::ssize_t> shape{values.rows()};
  if (Derived::ColsAtCompileTime != 1) shape.push_back(values.cols());
  py::array_t<Scalar> array(shape);
  Eigen::Map<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      array.mutable_data(), values.rows(), values.cols()) = values;
  return array;
}

inline constexpr py::ssize_t kAnySize = -1;

// The rest of check_array: raises ValueError unless the shape fits, no size is 0, and the values lie row by row; TypeError for a masked array.
void check_layout(const py::array& array, const std::string& what, const std::vector<py::ssize_t>& shape);
[[noreturn]] void refuse_type(const py::array& array, const std::string& what, const std::string& wanted);

// Raises TypeError for another element type and for masked arrays, ValueError for another shape or a layout that is not C-contiguous.
template <class T>
void check_array(const py::array& array, const std::string& what, const std::vector<py::ssize_t>& shape) {
  if (!py::isinstance<py::array_t<T>>(array)) refuse_type(array, what, py::str(py::dtype::of<T>()));
  check_layout(array, what, shape);
}

// H x W x channels, or H x W for one. Throws Error(kInput) for a side over the limit of io/limits.h.
template <class T>
BasicImage<T> image_from(const py::array& array, const std::string& what, int channels);
extern template BasicImage<float> image_from(const py::array&, const std::string&, int);
extern template BasicImage<std::uint8_t> image_from(const py::array&, const std::string&, int);

// N x 3. Raises as check_array, and ValueError for values that are not finite.
Eigen::MatrixX3f rows_of_three(const py::array& array, const std::string& what);

}  // namespace faceprobe::python
