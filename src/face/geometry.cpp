#include "faceprobe/face/geometry.h"

#include "face/raster.h"
#include "faceprobe/core/error.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::face {

std::string GeometryOptions::validate() const {
  if (long_side_px < 16 || long_side_px > 8192) {
    return "The face crop's long side is " + std::to_string(long_side_px) + " px; it must be 16 to 8192 px.";
  }
  if (!(margin >= 0 && margin <= 2)) {
    return "The face crop's margin is " + std::to_string(margin) + "; it must be 0 to 2 times the face's size.";
  }
  return {};
}

Crop face_crop(const Face& face, int photo_width, int photo_height, const GeometryOptions& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  // A face is cut off half a photo outside: given landmarks may claim any size.
  const auto interval = [](double start, double size, double margin, int photo) {
    const double low = std::clamp(std::floor(start - margin * size), -0.5 * photo, 1.5 * photo);
    const double high = std::clamp(std::ceil(start + (1 + margin) * size), -0.5 * photo, 1.5 * photo);
    return std::pair{low, std::max(high - low, 1.0)};
  };
  const auto [x, width] =
      interval(static_cast<double>(face.box.x), static_cast<double>(face.box.width), options.margin, photo_width);
  const auto [y, height] =
      interval(static_cast<double>(face.box.y), static_cast<double>(face.box.height), options.margin, photo_height);

  Crop crop;
  crop.x_px = x;
  crop.y_px = y;
  crop.scale = std::min(options.long_side_px / std::max(width, height), 1.0);
  crop.width = std::max(1, static_cast<int>(std::lround(width * crop.scale)));
  crop.height = std::max(1, static_cast<int>(std::lround(height * crop.scale)));
  return crop;
}

namespace {

std::vector<Fragment> fragments_of(const Face& face, const Camera& camera, const CanonicalMesh& mesh, const Crop& crop) {
  const Eigen::MatrixX3f& vertices = face.vertices_cam_m;
  Eigen::MatrixX2d points(vertices.rows(), 2);
  for (Eigen::Index i = 0; i < vertices.rows(); ++i) {
    const Eigen::Vector2d photo = camera.project(vertices.row(i).transpose().cast<double>());
    points.row(i) = crop.crop_from_photo(photo.x(), photo.y()).transpose();
  }
  const Eigen::VectorXd depths = -vertices.col(2).cast<double>();
  return rasterize_triangles(points, depths, mesh.triangles, crop.width, crop.height);
}

}  // namespace

ByteImage rasterize_regions(const Face& face, const Camera& camera, const CanonicalMesh& mesh, const Crop& crop) {
  const std::vector<Fragment> fragments = fragments_of(face, camera, mesh, crop);
  const std::vector<Region> regions = triangle_regions(mesh);
  ByteImage out(crop.width, crop.height, 1);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const int triangle = fragments[i].triangle;
    if (triangle >= 0) out.data()[i] = static_cast<std::uint8_t>(regions[static_cast<std::size_t>(triangle)]);
  }
  return out;
}

FaceGeometry rasterize(const Face& face, const Camera& camera, const CanonicalMesh& mesh, const Crop& crop) {
  const Eigen::MatrixX3f& vertices = face.vertices_cam_m;
  const std::vector<Fragment> fragments = fragments_of(face, camera, mesh, crop);
  const Eigen::MatrixX3f normals = vertex_normals(vertices, mesh.triangles);
  const std::vector<Region> regions = triangle_regions(mesh);

  FaceGeometry geometry{crop, Image(crop.width, crop.height, 3), Image(crop.width, crop.height, 3),
                        Image(crop.width, crop.height, 3), ByteImage(crop.width, crop.height, 1)};
  for (int y = 0; y < crop.height; ++y) {
    for (int x = 0; x < crop.width; ++x) {
      const Eigen::Vector2d photo = crop.photo_from_crop(x + 0.5, y + 0.5);
      Eigen::Map<Eigen::Vector3f>(geometry.view_cam.pixel(x, y)) =
          camera.view_direction(photo.x(), photo.y()).cast<float>();
      const Fragment& fragment =
          fragments[static_cast<std::size_t>(y) * static_cast<std::size_t>(crop.width) + static_cast<std::size_t>(x)];
      if (fragment.triangle < 0) continue;
      Eigen::Vector3f normal = Eigen::Vector3f::Zero();
      Eigen::Vector3f position = Eigen::Vector3f::Zero();
      for (int k = 0; k < 3; ++k) {
        const int vertex = mesh.triangles(fragment.triangle, k);
        normal += fragment.weights(k) * normals.row(vertex).transpose();
        position += fragment.weights(k) * vertices.row(vertex).transpose();
      }
      Eigen::Map<Eigen::Vector3f>(geometry.normal_cam.pixel(x, y)) = normal.normalized();
      Eigen::Map<Eigen::Vector3f>(geometry.position_cam_m.pixel(x, y)) = position;
      geometry.region(x, y) = static_cast<std::uint8_t>(regions[static_cast<std::size_t>(fragment.triangle)]);
    }
  }
  return geometry;
}

}  // namespace faceprobe::face
