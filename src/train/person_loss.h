#pragma once
// The unsupervised loss of several photos of one person (paper, Section 3.2) with its gradient by every photo's highlight layer: the
// diffuse chromaticities, brought into the mesh's own square, should have rank one.
//
//   const PersonPhotos photos(four_photos, square, {});        // once per batch
//   const PersonLoss loss = photos.loss(highlights);           // one layer per photo, each the size of its crop
//   highlight_tensor.backward(tensor_of(loss.by_highlight[k]));
//
// Not for fewer than two photos, and not before their light has been made of one colour (train/histogram_transfer.h).

#include "faceprobe/core/image.h"
#include "train/chromaticity.h"
#include "train/frontalise.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace faceprobe::train {

struct PersonPhoto {
  Image linear;       // H x W x 3: the face's crop
  ByteImage clipped;  // H x W x 1, non-zero = clipped in some channel; empty = nowhere
  Warp warp;          // from the square to this crop
};

struct PersonLossOptions {
  bool rank1 = true;  // the distance to rank one; false = the paper's second singular value
  // Of the chromaticity, in the square: what landmarks misplace is not to look like a highlight. The paper has none.
  float blur_sigma_px = 2.5F;
  double guard_weight = 0.1;  // of each guard of train/finetune_guards.h; 0 = none
  // Of the mean over photos of (energy / trusted energy - 1)^2: the shortest way to one chromaticity is a diffuse layer that fades.
  double energy_weight = 0.5;

  std::string validate() const;  // empty when usable
};

// Of layers that are known to be about right, such as the network's before finetuning; one number a photo. Empty = not known.
struct LayerMeasures {
  std::vector<double> energies;          // mean over pixels of the highlight's mean channel, in the square
  std::vector<double> chroma_variances;  // of the diffuse layer there; chroma_variance() of train/finetune_guards.h
};

struct PersonLoss {
  double residual = 0;  // of the chromaticities, per pixel; see train/low_rank.h
  double guards = 0;    // sum over the photos, weighted
  double energy =
      0;  // mean over photos and pixels of the highlight's mean channel, in the square: what must not run away
  LayerMeasures measures;           // of these layers
  double kept = 0;                  // penalty of energies that are not the trusted ones, weighted
  std::vector<Image> by_highlight;  // of residual + guards + kept; the size of each crop
};

class PersonPhotos {
 public:
  // `regions`: of the square (template_regions). Skin that all photos show, unclipped, takes part. Throws std::invalid_argument: fewer
  // than two photos, other sizes, options; no such skin.
  PersonPhotos(std::vector<PersonPhoto> photos, const ByteImage& regions, const PersonLossOptions& options = {});

  // Skin that takes part, in pixels of the square.
  Eigen::Index pixels() const { return chromaticity_->pixels(); }
  // Throws std::invalid_argument when a layer is not the size of its photo, or what is trusted not of as many photos. The guard against a
  // diffuse layer of one colour needs trusted variances, and takes the least of them for all photos: they show the same skin, so what one
  // of them has more is noise and highlight that was missed, which finetuning is free to take off.
  PersonLoss loss(std::span<const Image> highlights, const LayerMeasures& trusted = {}) const;

 private:
  std::vector<PersonPhoto> photos_;
  PersonLossOptions options_;
  std::vector<Eigen::MatrixX3d> flat_;  // the photos in the square
  Image weight_;                        // of the square
  std::optional<Chromaticity> chromaticity_;
};

}  // namespace faceprobe::train
