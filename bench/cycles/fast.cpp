#include "cycles/fast.h"

#include "faceprobe/core/parallel.h"
#include "faceprobe/core/sphere_grid.h"

#include <Eigen/Geometry>

namespace faceprobe::bench {

namespace {

// Mean of the fragments' values over each pixel, weighted by what they cover; empty pixels are black.
Image gather(const synth::Fragments& fragments, const Eigen::MatrixX3f& values) {
  Image out(fragments.width_px, fragments.height_px, 3);
  for (int i = 0; i < fragments.count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    float* pixel = out.data() + 3 * static_cast<std::size_t>(fragments.pixel[k]);
    for (int c = 0; c < 3; ++c) pixel[c] += fragments.coverage[k] * values(i, c);
  }
  return out;
}

std::vector<synth::Figure> one_figure(const synth::SurfaceMesh& mesh) {
  std::vector<synth::Figure> figures(1);
  figures[0].meshes.push_back(mesh);
  return figures;
}

}  // namespace

FastView::FastView(const synth::SurfaceMesh& mesh, const synth::PinholeCamera& camera, float roughness, float f0,
                   const synth::TransportOptions& options)
    : camera_(camera), options_(options), scene_(one_figure(mesh)) {
  synth::Fragments seen = synth::find_fragments(scene_, camera, {.threads = options.threads});
  const synth::Fragments* views[] = {&seen};
  transport_ = synth::build_scene_transport(scene_, synth::vertices_seen(views), options);
  synth::FragmentSurface surface{seen.normal, Eigen::VectorXf::Constant(seen.count(), roughness),
                                 Eigen::VectorXf::Constant(seen.count(), f0)};
  const Eigen::Vector3f camera_position = camera.camera_from_scene.inverse().translation();
  view_ = synth::build_view_transport(scene_, transport_, std::move(seen), std::move(surface), camera_position, options);
  seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

std::vector<FastPicture> FastView::render(std::span<const TurnedMap> maps) const {
  const auto count = static_cast<int>(maps.size());
  const SphereGrid grid(options_.nside);
  const Eigen::Matrix3f scene_from_camera = camera_.camera_from_scene.linear().transpose();
  std::vector<synth::LightSample> samples(maps.size());
  parallel_for(count, options_.threads, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const TurnedMap& turned = maps[static_cast<std::size_t>(i)];
      const Eigen::Matrix3f turn = Eigen::AngleAxisf(turned.yaw, Eigen::Vector3f::UnitY()).toRotationMatrix();
      samples[static_cast<std::size_t>(i)] =
          synth::light_from_map(*turned.map, scene_from_camera * turn, Eigen::Vector3f::Ones(), grid);
    }
  });
  const std::vector<synth::FragmentLight> light =
      synth::shade(scene_, transport_, view_, samples, {.threads = options_.threads});
  std::vector<FastPicture> out(maps.size());
  parallel_for(count, options_.threads, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const auto k = static_cast<std::size_t>(i);
      out[k] = {gather(view_.fragments, light[k].shading), gather(view_.fragments, light[k].specular)};
    }
  });
  return out;
}

ByteImage FastView::fully_covered(int vertices) const {
  const synth::Fragments& fragments = view_.fragments;
  std::vector<float> coverage(static_cast<std::size_t>(camera_.width_px) * static_cast<std::size_t>(camera_.height_px),
                              0.0F);
  for (int i = 0; i < fragments.count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (fragments.vertex.row(i).maxCoeff() < vertices)
      coverage[static_cast<std::size_t>(fragments.pixel[k])] += fragments.coverage[k];
  }
  ByteImage out(camera_.width_px, camera_.height_px, 1);
  for (std::size_t i = 0; i < coverage.size(); ++i) out.values()[i] = coverage[i] > 0.999F ? 1 : 0;
  return out;
}

}  // namespace faceprobe::bench
