#pragma once
// The Basel Face Model's editions as head models in metres, before the last steps that they share.

#include "faceprobe/synth/head_model.h"

#include <filesystem>

namespace faceprobe::assets {

synth::HeadModel read_basel_2009(const std::filesystem::path& path);
synth::HeadModel read_basel_h5(const std::filesystem::path& path);  // 2017, 2019

}  // namespace faceprobe::assets
