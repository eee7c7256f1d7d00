#pragma once
// A rival for measurements, in the spirit of Li, Lin, Zhou & Ikeuchi 2017, "Specular highlight removal in facial images"
// (CVPR); tables call it "li 2017, lite". Unlike the separators of separate.h it knows that it looks at a face: skin has two
// pigments, so log albedo = mean + m * melanin + h * haemoglobin, and the mesh's normals say what the light can do:
//
//   picture = albedo(m, h) * shading(normal) + highlight * light colour(mirror direction),   highlight >= 0,
//
// where shading is spherical harmonics of order 2 for each channel, so that light from each side may have its own colour.
//
// Written from the abstract alone. What is theirs, as far as that says: the subspace of the two pigments, colours of light that
// vary with direction, a face's geometry, pixels that are clipped in part, no need of a calibrated camera. Their energy, priors,
// solver and code were not at hand. What stands in their place is ours: normal priors on how far a pixel's pigments, shading and
// colour depart from those around it, a log-normal one on the highlight about what skin mirrors of the light found, and rounds of
// least squares for the light and of Newton's steps for each pixel. The directions of the pigments are fixed, from a model of
// skin that `synth` draws its tones from too, and the priors' widths were chosen on training faces of `synth`: on our synthetic
// faces both favour this method.
//
// White light added to skin moves its colour nearly as less melanin would: m must be tied to its surroundings, and broad sheen
// is told by the expectation more than by the photo. So a grey photo, which holds no evidence, still gets an expected highlight.
//
// Not for anything but skin: hair, eyes and backgrounds are taken for odd skin. Without normals the shading is constant (order 0)
// and the light has one colour; what shading there is goes into each pixel's own departure. One clipped channel is left out of a
// pixel's fit; with two the expectations decide; with three the diffuse layer is that expected from the pixels around, and the
// highlight what is left below white.
//
//   const Layers layers = separate_skin(crop, clip, face_mask, mesh_normal_cam);

#include "faceprobe/core/image.h"
#include "faceprobe/highlight/separate.h"

#include <string>

namespace faceprobe::highlight {

// Deviations are those of logarithms: .1 is about 10 %.
struct SkinSubspaceOptions {
  int rounds = 4;                      // light, then pixels; 1 .. 50
  float melanin_deviation = 0.15F;     // of a pixel from those around, length in log albedo
  float haemoglobin_deviation = 0.1F;  // the same
  float shading_deviation = 0.2F;      // from that of the harmonics, all channels alike: shadows, wrong normals
  float colour_deviation = 0.1F;       // of each channel, from all of this
  // Expected highlight of skin seen from the front, as a share of the light it mirrors, and how far it may be from that.
  float highlight_share = 0.023F;
  float highlight_deviation = 0.75F;  // of the logarithm of that share
  float neighbourhood = 0.06F;  // width of a pixel's surroundings, as a share of the root of the mask's area; at most 1
  int threads = 0;

  std::string validate() const;  // empty when usable
};

// `linear`: H x W x 3. `clip`: H x W x 1, bits 1, 2, 4 for red, green, blue clipped; empty = none. `mask`: H x W x 1, non-zero
// where to separate; empty = everywhere. `normal_cam`: H x W x 3, the face's normals in the camera frame, of any length, 0 off the
// mesh (there the mean of the light shades); empty = no mesh. Values that are negative or not finite count as black.
//
// Keeps about 200 bytes for each pixel of the mask. Any number of threads gives the same result. Throws std::invalid_argument when
// sizes or channels do not fit, Error(kUsage) for options that do not validate.
Layers separate_skin(const Image& linear, const ByteImage& clip, const ByteImage& mask, const Image& normal_cam,
                     const SkinSubspaceOptions& options = {});

}  // namespace faceprobe::highlight
