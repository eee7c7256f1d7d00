#pragma once
// A synthetic sample as one would judge an estimate by it. Samples know the light of the scene; an estimate sees the photo, which went
// through a camera, so the layers are brought to the photo's own scale.
//
//   const PhotoLayers layers = photo_layers(reader.copy_sample(7));
//   const Image estimate = separator(layers.linear);   // to be compared with layers.highlight

#include "faceprobe/synth/sample.h"

namespace faceprobe::synth {

struct PhotoLayers {
  Image linear;     // H x W x 3: the photo, decoded as sRGB: what an estimate gets
  Image highlight;  // H x W x 3, 0 <= highlight <= linear
};
// Where a channel is not clipped the highlight is its share of the photo, linear H / (H + D): a tone curve scales both layers alike.
// Where it is, the diffuse layer keeps its value and the highlight is what is left below white.
PhotoLayers photo_layers(const Sample& sample);

// The convex hull of the dense landmarks, grown by `scale` about its middle, less eyes and mouth (`region`): what the face mesh covers,
// hair before it included. Without those, the 68 landmarks with a forehead of usual height above them; without either all skin.
// H x W x 1 of 0 and 1.
ByteImage face_mask(const ViewLayers& view, float scale);

// The face's own skin (the ten regions but neck and ears), H x W x 1 of 0 and 1.
ByteImage skin_mask(const ViewLayers& view);

}  // namespace faceprobe::synth
