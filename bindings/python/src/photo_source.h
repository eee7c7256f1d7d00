#pragma once
// A photo as Python gives it: a path, sRGB bytes or linear light.
//
//   PhotoSource source(photo);                          // with the GIL; raises TypeError or ValueError
//   const py::gil_scoped_release release;
//   const io::Photo loaded = std::move(source).load();  // without

#include "faceprobe/io/photo.h"

#include <pybind11/pybind11.h>

#include <filesystem>
#include <string>
#include <variant>

namespace faceprobe::python {

namespace py = pybind11;

class PhotoSource {
 public:
  // Pixels are copied, so that the caller may change the array while we read it without the GIL.
  explicit PhotoSource(const py::object& photo);
  // Throws as io::load_photo.
  io::Photo load() &&;
  // What reports call it.
  std::string name() const;

 private:
  std::variant<std::filesystem::path, ByteImage, Image> what_;
};

}  // namespace faceprobe::python
