#pragma once
// A public-domain portrait that set-up provides, and pictures made from it.

#include "faceprobe/io/photo.h"
#include "faceprobe/pipeline/estimate.h"
#include "support/temp_folder.h"

#include <filesystem>

namespace faceprobe::pipeline::testing {

using faceprobe::testing::TempFolder;

std::filesystem::path portrait_file();
const io::Photo& portrait();
// Estimated once per process with default options.
const Estimate& portrait_estimate();

io::Photo mirrored(const io::Photo& photo);            // left and right swapped
io::Photo dimmed(const io::Photo& photo, float gain);  // linear values times gain
io::Photo twice_side_by_side(const io::Photo& photo);
io::Photo blank(int width, int height);

}  // namespace faceprobe::pipeline::testing
