// The extension module behind the package faceprobe.

#include "bind.h"
#include "faceprobe/core/version.h"

#include <string>

PYBIND11_MODULE(_faceprobe, module) {
  namespace fp = faceprobe::python;
  module.doc() = "The compiled part of faceprobe; import that.";
  module.attr("__version__") = std::string(faceprobe::kVersion);
  fp::bind_errors(module);
  fp::bind_env_map(module);
  fp::bind_light(module);
  fp::bind_face(module);
  fp::bind_estimate(module);
  fp::bind_insert(module);
  fp::bind_relight(module);
  fp::bind_room(module);
}
