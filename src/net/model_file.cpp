#include "faceprobe/net/model_file.h"

#include "faceprobe/core/error.h"
#include "net/model_info.h"

namespace faceprobe::net {
namespace {

std::string entry(const io::TensorFile& file, const std::string& key, const std::string& name) {
  const auto found = file.metadata.find(key);
  if (found != file.metadata.end()) return found->second;
  throw Error(ExitCode::kModel, name + " has no \"" + key +
                                    "\" in its metadata, so it does not say which network it belongs to. Use weights "
                                    "made for faceprobe.");
}

}  // namespace

ModelInfo model_info(const io::TensorFile& file, const std::string& name) {
  ModelInfo info{.architecture = entry(file, kArchitectureKey, name),
                 .options_json = entry(file, kOptionsKey, name),
                 .sha256 = file.sha256,
                 .parameter_count = 0,
                 .metadata = file.metadata};
  for (const auto& [tensor_name, tensor] : file.tensors) {
    info.parameter_count += static_cast<std::int64_t>(tensor.values.size());
  }
  return info;
}

ModelInfo read_model_info(const std::filesystem::path& path) {
  return model_info(io::read_safetensors(path), path.string());
}

}  // namespace faceprobe::net
