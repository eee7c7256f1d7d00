#include "options.h"

#include "arrays.h"
#include "faceprobe/core/error.h"

#include <charconv>

namespace faceprobe::python {

namespace {

template <class Choice>
Choice one_of(const std::string& text, const char* option, const char* first, Choice first_choice, const char* second,
              Choice second_choice) {
  if (text == first) return first_choice;
  if (text == second) return second_choice;
  throw Error(ExitCode::kUsage, std::string(option) + " takes " + first + " or " + second + ", found '" + text + "'.");
}

int whole_number(std::string_view text) {
  int value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size() || text.empty()) {
    throw Error(ExitCode::kUsage, "size takes a width, or WIDTHxHEIGHT, found '" + std::string(text) + "'.");
  }
  return value;
}

int width_of(const MapSize& size) {
  if (const int* width = std::get_if<int>(&size)) return *width;
  const std::string& text = std::get<std::string>(size);
  const std::size_t cross = text.find('x');
  const int width = whole_number(std::string_view(text).substr(0, cross));
  if (cross != std::string::npos && 2LL * whole_number(std::string_view(text).substr(cross + 1)) != width)
    throw Error(ExitCode::kUsage, "size " + text + ": an environment map is twice as wide as high.");
  return width;
}

Eigen::MatrixX2f points_of(const Landmarks& landmarks) {
  if (const auto* array = std::get_if<py::array>(&landmarks)) {
    check_array<float>(*array, "landmarks", {kAnySize, 2});
    using Rows = Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>;
    return Eigen::Map<const Rows>(static_cast<const float*>(array->data()), array->shape(0), 2);
  }
  const auto& pairs = std::get<std::vector<std::array<double, 2>>>(landmarks);
  Eigen::MatrixX2f points(static_cast<Eigen::Index>(pairs.size()), 2);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    points.row(static_cast<Eigen::Index>(i)) = Eigen::RowVector2d(pairs[i][0], pairs[i][1]).cast<float>();
  return points;
}

void check_device(const std::string& device) {
  if (device == "cuda" || device.rfind("cuda:", 0) == 0) {
    throw Error(ExitCode::kDevice,
                "device " + device + " is not there: this version computes on the processor only. Use auto or cpu.");
  }
  if (device != "auto" && device != "cpu")
    throw Error(ExitCode::kUsage, "device takes auto, cpu or cuda[:N], found '" + device + "'.");
}

}  // namespace

void check_threads(int threads) {
  if (threads < 0 || threads > 1024)
    throw Error(ExitCode::kUsage, "threads must be from 0 to 1024, found " + std::to_string(threads) + ".");
}

pipeline::EstimateOptions options_from(const OptionValues& values) {
  check_device(values.device);
  check_threads(values.threads);
  pipeline::EstimateOptions out;
  if (values.separator == "net") {
    out.classical.reset();
    out.weights = values.weights.value_or("");
  } else {
    out.classical = highlight::separator_from_name(values.separator);
    if (values.weights)
      throw Error(ExitCode::kUsage, "weights are the network's; separator " + values.separator + " takes none.");
  }
  out.normals =
      one_of(values.geometry, "geometry", "net", pipeline::NormalSource::kNet, "mesh", pipeline::NormalSource::kMesh);
  out.shading = one_of(values.shading, "shading", "net", pipeline::ShadingSource::kNet, "regions",
                       pipeline::ShadingSource::kRegions);
  out.prior =
      one_of(values.prior, "prior", "net", pipeline::PriorSource::kNet, "smooth", pipeline::PriorSource::kSmooth);
  out.solve.solver = lighting::solver_from_name(values.solver);
  out.solve.compact_light = values.compact_light;
  if (values.iterations) out.solve.iterations = out.solve.iterations_from_expected = *values.iterations;
  out.map_width = width_of(values.size);
  out.layer_px = values.layer_px;
  out.threads = values.threads;
  out.deterministic = values.deterministic;
  out.focal_px = values.focal_px;
  if (values.landmarks) out.landmarks_px = points_of(*values.landmarks);
  if (const std::string fault = out.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  return out;
}

}  // namespace faceprobe::python
