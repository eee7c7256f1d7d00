#include "faceprobe/synth/compose.h"

#include <array>
#include <cmath>

namespace faceprobe::synth {
namespace {

bool is_lens(const Fragments& fragments, int i) {
  return fragments.material[static_cast<std::size_t>(i)] == Material::kLens;
}

Eigen::MatrixX2f project(const PinholeCamera& camera, const Eigen::Isometry3f& camera_from_head,
                         const Eigen::MatrixX3f& points_head) {
  Eigen::MatrixX2f pixels(points_head.rows(), 2);
  for (Eigen::Index i = 0; i < points_head.rows(); ++i) {
    pixels.row(i) = camera.project(camera_from_head * Eigen::Vector3f(points_head.row(i).transpose())).transpose();
  }
  return pixels;
}

FaceMarks marks_of(const Person& person, const PinholeCamera& camera) {
  FaceMarks marks;
  marks.camera_from_head = camera.camera_from_scene * person.scene_from_head;
  marks.landmarks_px = project(camera, marks.camera_from_head, person.head.landmarks);
  marks.dense_landmarks_px = project(camera, marks.camera_from_head, person.head.dense_landmarks);
  marks.identity = person.parameters.identity;
  marks.expression = person.parameters.expression;
  marks.person = person.number;
  return marks;
}

// Number in `people` of whose figure it is, plus 1.
std::uint8_t owner_of(std::span<const Person> people, int figure) {
  for (std::size_t p = 0; p < people.size(); ++p) {
    if (people[p].owns_figure(figure)) return static_cast<std::uint8_t>(p + 1);
  }
  return 0;
}

}  // namespace

ViewLayers view_layers(std::span<const Person> people, const View& view, const Fragments& fragments) {
  const int width = fragments.width_px;
  const int height = fragments.height_px;
  ViewLayers layers;
  layers.normal = Image(width, height, 3);
  layers.depth_m = Image(width, height, 1);
  layers.region = ByteImage(width, height, 1);
  layers.owner = ByteImage(width, height, 1);
  Image cover(width, height, 1);
  Image largest(width, height, 1);  // share of the region that is written
  const Eigen::Matrix3f turn = view.camera.camera_from_scene.linear();
  for (int i = 0; i < fragments.count(); ++i) {
    if (is_lens(fragments, i)) continue;
    const auto k = static_cast<std::size_t>(i);
    const int x = fragments.pixel[k] % width;
    const int y = fragments.pixel[k] / width;
    const float c = fragments.coverage[k];
    const Eigen::Vector3f normal_cam = turn * fragments.normal.row(i).transpose();
    for (int axis = 0; axis < 3; ++axis) layers.normal(x, y, axis) += c * normal_cam(axis);
    layers.depth_m(x, y) += c * fragments.depth_m(i);
    cover(x, y) += c;
    if (c > largest(x, y)) {
      largest(x, y) = c;
      layers.region(x, y) = static_cast<std::uint8_t>(fragments.region[k]);
      layers.owner(x, y) = owner_of(people, fragments.figure[k]);
    }
  }
  for (int i = 0; i < fragments.count(); ++i) {  // what is seen through a lens is under glass
    const auto k = static_cast<std::size_t>(i);
    if (is_lens(fragments, i) && fragments.coverage[k] > 0.5F) {
      layers.region(fragments.pixel[k] % width, fragments.pixel[k] / width) =
          static_cast<std::uint8_t>(Region::kGlasses);
    }
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (cover(x, y) <= 0) continue;
      const Eigen::Map<Eigen::Vector3f> normal(layers.normal.pixel(x, y));
      const float length = normal.norm();
      if (length > 0) Eigen::Map<Eigen::Vector3f>(layers.normal.pixel(x, y)) /= length;
      layers.depth_m(x, y) /= cover(x, y);
      if (cover(x, y) >= 0.5F) continue;
      layers.region(x, y) = static_cast<std::uint8_t>(Region::kNone);
      layers.owner(x, y) = 0;
    }
  }
  layers.focal_px = view.camera.focal_px;
  layers.centre_px = view.camera.centre_px;
  for (const Person& person : people) layers.faces.push_back(marks_of(person, view.camera));
  return layers;
}

LinearLayers gather_layers(const Fragments& fragments, const ViewSurface& surface, const Eigen::MatrixX3f& shading,
                           const Eigen::MatrixX3f& specular, const Image& background, const Eigen::Vector3f& gain) {
  const int width = fragments.width_px;
  const int height = fragments.height_px;
  LinearLayers layers{Image(width, height, 3), Image(width, height, 3), Image(width, height, 3),
                      Image(width, height, 3)};
  std::vector<float> cover(layers.diffuse.pixel_count(), 0.0F);
  for (int i = 0; i < fragments.count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const int pixel = fragments.pixel[k];
    const float share = fragments.coverage[k];
    float* highlight = layers.highlight.data() + static_cast<std::ptrdiff_t>(3) * pixel;
    float* diffuse = layers.diffuse.data() + static_cast<std::ptrdiff_t>(3) * pixel;
    float* albedo = layers.albedo.data() + static_cast<std::ptrdiff_t>(3) * pixel;
    for (int c = 0; c < 3; ++c) {
      highlight[c] += share * surface.specular_albedo(i) * specular(i, c) * gain(c);
    }
    if (is_lens(fragments, i)) continue;
    for (int c = 0; c < 3; ++c) {
      diffuse[c] += share * surface.albedo(i, c) * shading(i, c) * gain(c);
      albedo[c] += share * surface.albedo(i, c);
    }
    cover[static_cast<std::size_t>(pixel)] += share;
  }
  for (std::size_t pixel = 0; pixel < cover.size(); ++pixel) {
    const float rest = std::max(0.0F, 1.0F - cover[pixel]);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t at = 3 * pixel + c;
      const float albedo = layers.albedo.data()[at];
      layers.shading.data()[at] = albedo > 0 ? layers.diffuse.data()[at] / albedo : 0.0F;
      layers.diffuse.data()[at] += rest * background.data()[at];
    }
  }
  return layers;
}

}  // namespace faceprobe::synth
