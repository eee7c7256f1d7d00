#pragma once
// What a weights file says about itself: a .safetensors file whose metadata names the network ("architecture") and its options
// ("options", JSON), so that the file alone is enough to build it.
//
//   const net::ModelInfo info = net::read_model_info("models/face.safetensors");
//   std::cout << info.architecture << ", " << info.parameter_count << " numbers\n";

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace faceprobe::net {

inline constexpr const char* kArchitectureKey = "architecture";
inline constexpr const char* kOptionsKey = "options";
inline constexpr const char* kPictureKey = "picture_px";  // side of the views it was trained on; missing = as they come
inline constexpr const char* kUNetArchitecture = "unet";
inline constexpr const char* kFaceArchitecture = "face";
inline constexpr const char* kMscrArchitecture = "mscr";
inline constexpr const char* kShiArchitecture = "shi";
inline constexpr const char* kAlbedoShadingArchitecture = "albedo_shading";

struct ModelInfo {
  std::string architecture;  // "unet", "face", "mscr", "shi", "albedo_shading", "light", "gardner", "legendre" or "sky"
  std::string options_json;  // of that network
  std::string sha256;        // of the file, hex
  std::int64_t parameter_count = 0;             // numbers in all tensors
  std::map<std::string, std::string> metadata;  // all of it
};

// Throws Error(kModel): no readable .safetensors file, or one without "architecture" or "options" in its metadata.
ModelInfo read_model_info(const std::filesystem::path& path);

}  // namespace faceprobe::net
