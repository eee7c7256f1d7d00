#pragma once
// From a photo to the light in it: the whole way, in one call.
//
//   #include <faceprobe/pipeline/estimate.h>
//   #include <faceprobe/io/picture_file.h>
//
//   int main() {
//     using namespace faceprobe;
//     pipeline::Estimator estimator;                                     // loads the models once
//     const io::Photo photo = io::load_photo("portrait.jpg");
//     const pipeline::Estimate estimate = estimator.estimate(photo);     // throws Error(kNoFace) when there is none
//     const pipeline::FaceEstimate& face = estimate.largest_face();
//     io::write_env_map("light.exr", face.environment);
//     for (const lighting::MainLight& light : face.lights) { /* light.direction, light.colour, light.share */ }
//   }
//
// One Estimator serves one thread at a time; make several for several threads.

#include "faceprobe/core/env_map.h"
#include "faceprobe/face/face.h"
#include "faceprobe/face/geometry.h"
#include "faceprobe/highlight/separate.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/lighting/estimate.h"
#include "faceprobe/lighting/main_lights.h"

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace faceprobe::pipeline {

// Where the normals, or albedo and shading come from. With a classical separator no network of ours is asked: they are the mesh's and the regions', but for what is given.
enum class NormalSource {
  kMesh,  // the dense face mesh, posed
  kNet,   // the network, per pixel, with an error of its own
  kFit,   // a head model fitted to the landmarks: EstimateOptions::surface_fit
};
enum class ShadingSource {
  kRegions,  // one albedo a region, see lighting/albedo.h
  kNet,      // the network's shading; what the diffuse layer is beyond it is albedo
  kGiven,    // the same with the shading of EstimateOptions::shading_split
};
// The shading in a face's diffuse layer (a crop of one face of at most 128 px, H x W x 3, linear): as large, finite, 0 or more, at any level.
// Such as that of the paper's Albedo-Shading network, net::TorchShadingNet, which tells by it what colour highlights have (lighting/recolour.h).
using ShadingSplit = std::function<Image(const Image& diffuse)>;

// What light the transport solver starts from, and leaves where no skin looks.
enum class PriorSource {
  kSmooth,  // a lamp and an even surround that fit the shading
  kNet,     // what the light prior has learnt to expect, see net/light_prior.h
};

struct EstimateOptions {
  face::FinderOptions finder;
  // How highlights are taken off: by the trained network (net/face_net.h) where unset, else by a classical separator.
  std::optional<highlight::Separator> classical;
  std::filesystem::path weights;  // of the network, "face" or "unet"; empty = those that come with the program (models/README.md)
  NormalSource normals = NormalSource::kNet;
  face::SurfaceFit surface_fit;  // for NormalSource::kFit
  ShadingSource shading = ShadingSource::kNet;
  ShadingSplit shading_split;             // for ShadingSource::kGiven
  PriorSource prior = PriorSource::kNet;  // with a classical separator the smooth one, which needs no network
  std::filesystem::path prior_weights;    // empty = those that come with the program
  // Least share of a face's crop that the photo must show for the network's layers; below, the classical separator and the regions step in,
  // and its normals alone are used, and no prior, which learnt from the network's layers. The network learnt from whole heads; of the middle of
  // a face alone it makes shading a highlight.
  double least_shown = 2.0 / 3.0;
  lighting::SolveOptions solve;
  lighting::MainLightOptions main_lights;
  // Focal length in pixels of the photo; unset = from EXIF, else a 50 mm lens on a 36 x 24 mm frame (a common portrait view).
  std::optional<double> focal_px;
  // Five or 68 landmarks (#points x 2, px) of one face, instead of detection; see face::FaceFinder::from_landmarks.
  std::optional<Eigen::MatrixX2f> landmarks_px;
  int layer_px = 512;          // long side of the crop that layers and geometry are made at; never enlarged
  int max_patches = 1000;      // observations per face
  int map_width = 256;         // of the environment maps; the height is half
  int sh_order = 2;            // of the coefficients reported
  int threads = 0;             // 0 = all; handed to every stage
  bool deterministic = false;  // bitwise the same result for any number of threads

  // Empty when usable, else a sentence that says which value is wrong.
  std::string validate() const;
  // Whether the light prior has a say: not beside a classical separator or the paper's solver.
  bool asks_prior() const;
  // "net", or the classical separator's name: what reports call it.
  std::string separator_name() const;
};

// What one light estimate amounts to, in every form people use.
struct LightResult {
  lighting::Light light;                    // per cell of SphereGrid(options.solve.nside)
  EnvMap environment;                       // the same as a lat-long map
  EnvMap confidence;                        // 0..1 in all three channels
  Eigen::MatrixX3d sh;                      // (order + 1)^2 x 3 radiance coefficients, see core/sh.h
  Eigen::MatrixX3d sh4;                     // 25 x 3, the same of order 4 whatever options.sh_order
  std::vector<lighting::MainLight> lights;  // by falling strength
};

// What a face was read by. That is less than the options ask for where the photo shows too little of it, or where the network's weights tell
// highlights alone.
struct FaceSources {
  std::optional<highlight::Separator> classical;  // which took the highlights off; unset = the network
  NormalSource normals = NormalSource::kMesh;
  ShadingSource shading = ShadingSource::kRegions;
  PriorSource prior = PriorSource::kSmooth;
};

// What a face has from the other photos of its person, Estimator::same_person().
struct SamePerson {
  std::size_t photos = 0;  // that took part, this one among them
  Eigen::Vector3f shading_gain =
      Eigen::Vector3f::Ones();  // what the light of this photo was multiplied by: own albedo over the person's
  Eigen::Vector3f albedo = Eigen::Vector3f::Zero();  // the person's mean albedo, linear
  double trust = 1;  // weight of this photo's own colour among the others: 1 where it agrees, towards 0 for an outlier
};

struct FaceEstimate : LightResult {
  face::Face face;
  bool enough_shown =
      true;  // of the face, for the network's layers and the light prior; see EstimateOptions::least_shown
  FaceSources sources;
  face::FaceGeometry geometry;   // crop
  Image picture;                 // the photo in the crop, linear
  ByteImage clipped;             // io::Photo flags in the crop
  highlight::Layers layers;      // crop, skin only
  Image albedo;                  // crop, linear
  Image shading;                 // crop: diffuse / albedo, i.e. irradiance / pi; 0 off the skin
  Eigen::Vector3f light_colour;  // mean light by the skin and white-balance priors, green = 1
  // See lighting::AlbedoModel; of the regions' albedo alone, the network states no error.
  std::optional<double> light_colour_uncertainty_deg;
  lighting::Observations observations;
  std::optional<SamePerson> same_person;  // by Estimator::same_person() alone
};

// The diffuse layer over the shading, both summed over skin that is neither clipped nor lips or brows: the skin's albedo, linear, mean by the light
// that falls on it. Nothing where there is no light on the skin. The level is the one that ShadingSource assumes of skins: a dark skin and a short
// exposure make the same photo, so it does not tell how light a skin is.
std::optional<Eigen::Vector3f> mean_skin_albedo(const FaceEstimate& face);

// What one light for several faces needs of each of them.
struct FaceEvidence {
  lighting::Observations observations;
  double energy = 0;  // luminance of its own light, summed over the sphere's cells
  bool enough_shown = true;
};
// Of a face that has been estimated; its own light's energy goes along.
FaceEvidence evidence_of(const FaceEstimate& face);

struct StageTime {
  std::string stage;
  double seconds = 0;  // of wall time; of all faces together
};

// Told the name of each stage as it ends, on the calling thread; stages of several faces come again for each.
using StageDone = std::function<void(std::string_view stage)>;

enum class FocalSource { kGiven, kExif, kDefault };

struct Estimate {
  int photo_width = 0;
  int photo_height = 0;
  face::Camera camera;
  FocalSource focal_source = FocalSource::kDefault;
  std::vector<FaceEstimate> faces;    // left to right; never empty
  std::size_t largest = 0;            // index of the face with the largest box
  std::optional<LightResult> joint;   // from two faces on: one distant light for all of them
  std::vector<StageTime> timings;     // in order
  std::vector<std::string> warnings;  // sentences

  const FaceEstimate& largest_face() const { return faces[largest]; }
};

class Estimator {
 public:
  // Throws Error(kUsage) when the options do not validate, Error(kModel) when a model file is missing.
  explicit Estimator(EstimateOptions options = {});
  ~Estimator();
  Estimator(const Estimator&) = delete;
  Estimator& operator=(const Estimator&) = delete;
  Estimator(Estimator&&) noexcept;
  Estimator& operator=(Estimator&&) noexcept;

  // As given, with the threads of the finder and the solver set from `threads`.
  const EstimateOptions& options() const;
  // Throws Error(kNoFace) when no usable face is found, or all show too little skin; Error(kUsage) for a photo without pixels.
  Estimate estimate(const io::Photo& photo, const StageDone& stage_done = {}) const;
  // From what a face says to the light, by the options' prior and solver; the last step of estimate(), for observations from elsewhere.
  // Throws std::invalid_argument for observations that do not validate. Without `ask_prior` the solver starts from the smooth fit.
  lighting::Light light_of(const lighting::Observations& observations, bool ask_prior = true) const;
  // One distant light for faces of one photo, or of several that the same camera took from the same place in the same light, such as a burst:
  // more patches, each with noise of its own. Every face is first scaled to the mean energy of the single estimates, because photos tell
  // neither albedos nor exposures. Of grey faces alone the light is grey. The prior is asked when the photos show enough of all of them. Many faces are thinned to options().max_patches
  // in all. Throws std::invalid_argument for none.
  LightResult joint(const std::vector<FaceEvidence>& faces) const;
  // Photos of one person, each in a light of its own: what belongs to the person is made one. Each face's albedo takes the person's level and tint,
  // region by region (lighting/shared_skin.h), its shading what that leaves of the diffuse layer, and the highlights' gain is the person's too
  // (lighting::shared_gain); then the lights are found again. So single photos' mistakes of skin for light average out, and the colours of the lights can
  // be compared; their levels as far as exposures can. Of each photo the largest face is taken; who it is is not looked at. Photos without lit
  // skin, or one photo, stay as they are. The estimates should be this estimator's, or of the same options.
  void same_person(std::vector<Estimate>& photos) const;
  // The faces alone, left to right; empty when there are none. Throws Error(kUsage) for a photo without pixels.
  std::vector<face::Face> find_faces(const io::Photo& photo) const;
  // The two layers at the photo's own size: H x W x 3 each, linear; highlight is 0 outside the faces' skin, diffuse is the
  // photo there. Throws Error(kNoFace); Error(kUsage) for a photo without pixels.
  highlight::Layers separate(const io::Photo& photo) const;

 private:
  LightResult joint_of(const Estimate& photo) const;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace faceprobe::pipeline
