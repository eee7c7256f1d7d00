#pragma once
// Internal: one head model to and from the arrays of a file; `prefix` is before the name of each.

#include "faceprobe/io/tensor_file.h"
#include "faceprobe/synth/head_model.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace faceprobe::synth {

// Modes become float16, positions stay float32. Returns what is not numbers, for head_from().
nlohmann::json put_head(const HeadModel& model, const std::string& prefix, io::TensorFileBuilder& file);
// Throws Error(kInput), and nlohmann's exceptions for a description that put_head() did not make.
HeadModel head_from(const io::MappedTensors& file, const std::string& prefix, const nlohmann::json& description);

}  // namespace faceprobe::synth
