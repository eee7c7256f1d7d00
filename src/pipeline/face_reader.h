#pragma once
// Reads a face's picture: its highlights, by the network unless a classical separator is asked for or the photo shows too little of the
// face, and where the network tells them its surface and the light on it. Pictures may have any size; the network works on a small copy,
// as large as those it was trained on. Highlights follow the picture's detail back up, the rest is smooth enough to be enlarged.

#include "faceprobe/face/geometry.h"
#include "faceprobe/highlight/separate.h"
#include "faceprobe/pipeline/estimate.h"

#include <memory>
#include <optional>

namespace faceprobe::pipeline {

// How much of a face's crop (face::face_crop) a photo shows, 0 to 1.
double shown_share(const face::Crop& crop, int photo_width, int photo_height);

// The same part of the photo, no larger than the network's picture.
face::Crop small_crop(const face::Crop& crop);

// As net::FaceLayers has it, at the picture's size; the normals as if the camera looked at the picture's middle.
struct Surface {
  Image normal_cam;
  Image normal_error_rad;
  Image shading;  // empty where it is not to be trusted
  ByteImage region;
  Image open_shading = {};  // empty with the shading, and where the weights do not know it
};

// The network looks along the axis of a camera of its own; this turns its directions to where the face is seen.
Eigen::Matrix3f camera_from_network(const face::FaceGeometry& geometry);

struct Reading {
  highlight::Layers layers;
  std::optional<Surface> surface;
  std::optional<highlight::Separator> classical = std::nullopt;  // which made the layers, if one did
};

class FaceReader {
 public:
  // Throws Error(kModel): weights that cannot be read.
  explicit FaceReader(const EstimateOptions& options);
  ~FaceReader();
  FaceReader(const FaceReader&) = delete;
  FaceReader& operator=(const FaceReader&) = delete;
  FaceReader(FaceReader&&) = delete;
  FaceReader& operator=(FaceReader&&) = delete;

  // picture: H x W x 3 linear crop of one face; flags: io::Photo::clipped in the crop; skin: H x W x 1, non-zero where to separate;
  // geometry: the mesh in the same crop, which may be smaller; enough: of the face is shown, without which the classical separator steps in and
  // the network tells normals and regions alone.
  Reading read(const Image& picture, const ByteImage& flags, const ByteImage& skin, const face::FaceGeometry& geometry,
               bool enough) const;
  // The layers alone, for large pictures: nothing else is enlarged.
  highlight::Layers separate(const Image& picture, const ByteImage& flags, const ByteImage& skin,
                             const face::FaceGeometry& geometry, bool enough) const;

 private:
  struct Network;
  std::unique_ptr<Network> network_;
  highlight::SeparateOptions classical_;
};

}  // namespace faceprobe::pipeline
