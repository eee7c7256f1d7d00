#include "photo_source.h"

#include "arrays.h"

#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace faceprobe::python {

namespace {

// As io::load_photo has an EXR file: nothing is known to be clipped.
io::Photo photo_from_linear(Image linear) {
  io::Photo photo;
  photo.clipped = ByteImage(linear.width(), linear.height(), 1);
  photo.grey = true;
  for (std::size_t i = 0; i < linear.pixel_count() && photo.grey; ++i) {
    const float* value = linear.data() + 3 * i;
    photo.grey = value[0] == value[1] && value[1] == value[2];
  }
  photo.bits_per_channel = 32;
  photo.format = "memory";
  photo.colour_space = "linear";
  photo.linear = std::move(linear);
  return photo;
}

Image linear_from(const py::array& array) {
  Image linear = image_from<float>(array, "photo", 3);
  if (!std::ranges::all_of(linear.values(), [](float value) { return std::isfinite(value) && value >= 0; })) {
    throw py::value_error(
        "photo holds values that are negative, infinite or not numbers, which no light is; numpy.nan_to_num and "
        "numpy.maximum(photo, 0) take them out.");
  }
  return linear;
}

}  // namespace

PhotoSource::PhotoSource(const py::object& photo) {
  if (py::isinstance<py::array>(photo)) {
    const auto array = py::reinterpret_borrow<py::array>(photo);
    if (py::isinstance<py::array_t<std::uint8_t>>(array)) {
      what_ = image_from<std::uint8_t>(array, "photo", 3);
    } else if (py::isinstance<py::array_t<float>>(array)) {
      what_ = linear_from(array);
    } else {
      refuse_type(array, "photo", "uint8 (sRGB) or float32 (linear light)");
    }
    return;
  }
  py::detail::make_caster<std::filesystem::path> path;
  if (!path.load(photo, false)) {
    throw py::type_error("photo must be a path or an array of uint8 (sRGB) or float32 (linear light), found " +
                         std::string(py::str(py::type::of(photo).attr("__name__"))) + ".");
  }
  what_ = py::detail::cast_op<std::filesystem::path&>(path);
}

io::Photo PhotoSource::load() && {
  if (const auto* path = std::get_if<std::filesystem::path>(&what_)) return io::load_photo(*path);
  if (const auto* srgb = std::get_if<ByteImage>(&what_)) return io::photo_from_srgb(*srgb);
  return photo_from_linear(std::move(std::get<Image>(what_)));
}

std::string PhotoSource::name() const {
  const auto* path = std::get_if<std::filesystem::path>(&what_);
  return path == nullptr ? "array" : path->string();
}

}  // namespace faceprobe::python
