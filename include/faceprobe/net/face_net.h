#pragma once
// All that a trained network sees in the picture of one face: its highlights, and the surface and light beneath them. One network with one
// trunk, because each answer helps the others: a bright spot is a highlight or light skin according to where its normal points. Give it a
// crop of one face with a head's room around it, at about the size it was trained at (128 px); it was trained on faces only. Weights that say so
// look twice, at all of the crop and from near at the face mask. Runs on the processor.
//
//   const net::FaceNet network("models/face.safetensors", {.threads = 0});
//   const net::FaceLayers layers = network.layers(crop, clip, mask, mesh_normals);
//   Eigen::Vector3f normal(layers.normal_cam.pixel(x, y));
//   // diffuse = crop - layers.highlight; albedo = diffuse / layers.shading
//
// Not for metric depth (`depth_m` has an origin of its own; place it by the head's pose), and not for hair, glasses and clothes, whose
// normals it has never been asked for.

#include "faceprobe/core/image.h"
#include "faceprobe/net/model_file.h"

#include <filesystem>
#include <memory>
#include <string>

namespace faceprobe::net {

// Pictures of the crop's size. The highlight ends where the mask does; the rest is defined everywhere and means something on skin.
struct FaceLayers {
  Image highlight;         // 3 channels, linear; 0 <= highlight <= picture
  Image normal_cam;        // 3 channels, unit, camera frame (+x right, +y up, +z to the viewer)
  Image normal_error_rad;  // 1 channel, > 0: the angle by which the normal is expected to be off
  Image depth_m;           // 1 channel, larger = further from the camera, up to a constant
  Image shading;           // 3 channels, > 0: the diffuse layer over the albedo, irradiance / pi on the picture's scale
  ByteImage region;        // 1 channel, Region
  // 3 channels, > 0: the shading that would be there if nothing stood in the light's way, neither brow nor shoulder, and sent none back: what a
  // ball would show. Empty of weights that were not trained for it.
  Image open_shading = {};
};

struct FaceNetOptions {
  int threads = 0;  // 0 = all processors; the result does not depend on it

  std::string validate() const;
};

class FaceNet {
 public:
  // Throws Error(kModel): the file is not there, damaged, or of another network; Error(kUsage): the options do not validate.
  explicit FaceNet(const std::filesystem::path& weights, const FaceNetOptions& options = {});
  FaceNet(const FaceNet&) = delete;
  FaceNet& operator=(const FaceNet&) = delete;
  FaceNet(FaceNet&&) noexcept;
  FaceNet& operator=(FaceNet&&) noexcept;
  ~FaceNet();

  // Pictures as HighlightNet::highlight takes them; a grey one gives grey highlights and grey shading. `mesh_normal_cam`: H x W x 3, the
  // normals of the dense mesh as face::rasterize has them, zero off it; empty = there is no mesh, and much is a guess. Half the light gives
  // half of every layer, but for what is clipped. May be called from several threads. Throws std::invalid_argument when sizes or channels
  // differ.
  FaceLayers layers(const Image& linear, const ByteImage& clip, const ByteImage& mask,
                    const Image& mesh_normal_cam) const;
  // Mean of what it sees in the picture and in its mirror image; takes twice the time. The region is the picture's own.
  FaceLayers layers_both_ways(const Image& linear, const ByteImage& clip, const ByteImage& mask,
                              const Image& mesh_normal_cam) const;

  const ModelInfo& info() const;  // what the weights file says of itself

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace faceprobe::net
