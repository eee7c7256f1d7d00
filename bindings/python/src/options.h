#pragma once
// The keywords of an estimate, named and checked as the command's options. Several functions take them, so they are written down once:
//
//   with_option_arguments([&](const auto&... arguments) {
//     module.def("separate", taking_options<py::object>(&separate), py::arg("photo"), arguments..., "...");
//   });                                       // separate(py::object photo, const pipeline::EstimateOptions& options)

#include "faceprobe/pipeline/estimate.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace faceprobe::python {

namespace py = pybind11;

using MapSize = std::variant<int, std::string>;  // 256, or "256x128"
using Landmarks = std::variant<py::array, std::vector<std::array<double, 2>>>;

struct OptionValues {
  std::string separator;
  std::optional<std::filesystem::path> weights;
  std::string geometry, shading, prior, solver;
  bool compact_light = false;
  std::optional<int> iterations;
  MapSize size;
  int layer_px = 0;
  std::optional<double> focal_px;
  std::optional<Landmarks> landmarks;
  int threads = 0;
  bool deterministic = false;
  std::string device;
};

// Throws Error(kUsage), or Error(kDevice) for a device that is not there.
pipeline::EstimateOptions options_from(const OptionValues& values);

// For other functions that take threads alone. Throws Error(kUsage).
void check_threads(int threads);

// Calls define(keyword arguments...), in the order that taking_options() has them.
template <class Define>
void with_option_arguments(const Define& define) {
  const pipeline::EstimateOptions usual;
  define(py::kw_only(), py::arg("separator") = usual.separator_name(), py::arg("weights") = py::none(),
         py::arg("geometry") = "net", py::arg("shading") = "net", py::arg("prior") = "net",
         py::arg("solver") = std::string(lighting::solver_name(usual.solve.solver)),
         py::arg("compact_light") = usual.solve.compact_light, py::arg("iterations") = py::none(),
         py::arg("size") = usual.map_width, py::arg("layer_px") = usual.layer_px, py::arg("focal_px") = py::none(),
         py::arg("landmarks") = py::none(), py::arg("threads") = usual.threads,
         py::arg("deterministic") = usual.deterministic, py::arg("device") = "auto");
}

// call(front..., EstimateOptions) as a function of front... and the keywords.
template <class... Front, class Call>
auto taking_options(Call call) {
  return [call](Front... front, std::string separator, std::optional<std::filesystem::path> weights,
                std::string geometry, std::string shading, std::string prior, std::string solver, bool compact_light,
                std::optional<int> iterations, MapSize size, int layer_px, std::optional<double> focal_px,
                std::optional<Landmarks> landmarks, int threads, bool deterministic, std::string device) {
    return call(std::move(front)...,
                options_from({std::move(separator), std::move(weights), std::move(geometry), std::move(shading),
                              std::move(prior), std::move(solver), compact_light, iterations, std::move(size), layer_px,
                              focal_px, std::move(landmarks), threads, deterministic, std::move(device)}));
  };
}

}  // namespace faceprobe::python
