#pragma once
// Internal: a picture back from the text that io::png_data_uri made of it.

#include "faceprobe/core/image.h"

#include <string>

namespace faceprobe::eval {

// The same size, channels and bytes. Throws Error(kInput) for what is not such a text.
ByteImage picture_of_data_uri(const std::string& uri);

}  // namespace faceprobe::eval
