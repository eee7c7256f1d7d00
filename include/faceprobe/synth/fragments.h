#pragma once
// What a camera sees of a scene, as a list of fragments: for each pixel one for every surface that covers part of it, with the share
// it covers. Light is computed per fragment, so edges and hairs are anti-aliased at the cost of few more rows than pixels.
//
//   const Fragments seen = find_fragments(scene, camera, {.samples_per_side = 4});

#include "faceprobe/synth/mesh.h"
#include "faceprobe/synth/scene.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace faceprobe::synth {

// A pinhole camera with square pixels; it looks along its own -z, +x right, +y up.
struct PinholeCamera {
  int width_px = 128;
  int height_px = 128;
  float focal_px = 200.0F;
  Eigen::Vector2f centre_px{64.0F, 64.0F};                              // principal point, from the top left corner
  Eigen::Isometry3f camera_from_scene = Eigen::Isometry3f::Identity();  // metres

  // Pixel coordinates of a point of the camera's frame with z < 0.
  Eigen::Vector2f project(const Eigen::Vector3f& point_cam) const;
  // Unit direction, camera frame, through a point of the picture.
  Eigen::Vector3f ray_cam(const Eigen::Vector2f& pixel) const;
};

struct FragmentOptions {
  int samples_per_side = 3;  // primary rays per pixel and side
  int threads = 0;           // 0 = all
};

// #F fragments, ordered by pixel. Positions, normals and tangents are in the scene's frame.
// Lenses do not hide what is behind them: share of the pixel under a lens and its normal, in lens fragments of their own with
// material kLens, whose coverage is NOT part of the sum with the others.
struct Fragments {
  int width_px = 0;
  int height_px = 0;
  float pixel_rad = 0;          // angle that a pixel takes, 1 / focal_px; 0 = not known, and shadows' edges stay hard
  std::vector<int> pixel;       // y * width_px + x
  std::vector<float> coverage;  // share of the pixel, (0, 1]; the rest of a pixel is background
  std::vector<Material> material;
  std::vector<Region> region;
  std::vector<std::uint16_t> figure;  // which person
  std::vector<std::uint16_t> part;    // index in the figure's meshes, or, for hair, in its strands
  std::vector<float> tone;            // strand's tone; 1 elsewhere
  Eigen::MatrixX3f position;          // #F x 3, metres; the arrays below have #F rows too
  Eigen::MatrixX3f normal;            // smooth, unit length; for hair, towards the camera and across the strand
  Eigen::MatrixX3f tangent;           // along the strand, unit length; zero elsewhere
  Eigen::MatrixX2f uv;                // zero where the mesh has none
  Eigen::MatrixX3i vertex;            // the scene's vertex numbers (Scene::vertex_offset + mesh vertex); -1 for hair
  Eigen::MatrixX3f weights;           // barycentric
  Eigen::VectorXf depth_m;            // along the camera's -z
  Eigen::VectorXf slope_variance;     // of the normals within the pixel, per axis; empty = none
  // The vertices around all primary rays of a fragment, with the mean of their weights: those of fragment i are
  // mix_vertex[mix_first[i]] .. [mix_first[i + 1] - 1]. Light that is known at vertices is averaged over the pixel by them.
  std::vector<int> mix_first{0};
  std::vector<int> mix_vertex;
  std::vector<float> mix_weight;

  int count() const { return static_cast<int>(pixel.size()); }
};

// At most four surfaces a pixel (the share of others goes to the largest), lenses apart. A mesh that lies before itself by more than 6 mm
// or 6 pixels is two surfaces. Material and region are those of the hit nearest to the fragment's mean, region by its nearest vertex.
Fragments find_fragments(const Scene& scene, const PinholeCamera& camera, const FragmentOptions& options = {});

}  // namespace faceprobe::synth
