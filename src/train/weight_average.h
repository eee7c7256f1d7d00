#pragma once
// Internal: the running mean of the weights, which is what is measured and kept of a training.
//
//   average.add(*module, step);                              // after each step
//   const AveragedWeights in_place(average, *module);        // until the end of the block the module has the mean

#include <torch/torch.h>
#include <cstdint>
#include <vector>

namespace faceprobe::train {

// Batch normalisation measures the layers below it in buffers, which fit the weights that they were measured with. Other buffers are constants.
enum class Averaged { kParameters, kParametersAndBuffers };

// Running mean of a module's parameters, which is smoother than they are (Polyak & Juditsky 1992).
class WeightAverage {
 public:
  WeightAverage(const torch::nn::Module& module, double decay, Averaged which = Averaged::kParameters);
  // Early on the mean follows faster, so that it is not of the first guess.
  void add(const torch::nn::Module& module, std::int64_t step);
  // What is averaged of the module changes places with the mean.
  void swap(torch::nn::Module& module);

  std::vector<torch::Tensor>& values() { return values_; }

 private:
  double decay_;
  Averaged which_;
  std::vector<torch::Tensor> values_;
};

// Lends the module the mean as long as it lives.
class AveragedWeights {
 public:
  AveragedWeights(WeightAverage& average, torch::nn::Module& module) : average_(average), module_(module) {
    average_.swap(module_);
  }
  ~AveragedWeights() { average_.swap(module_); }
  AveragedWeights(const AveragedWeights&) = delete;
  AveragedWeights& operator=(const AveragedWeights&) = delete;

 private:
  WeightAverage& average_;
  torch::nn::Module& module_;
};

}  // namespace faceprobe::train
