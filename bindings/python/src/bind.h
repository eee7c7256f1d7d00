#pragma once
// What each file of the module adds to it. The order in module.cpp is that of the types: a signature in a docstring names only those that
// are there already.

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace faceprobe::python {

namespace py = pybind11;

void bind_errors(py::module_& module);
void bind_env_map(py::module_& module);
void bind_light(py::module_& module);
void bind_face(py::module_& module);
void bind_estimate(py::module_& module);
void bind_insert(py::module_& module);
void bind_relight(py::module_& module);
void bind_room(py::module_& module);

// People see a type by the name they import it by, not by the extension's.
inline void call_public(const py::object& type) { type.attr("__module__") = "faceprobe"; }

// Sentences may name files, whose names may be any bytes: what is not UTF-8 is replaced.
inline py::list sentences(const std::vector<std::string>& texts) {
  py::list list;
  for (const std::string& text : texts) {
    PyObject* decoded = PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace");
    if (decoded == nullptr) throw py::error_already_set();
    list.append(py::reinterpret_steal<py::str>(decoded));
  }
  return list;
}

}  // namespace faceprobe::python
