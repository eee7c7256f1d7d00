#pragma once
// The same of a file that is read already.

#include "faceprobe/io/safetensors.h"
#include "faceprobe/net/model_file.h"

namespace faceprobe::net {

// `name` stands for the file in the sentence of an Error(kModel).
ModelInfo model_info(const io::TensorFile& file, const std::string& name);

}  // namespace faceprobe::net
