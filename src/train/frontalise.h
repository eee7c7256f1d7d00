#pragma once
// Photos of one person brought into the same square, so that a pixel is the same place on the face in all of them (the
// paper's Section 5.1 does it with Hassner et al. 2015). The warp is linear within each triangle of the canonical mesh,
// and fills nothing in: what the photo does not show is marked, not mirrored from the other half, which would mirror
// highlights too.
//
//   const FaceTemplate square = face_template(mesh, 256);  // once
//   const Warp warp = face_warp(square, {face.landmarks_px.leftCols<2>(), face.landmarks_px.col(2)}, {width, height});
//   const Image frontal = sample(photo.linear, warp);     // 256 x 256 x 3, 0 where not seen
//   const ByteImage mask = seen(warp);
//   const Image by_photo = scatter(by_frontal, warp);     // a gradient, back to the photo's pixels
//
// Sampling is bilinear. Not for photos in which the face is more than twice as wide as the square: they would alias;
// shrink them first. Eyes and mouth are closed over by the mesh: mask them by their regions.

#include "face/raster.h"
#include "faceprobe/core/image.h"
#include "faceprobe/core/region.h"
#include "faceprobe/face/canonical_mesh.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace faceprobe::train {

// The mesh from the front, orthographic, in the middle of the square: what is turned away there is left out.
struct FaceTemplate {
  int size_px = 0;                     // of the square
  Eigen::MatrixX2d positions_px;       // 468 x 2: where the landmarks are in it, y down
  Eigen::MatrixX3i triangles;          // 898 x 3, the mesh's
  Eigen::VectorXd areas_m2;            // 898: of the triangles, on the canonical face
  std::vector<face::Fragment> pixels;  // size_px * size_px, row-major: triangle and weights, -1 outside the face
};

// Throws std::invalid_argument unless 8 <= size_px <= 4096.
FaceTemplate face_template(const face::CanonicalMesh& mesh, int size_px);

// size_px x size_px x 1, Region of each pixel of the square; kNone outside the face. `triangle_regions`: face/region.h.
ByteImage template_regions(const FaceTemplate& square, const std::vector<Region>& triangle_regions);

struct WarpLandmarks {
  Eigen::MatrixX2f photo_px;  // 468 x 2, y down
  // 468, smaller = nearer, in the photo's pixels, as the third column of Face::landmarks_px: then what a nearer part of
  // the face covers (a cheek behind the nose) counts as occluded. Empty: it does not.
  Eigen::VectorXf depth_px;
};

struct PhotoSize {
  int width = 0, height = 0;  // px
};

struct WarpOptions {
  // A triangle whose area in the photo is smaller than on the face by more than this, against the triangles that face
  // the camera, is occluded: few pixels of the photo, stretched, and a degree of error moves them far. 3 = turned by
  // about 70 degrees.
  float max_foreshortening = 3;

  std::string validate() const;  // empty when usable
};

enum class Reach : std::uint8_t {
  kOutside,   // the template's pixel is not on the face
  kOccluded,  // turned away, too foreshortened, or behind a nearer part
  kOffPhoto,  // beyond the photo's edge
  kSeen,
};

struct Source {
  float x_px = 0, y_px = 0;  // in the photo; 0 where outside
  Reach reach = Reach::kOutside;
};

struct Warp {
  int size_px = 0;
  PhotoSize photo;
  std::vector<Source> sources;  // size_px * size_px, row-major
};

// Throws std::invalid_argument: options, numbers of landmarks, landmarks that are not finite, a photo without pixels.
Warp face_warp(const FaceTemplate& square, const WarpLandmarks& landmarks, const PhotoSize& photo,
               const WarpOptions& options = {});

// One of the four pixels between which a place of the photo lies.
struct Corner {
  int x = 0, y = 0;
  float weight = 0;  // the four sum to 1
};
// Of a source that is seen: at least half a pixel inside the photo.
std::array<Corner, 4> corners_of(const Source& source, const PhotoSize& photo);

// size_px x size_px x 1: 255 where the photo shows the face, else 0.
ByteImage seen(const Warp& warp);

// The picture in the square, bilinear, any number of channels; 0 where not seen. Throws std::invalid_argument when the
// picture is not of the size the warp was made for.
Image sample(const Image& picture, const Warp& warp);

// The transpose of sample(), which is linear: values of the square added up where they came from; size of the photo.
// <sample(a), b> = <a, scatter(b)>. Throws std::invalid_argument when `square` is not size_px x size_px.
Image scatter(const Image& square, const Warp& warp);

}  // namespace faceprobe::train
