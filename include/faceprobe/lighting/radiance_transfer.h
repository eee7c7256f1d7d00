#pragma once
// Light of order 2 from what many lit faces taught (after Knorr & Kurz 2014, "Real-time illumination estimation from faces for coherent
// rendering"): points of the face each have a radiance transfer vector, nine numbers that say how bright the point gets per unit of each
// harmonic, learnt from photos whose light is known; a new face's intensities at the points then give the light by least squares.
//
// Theirs is the scheme: intensities as they are, highlights and shadows in them, transfer learnt rather than computed, harmonics of order 2. Ours:
// the points are the kFeatureCells directions that skin can face (face_features.h), not places on the face, because those are what every face gives;
// points count by how well they are known and how badly the training data agree there; harmonics are pulled a little towards none; and intensities
// have the skin's albedo divided out as well as the estimate knows it, so that one transfer serves all skins and channels. Theirs knows an
// average skin only, and what light and skin have of colour stays together.
//
//   RadianceTransferLearner learner;
//   for (const auto& photo : photos) learner.add(photo.features, photo.light);
//   const RadianceTransfer transfer = learner.learn();
//   const Eigen::MatrixX3d sh = transfer.solve(face_features(observations));   // 9 x 3
//   const Eigen::MatrixX3f light = radiance_of_harmonics(sh, grid);            // harmonics.h
//
// Not for lamps that are to be sharp, as all of order 2.

#include "faceprobe/lighting/face_features.h"

#include <Eigen/Core>

namespace faceprobe::lighting {

inline constexpr int kTransferTerms = 9;  // coefficients of order 2, core/sh.h

// kFeatureCells x 4: red, green, blue of the appearance of skin that faces each cell, over the shading's level: its shading and, at the skin's
// usual albedo, the highlight that a viewer at +z sees there; then how well it is known, 0 to 1. Zero where nothing is known.
// Throws std::invalid_argument for another number of features.
Eigen::MatrixX4f point_intensities(const Eigen::VectorXf& features);

class RadianceTransfer {
 public:
  // `transfer`: kFeatureCells x kTransferTerms, intensity per unit of each radiance coefficient. `variance`: kFeatureCells, of what the transfer
  // does not explain, above 0. Throws std::invalid_argument for other shapes and for numbers that are not finite.
  RadianceTransfer(Eigen::MatrixXd transfer, Eigen::VectorXd variance);

  const Eigen::MatrixXd& transfer() const { return transfer_; }
  const Eigen::VectorXd& variance() const { return variance_; }

  // kTransferTerms x 3 radiance coefficients (core/sh.h), over the shading's level: times shading_level() they are in the photo's unit. `ridge`:
  // weight of the coefficients' energy against all points together. Zero for features that are all zero. Throws std::invalid_argument for another
  // number of features and a ridge that is not above 0.
  Eigen::MatrixX3d solve(const Eigen::VectorXf& features, double ridge = 1e-4) const;

 private:
  Eigen::MatrixXd transfer_;
  Eigen::VectorXd variance_;
};

// Sums over examples; learns at the end, so that no example need be kept. Only the luminance is learnt from, and each example's mirror image is
// another example.
class RadianceTransferLearner {
 public:
  RadianceTransferLearner();  // with no example yet
  // `features`: face_features(). `light`: kFeatureCells x 3 radiance, over the shading's level. Throws std::invalid_argument for other sizes.
  void add(const Eigen::VectorXf& features, const Eigen::MatrixX3f& light);
  int examples() const { return examples_; }
  // Ridge regression at each point: the light's coefficients explain the intensity, each photo's light brought to the energy 1; `ridge` is the
  // weight of the transfer's energy, in photos. A point that no example shows gets no transfer, and says nothing. Throws std::invalid_argument
  // unless the ridge is above 0.
  RadianceTransfer learn(double ridge = 0.1) const;

 private:
  void add_once(const Eigen::MatrixX4f& intensities, const Eigen::MatrixX3f& light);

  // A row a cell: the products of coefficients (column by column), of them with the intensity, of that with itself, and the weights.
  Eigen::MatrixXd products_, right_;
  Eigen::VectorXd energy_, weight_;
  int examples_ = 0;
};

}  // namespace faceprobe::lighting
