#include "torch_side.h"

#include "faceprobe/core/error.h"

#include <dlfcn.h>
#include <string>

namespace faceprobe::cli {

#ifdef FACEPROBE_LEAN

const TorchSide& torch_side() { return *faceprobe_torch_side(); }

#else

namespace {

const TorchSide* load_torch_side() {
  // By its path, as sanitizers do not know where a program's private libraries lie. It stays loaded: libtorch cannot be unloaded.
  void* module = ::dlopen(torch_side_file().c_str(), RTLD_NOW | RTLD_LOCAL);
  void* entry = module == nullptr ? nullptr : ::dlsym(module, "faceprobe_torch_side");
  if (entry == nullptr) {
    throw Error(ExitCode::kDevice,
                "What needs libtorch cannot be loaded: " + std::string(::dlerror()) +
                    ". Install libtorch as it was when Faceprobe was built, or build Faceprobe again.");
  }
  return reinterpret_cast<decltype(&faceprobe_torch_side)>(entry)();
}

}  // namespace

std::filesystem::path torch_side_file() {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  return (program.parent_path() / FACEPROBE_TORCH_SIDE_FROM_BIN).lexically_normal();
}

const TorchSide& torch_side() {
  static const TorchSide* const side = load_torch_side();
  return *side;
}

#endif

}  // namespace faceprobe::cli
