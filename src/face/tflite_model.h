#pragma once
// One TensorFlow Lite network with float inputs and outputs. Its C headers stay inside the .cpp. Runs on one thread:
// with more, the library's sums change in the last bits, and these networks are too small to gain from it.
//
//   TfliteModel model(path, {1, 192, 192, 3});
//   std::ranges::copy(values, model.input().begin());
//   model.run();
//   std::span<const float> flags = model.output(896);   // the output that has 896 values

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace faceprobe::face {

class TfliteModel {
 public:
  // Throws Error(kModel) when the file is missing, no network, or does not take one float tensor of `input_shape`.
  TfliteModel(const std::filesystem::path& path, const std::vector<int>& input_shape);
  ~TfliteModel();
  TfliteModel(TfliteModel&&) noexcept;
  TfliteModel& operator=(TfliteModel&&) noexcept;
  TfliteModel(const TfliteModel&) = delete;
  TfliteModel& operator=(const TfliteModel&) = delete;

  std::span<float> input();
  void run();
  // The only float output with that many values; valid until the next run(). Throws Error(kModel) when there is none.
  std::span<const float> output(std::size_t values) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace faceprobe::face
