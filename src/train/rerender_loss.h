#pragma once
// Internal: whether what a network says of a photo hangs together. A photo is albedo * shading + highlight, which holds exactly because albedo
// is defined by it; what can be wrong is the shading, which must be the irradiance of one light on the normals, and the albedo, which must be
// the same in every photo of a person.
//
//   const PhotoSurface found = photo_surface(model.surface(batch));
//   const Rerendered own = rerender(std::span(&found, 1), std::span(&skin, 1), {});
//   const SurfaceGuards guards = surface_guards(found, before, skin, {});
//   (own.residual + guards.sum()).backward();
//
// Computed in double precision, on the processor.

#include "faceprobe/train/finetune_surface.h"
#include "net/torch/face_head.h"

#include <torch/torch.h>
#include <span>
#include <vector>

namespace faceprobe::train {

// Of one photo: 1 x C x H x W.
struct PhotoSurface {
  torch::Tensor normal;   // 3, unit, camera frame
  torch::Tensor spread;   // 1, expected error of the normal, radians
  torch::Tensor shading;  // 3, > 0
};
PhotoSurface photo_surface(const net::FaceSurface& found);

// 1 where the normal is certain, 1/2 at the error that is usual (FaceOutputs::kUsualError), towards 0 beyond.
torch::Tensor confidence(const torch::Tensor& spread);

// N x 3 x H x W unit normals to N x K x H x W: what each harmonic of radiance makes of a white surface there, irradiance / pi. Those that no
// surface shows (odd bands from 3 on) are left out: K = 1, 4, 9, 9, 18 for orders 0 to 4. As core/sh.h, with a gradient.
torch::Tensor irradiance_basis(const torch::Tensor& normal, int order);

// How much a pixel's word counts in rerender().
enum class Trust {
  kStated,  // by the confidence, through which nothing is learnt: doubt must not be a way to a lower residual
  kEven,    // all skin alike; for measuring
};

struct Rerendered {
  torch::Tensor light;                 // K x 3 radiance coefficients that make a mean shading of 1
  std::vector<torch::Tensor> shading;  // of each photo, 1 x 3 x H x W, by that light on its normals and on its own scale
  torch::Tensor residual;              // mean |by light - said| / (said + .1), rounded off at 0; see SurfaceScore
};
// One light for all photos given, each of a scale of its own: give one photo for a light of its own. `skin`: 1 x 1 x H x W of each, 0 to 1.
// The light is the least-squares solution for the relative differences, with a ridge; gradients go through it, so that they are those of the
// residual itself, and a step that the light would undo counts for nothing. Throws std::invalid_argument: no photos, numbers of them, no skin.
Rerendered rerender(std::span<const PhotoSurface> photos, std::span<const torch::Tensor> skin,
                    const RerenderOptions& options, Trust trust = Trust::kStated);

// N photos of a person in a common square of P pixels: diffuse layers and shadings N x 3 x P, weights N x 1 x P, 0 where a photo does not show
// skin. Mean relative difference of the albedos from their mean, each photo's brought to the same mean; pixels count by the light on them, and
// only those that all photos show. 0 where there are none. The gradient is for the shading: detach the diffuse layer, or taking all light
// for highlight is the easiest way to agree.
torch::Tensor albedo_disagreement(const torch::Tensor& diffuse, const torch::Tensor& shading,
                                  const torch::Tensor& weight);

// Standard deviation over skin of the logarithm of the shading's mean channel.
torch::Tensor shading_contrast(const torch::Tensor& shading, const torch::Tensor& skin);
// Mean over skin of |d/dy dz/dx - d/dx dz/dy|, per pixel of the picture: 0 for normals of any smooth surface, seen from afar.
torch::Tensor normal_curl(const torch::Tensor& normal, const torch::Tensor& skin);

// Each 0 within its slack of RerenderOptions. Beyond, squares: 1 at twice the slack, and for the confidence at half of the least that it may have.
struct SurfaceGuards {
  torch::Tensor normal;      // normals leave the first network's
  torch::Tensor contrast;    // shading turns constant, which any normals explain, or grows without end
  torch::Tensor confidence;  // doubt everywhere
  torch::Tensor curl;        // normals that take up the skin's pattern are normals of no surface

  torch::Tensor sum() const { return normal + contrast + confidence + curl; }
};
// `start`: of the first network, without a gradient.
SurfaceGuards surface_guards(const PhotoSurface& found, const PhotoSurface& start, const torch::Tensor& skin,
                             const RerenderOptions& options);

}  // namespace faceprobe::train
