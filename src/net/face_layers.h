#pragma once
// The face network's raw output for one picture, read as face_outputs.h says; torch/face_head.h is the same for training.

#include "faceprobe/core/resample.h"
#include "faceprobe/net/face_net.h"
#include "net/padded_picture.h"

namespace faceprobe::net {

struct FaceInputPicture {
  Image channels;  // H x W x FaceInputs::kCount
  float gain = 1;  // what the picture was multiplied by
};
// `mesh`: its normals, zero off it, no larger than the picture, whose edge is repeated; empty = no mesh.
FaceInputPicture face_input(const PaddedPicture& picture, const Image& mesh);

// `raw`: H x W x FaceOutputs::kCount or kCountWithoutOpen, at least as large as the result in either direction. Everything but the highlight, which head.h reads.
FaceLayers surface_of_raw(const Image& raw, float gain, int width, int height);

// The mean of two pictures' layers, regions those of the first; normals are unit again.
FaceLayers mean_of(const FaceLayers& a, const FaceLayers& b);

// The layers of a part of a picture, seen again in the whole of width x height.
FaceLayers seen_back(const FaceLayers& part, const Window& window, int width, int height);

// What is seen from near, put over what is seen of the whole where the window shows the picture. `where`: the pixels whose mean depth the two
// agree on.
void put_near(const FaceLayers& near, const Window& window, const ByteImage& where, FaceLayers& whole);

// Left and right change places, and so does the sign of x.
Image mirrored_normals(Image normals);

// The layers of the mirror image's mirror image: left and right change places, and so does the sign of the normals' x.
void mirror(FaceLayers& layers);

}  // namespace faceprobe::net
