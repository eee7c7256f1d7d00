#pragma once
// Internal: a photo of a person as the face network looks at it in use, as a batch of its own, and the way from there to the square in which
// photos of a person are compared.
//
//   PhotoView view = view_of(*person.photos[i], person.masks[i], person.meshes[i], {.picture_px = 96, .multiple = 32});
//   const net::FaceSurface found = model.surface(batch_of(view));   // the view's memory must outlive the graph
//   const torch::Tensor shading = in_square(found.colour, view.warp);

#include "net/padded_picture.h"
#include "train/batch.h"
#include "train/person_loss.h"

#include <torch/torch.h>

namespace faceprobe::train {

struct ViewOptions {
  int picture_px =
      0;  // of TrainConfig: with it the near view, where there is a mask to be near to; 0 = the photo as it is
  int multiple = 1;  // of which sides must be; the last row and column are repeated beyond the photo
};

struct PhotoView {
  net::PaddedPicture picture;
  Image mesh;  // as large; 0 beyond the photo
  Image skin;  // as large, 1 channel: 1 on skin that the photo shows unclipped, else 0
  Warp warp;   // from the square to this view
};

// `mask`: H x W x 1, non-zero on the face; `mesh`: H x W x 3, its normals.
PhotoView view_of(const PersonPhoto& photo, const ByteImage& mask, const Image& mesh, const ViewOptions& options);

// Views of the photo's memory.
Batch batch_of(PhotoView& view);

// 1 x C x H x W to 1 x C x size_px^2, as sample() and with a gradient; 0 where not seen.
torch::Tensor in_square(const torch::Tensor& layer, const Warp& warp);

}  // namespace faceprobe::train
