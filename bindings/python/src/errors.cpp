// One Python class for each kind of faceprobe::Error, so that a script tells a photo without a face from a file that is broken.

#include "bind.h"
#include "faceprobe/core/error.h"

#include <array>
#include <exception>
#include <string>
#include <utility>

namespace faceprobe::python {

namespace {

struct Kind {
  ExitCode code;
  const char* name;
  const char* doc;
};
constexpr std::array<Kind, 7> kKinds = {{
    {ExitCode::kUnexpected, "faceprobe.FaceprobeError",
     "Base of all errors of this package. `code` is the exit code that the command ends with for the same reason."},
    {ExitCode::kUsage, "faceprobe.UsageError", "Options that are out of range or do not go together."},
    {ExitCode::kInput, "faceprobe.InputError", "A file that cannot be read, or is over a limit."},
    {ExitCode::kNoFace, "faceprobe.NoFaceError", "The photo is fine, but holds no usable face."},
    {ExitCode::kModel, "faceprobe.ModelError", "A model file is missing or not the one it claims to be."},
    {ExitCode::kOutput, "faceprobe.OutputError", "A result could not be written."},
    {ExitCode::kDevice, "faceprobe.DeviceError", "A device that was named is not there."},
}};

// Never freed: errors may be raised until the interpreter ends.
std::array<PyObject*, kKinds.size()>& types() {
  static std::array<PyObject*, kKinds.size()> made{};
  return made;
}

void raise(const Error& error) {
  std::size_t kind = 0;
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (kKinds[i].code == error.code()) kind = i;
  }
  // Sentences may name files, whose names may be any bytes.
  PyObject* sentence = PyUnicode_DecodeFSDefault(error.what());
  if (sentence == nullptr) return;  // Python's own error is set
  PyErr_SetObject(types()[kind], sentence);
  Py_DECREF(sentence);
}

}  // namespace

void bind_errors(py::module_& module) {
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    const Kind& kind = kKinds[i];
    py::dict members;
    members["code"] = static_cast<int>(kind.code);
    PyObject* base = i == 0 ? PyExc_Exception : types()[0];
    types()[i] = PyErr_NewExceptionWithDoc(kind.name, kind.doc, base, members.ptr());
    if (types()[i] == nullptr) throw py::error_already_set();
    const std::string name = kind.name;
    module.add_object(name.substr(name.find('.') + 1).c_str(), types()[i]);
  }
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(std::move(pointer));
    } catch (const Error& error) {
      raise(error);
    }
  });
}

}  // namespace faceprobe::python
