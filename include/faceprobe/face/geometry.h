#pragma once
// The face mesh as pictures: per pixel of a crop, what the light estimate needs to know about the surface seen there.
//
//   GeometryOptions options;  options.long_side_px = 256;
//   const Crop crop = face_crop(face, photo.linear.width(), photo.linear.height(), options);
//   FaceGeometry g = rasterize(face, camera, mesh, crop);
//   Eigen::Vector3f n(g.normal_cam.pixel(x, y));
//
// The mesh's own normals are good to about 13 degrees (median, against a head
// scan): the nose and the mouth are the worst. Depth and normals are those of the posed mesh; eyes and mouth are
// closed over.

#include "faceprobe/core/image.h"
#include "faceprobe/face/canonical_mesh.h"
#include "faceprobe/face/face.h"
#include "faceprobe/face/region.h"

#include <Eigen/Core>
#include <functional>
#include <string>

namespace faceprobe::face {

// An axis-aligned crop of the photo, resampled by one scale.
struct Crop {
  double x_px = 0, y_px = 0;  // top left corner in the photo; may be negative
  double scale = 1;           // crop pixels per photo pixel
  int width = 0, height = 0;  // of the crop

  // Points, not indices: the centre of pixel (x, y) is (x + .5, y + .5), in the crop as in the photo.
  Eigen::Vector2d photo_from_crop(double x, double y) const { return {x_px + x / scale, y_px + y / scale}; }
  Eigen::Vector2d crop_from_photo(double x, double y) const { return {(x - x_px) * scale, (y - y_px) * scale}; }
};

struct GeometryOptions {
  int long_side_px = 256;  // of the crop; never more than the photo has
  double margin = 0.15;    // of the landmarks' box, on each side

  std::string validate() const;
};

struct FaceGeometry {
  Crop crop;
  Image normal_cam;      // crop x 3, unit, camera frame; 0 where not face
  Image position_cam_m;  // crop x 3, metres, camera frame (z < 0); 0 where not face
  Image view_cam;        // crop x 3, unit, from the surface to the camera; defined everywhere
  ByteImage region;      // crop x 1, Region
  // Crop x 1: the angle by which the normal is expected to be off, from what made it; empty = not known, as of the mesh.
  Image normal_error_rad = {};
};

// Puts another surface of a face over the mesh's: normal_cam and position_cam_m where it covers them, and normal_error_rad if it knows.
// pipeline/head_geometry.h makes one of a head model.
using SurfaceFit = std::function<void(const Face&, const Camera&, FaceGeometry&)>;

// The crop that a face gets: its box and the margin, cut off half a photo outside. Throws Error(kUsage) for options that do not validate.
Crop face_crop(const Face& face, int photo_width, int photo_height, const GeometryOptions& options);

// Normals are averaged at the vertices (weighted by angle) and interpolated perspective-correctly.
FaceGeometry rasterize(const Face& face, const Camera& camera, const CanonicalMesh& mesh, const Crop& crop);
// Its region alone (crop x 1, Region), for large crops.
ByteImage rasterize_regions(const Face& face, const Camera& camera, const CanonicalMesh& mesh, const Crop& crop);

// The photo resampled into the crop: area average when smaller, bilinear when larger; black outside the photo. As many channels as it has.
// Here and below: throws Error(kUsage) unless the crop's scale is above 0 and its size not negative.
Image crop_picture(const Image& linear, const Crop& crop, int threads = 0);
// Bit flags resampled into the crop: a bit is set where any covered pixel has it; 0xFF outside the photo.
ByteImage crop_flags(const ByteImage& flags, const Crop& crop);

}  // namespace faceprobe::face
