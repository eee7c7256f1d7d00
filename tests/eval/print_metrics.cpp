// The metrics of two raw pictures, for compare_skimage.py: native floats, row by row, channels interleaved; the mask is one byte a pixel.
//
//   print_metrics WIDTH HEIGHT CHANNELS ESTIMATE TRUTH [MASK]

#include "faceprobe/eval/image_metrics.h"

#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

template <class T>
faceprobe::BasicImage<T> read_raw(const std::string& path, int width, int height, int channels) {
  faceprobe::BasicImage<T> image(width, height, channels);
  const auto bytes = static_cast<std::streamsize>(image.values().size_bytes());
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(image.data()), bytes) || file.peek() != std::ifstream::traits_type::eof())
    throw std::runtime_error(path + " is not a file of " + std::to_string(bytes) + " bytes.");
  return image;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.size() != 5 && words.size() != 6)
      throw std::runtime_error("Usage: print_metrics WIDTH HEIGHT CHANNELS ESTIMATE TRUTH [MASK]");
    const int width = std::stoi(words[0]);
    const int height = std::stoi(words[1]);
    const int channels = std::stoi(words[2]);
    const faceprobe::Image estimate = read_raw<float>(words[3], width, height, channels);
    const faceprobe::Image truth = read_raw<float>(words[4], width, height, channels);
    faceprobe::ByteImage mask;
    if (words.size() == 6) mask = read_raw<std::uint8_t>(words[5], width, height, 1);
    std::printf("rmse %.17g\n", faceprobe::eval::rmse(estimate, truth, mask));
    std::printf("si_rmse %.17g\n", faceprobe::eval::si_rmse(estimate, truth, mask));
    std::printf("ssim %.17g\n", faceprobe::eval::ssim(estimate, truth, mask));
    return 0;
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 1;
  }
}
