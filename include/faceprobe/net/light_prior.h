#pragma once
// What light to expect, from the features of a face: a small network that has seen thousands of synthetic faces under known light. It knows
// what the physics of one photo cannot: how light tends to lie where no skin looks, and how far its own layers are usually off. Not the last
// word: the transport solver starts from it and changes it until the pixels are explained.
//
//   const net::LightPrior prior("models/light.safetensors");
//   const Eigen::MatrixX3f light = prior.radiance(lighting::face_features(observations));   // over the shading's level

#include "faceprobe/net/model_file.h"

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <vector>

namespace faceprobe::net {

inline constexpr const char* kLightArchitecture = "light";

class LightPrior {
 public:
  // Throws Error(kModel): the file is not there, damaged, or of another network.
  explicit LightPrior(const std::filesystem::path& weights);
  LightPrior(const LightPrior&) = delete;
  LightPrior& operator=(const LightPrior&) = delete;
  LightPrior(LightPrior&&) noexcept;
  LightPrior& operator=(LightPrior&&) noexcept;
  ~LightPrior();

  int inputs() const;  // length of the features that it takes
  // #cells x 3 of a coarse sphere grid, > 0: radiance in units of the face's mean shading. Throws std::invalid_argument for another number
  // of features.
  Eigen::MatrixX3f radiance(const Eigen::VectorXf& features) const;

  const ModelInfo& info() const;  // what the weights file says of itself

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace faceprobe::net
