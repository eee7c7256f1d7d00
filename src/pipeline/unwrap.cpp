#include "faceprobe/pipeline/unwrap.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/quantile.h"
#include "faceprobe/core/smooth_step.h"
#include "faceprobe/core/vertex_normals.h"
#include "pipeline/camera_of.h"
#include "pipeline/head_fit.h"
#include "pipeline/unwrap_fill.h"
#include "pipeline/unwrap_mirror.h"
#include "pipeline/unwrap_raster.h"
#include "pipeline/unwrap_shading.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace faceprobe::pipeline {
namespace {

constexpr float kDepthSlackM = 0.004F;    // of the depth test: a texel may lie this far behind what the picture shows
constexpr float kNearLandmarkM = 0.010F;  // up to here from a landmark the fit is trusted ...
constexpr float kFarLandmarkM = 0.022F;   // ... and beyond it hair, collar and ears begin
constexpr float kFacingFrom = 0.3F;       // cosine between normal and view
constexpr float kFacingTo = 0.7F;
constexpr float kBrowTopM = 0.040F;    // height above the eyes where brows have ended
constexpr float kFaceSideM = 0.060F;   // from the middle
constexpr float kPriorWeight = 0.01F;  // of the skin's mean colour against a texel that was seen
constexpr float kClippedWeight = 0.25F;

void check_model(const synth::HeadModel& model) {
  if (model.uv.rows() == 0 || model.triangle_uv.rows() != model.triangles.rows()) {
    throw Error(ExitCode::kModel, "The head model " + model.name +
                                      " has no texture coordinates, so no texture can be made for it; " +
                                      "give a model with UVs.");
  }
}

// Triangles of skin whose UVs lie in the unit square.
std::vector<int> textured_skin(const synth::HeadModel& model) {
  std::vector<int> chosen;
  for (int t = 0; t < model.triangles.rows(); ++t) {
    if (model.triangle_material[static_cast<std::size_t>(t)] != synth::Material::kSkin) continue;
    const Eigen::Matrix<float, 3, 2> uv = model.uv(model.triangle_uv.row(t), Eigen::all);
    if (uv.minCoeff() >= -1e-4F && uv.maxCoeff() <= 1.0001F) chosen.push_back(t);
  }
  if (chosen.empty()) {
    throw Error(ExitCode::kModel,
                "The head model " + model.name + " has no skin with texture coordinates between 0 and 1.");
  }
  return chosen;
}

// Which surface point each texel shows. `triangle_uv` vertices are turned into one row per UV.
MeshRaster raster_texels(const synth::HeadModel& model, const std::vector<int>& skin, int size_px) {
  Eigen::MatrixX3f points(model.uv.rows(), 3);
  points.col(0) = model.uv.col(0) * static_cast<float>(size_px);
  points.col(1) = (1.0F - model.uv.col(1).array()) * static_cast<float>(size_px);
  points.col(2).setZero();
  return raster_mesh(points, model.triangle_uv, skin, size_px, size_px);
}

// The face's part of the photo at about the texture's resolution.
struct FacePicture {
  face::Crop crop;
  Image linear;
  ByteImage clipped;
};

FacePicture face_picture(const io::Photo& photo, const face::Face& face, int size_px) {
  face::GeometryOptions options;
  options.long_side_px = 2 * size_px;  // the face takes up about half of a texture's width
  options.margin = 0.35;
  FacePicture out;
  out.crop = face::face_crop(face, photo.linear.width(), photo.linear.height(), options);
  out.linear = face::crop_picture(photo.linear, out.crop);
  out.clipped = face::crop_flags(photo.clipped, out.crop);
  return out;
}

// How near each vertex is to what the landmarks pin down, 0 .. 1.
Eigen::VectorXf landmark_nearness(const synth::HeadModel& model, const LandmarkPairs& pairs) {
  Eigen::VectorXf nearness = Eigen::VectorXf::Zero(model.neutral.rows());
  // The 51 points leave cheeks and forehead bare: there the rings around them have to be wider.
  const float widen = pairs.dense ? 1.0F : 2.2F;
  Eigen::MatrixX3f landmarks(static_cast<Eigen::Index>(pairs.model.size()), 3);
  for (Eigen::Index i = 0; i < landmarks.rows(); ++i) {
    landmarks.row(i) =
        surface_point(model.neutral, model.triangles, pairs.model[static_cast<std::size_t>(i)]).transpose();
  }
  for (Eigen::Index v = 0; v < nearness.size(); ++v) {
    const float distance = std::sqrt((landmarks.rowwise() - model.neutral.row(v)).rowwise().squaredNorm().minCoeff());
    nearness(v) = smooth_step(widen * kFarLandmarkM, widen * kNearLandmarkM, distance);
  }
  return nearness;
}

// Skin near the landmarks in the picture, for the separator: its statistics must not see hair and background.
ByteImage skin_mask(const synth::HeadModel& model, const MeshRaster& seen, const Eigen::VectorXf& nearness) {
  ByteImage mask(seen.width, seen.height, 1);
  for (int y = 0; y < seen.height; ++y) {
    for (int x = 0; x < seen.width; ++x) {
      const RasterCell& cell = seen.at(x, y);
      if (cell.triangle < 0 ||
          model.triangle_material[static_cast<std::size_t>(cell.triangle)] != synth::Material::kSkin)
        continue;
      const Eigen::Vector3f near = nearness(model.triangles.row(cell.triangle));
      mask(x, y) = near.dot(cell.weights) > 0.2F ? 1 : 0;
    }
  }
  return mask;
}

Eigen::Vector3f bilinear(const Image& picture, const Eigen::Vector2f& at) {
  const float x = std::clamp(at.x() - 0.5F, 0.0F, static_cast<float>(picture.width() - 1));
  const float y = std::clamp(at.y() - 0.5F, 0.0F, static_cast<float>(picture.height() - 1));
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, picture.width() - 1);
  const int y1 = std::min(y0 + 1, picture.height() - 1);
  const float fx = x - static_cast<float>(x0);
  const float fy = y - static_cast<float>(y0);
  const auto texel = [&picture](int column, int row) {
    return Eigen::Map<const Eigen::Vector3f>(picture.pixel(column, row));
  };
  return (1 - fy) * ((1 - fx) * texel(x0, y0) + fx * texel(x1, y0)) +
         fy * ((1 - fx) * texel(x0, y1) + fx * texel(x1, y1));
}

// The head as the photo shows it.
struct Seen {
  const synth::HeadModel& model;
  Eigen::MatrixX3f vertices_cam, normals_cam, points;
  Eigen::VectorXf nearness;
  MeshRaster raster;
  Image diffuse;
  ByteImage clipped;
};

// What the photo says about each texel.
struct Texels {
  Image colour, normal, weight, skin;  // `skin`: 1 where the landmarks say there is face, seen or not
};

// Whether nothing lies in front of a point of the picture; the slack is for edges, where the cells are coarse.
bool uncovered(const MeshRaster& raster, const Eigen::Vector2f& at, float depth) {
  const int x = static_cast<int>(std::floor(at.x()));
  const int y = static_cast<int>(std::floor(at.y()));
  if (x < 0 || y < 0 || x >= raster.width || y >= raster.height) return false;
  const RasterCell& cell = raster.at(x, y);
  return cell.triangle < 0 || depth < cell.depth + kDepthSlackM;
}

Texels read_texels(const Seen& seen, const MeshRaster& texels, int threads) {
  Texels out{Image(texels.width, texels.height, 3), Image(texels.width, texels.height, 3),
             Image(texels.width, texels.height, 1), Image(texels.width, texels.height, 1)};
  parallel_for(texels.height, threads, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < texels.width; ++x) {
        const RasterCell& cell = texels.at(x, y);
        if (cell.triangle < 0) continue;
        const Eigen::RowVector3i corners = seen.model.triangles.row(cell.triangle);
        const Eigen::RowVector3f w = cell.weights.transpose();
        const Eigen::Vector3f position = (w * seen.vertices_cam(corners, Eigen::all)).transpose();
        const Eigen::Vector3f normal = (w * seen.normals_cam(corners, Eigen::all)).transpose().normalized();
        const Eigen::Vector3f at = (w * seen.points(corners, Eigen::all)).transpose();
        const float near = seen.nearness(corners).dot(cell.weights);
        Eigen::Map<Eigen::Vector3f>(out.normal.pixel(x, y)) = normal;
        out.skin(x, y) = near;
        const bool inside = at.x() >= 0.5F && at.y() >= 0.5F &&
                            at.x() <= static_cast<float>(seen.diffuse.width()) - 0.5F &&
                            at.y() <= static_cast<float>(seen.diffuse.height()) - 0.5F;
        if (!inside || near <= 0.0F || !uncovered(seen.raster, at.head<2>(), at.z())) continue;
        const std::uint8_t flags = seen.clipped(static_cast<int>(at.x()), static_cast<int>(at.y()));
        if (flags == 0xFF) continue;  // outside the photo
        float weight = near * smooth_step(kFacingFrom, kFacingTo, normal.dot(-position.normalized()));
        if (flags != 0) weight *= kClippedWeight;
        out.weight(x, y) = weight;
        Eigen::Map<Eigen::Vector3f>(out.colour.pixel(x, y)) = bilinear(seen.diffuse, at.head<2>());
      }
    }
  });
  return out;
}

// Where the surface is bare skin: what shading is read from.
Image bare_skin(const synth::HeadModel& model, const MeshRaster& texels, const Image& weight) {
  Image bare = weight;
  if (model.vertex_region.size() != static_cast<std::size_t>(model.neutral.rows())) return bare;
  for (int y = 0; y < texels.height; ++y) {
    for (int x = 0; x < texels.width; ++x) {
      const RasterCell& cell = texels.at(x, y);
      if (cell.triangle < 0) continue;
      for (int corner = 0; corner < 3; ++corner) {
        const auto vertex = static_cast<std::size_t>(model.triangles(cell.triangle, corner));
        if (!is_probe_skin(model.vertex_region[vertex])) bare(x, y) = 0;
      }
    }
  }
  return bare;
}

// The skin's own colour: weighted mean over what is within half and one and a half of the median lightness.
Eigen::Vector3f skin_colour(const Image& colour, const Image& bare) {
  std::vector<float> light;
  for (int y = 0; y < colour.height(); ++y) {
    for (int x = 0; x < colour.width(); ++x) {
      if (bare(x, y) > 0.5F) light.push_back(luminance(colour.pixel(x, y)));
    }
  }
  if (light.empty()) return Eigen::Vector3f::Constant(0.3F);
  const float middle = upper_median_of(std::move(light));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  for (int y = 0; y < colour.height(); ++y) {
    for (int x = 0; x < colour.width(); ++x) {
      const float relative = luminance(colour.pixel(x, y)) / std::max(1e-6F, middle);
      if (bare(x, y) <= 0.5F || relative < 0.5F || relative > 1.5F) continue;
      sum += Eigen::Map<const Eigen::Vector3f>(colour.pixel(x, y)).cast<double>();
      count += 1.0;
    }
  }
  return count > 0 ? Eigen::Vector3f((sum / count).cast<float>()) : Eigen::Vector3f::Constant(middle);
}

// Fringes and sideburns: what is dark well above the brows or beside the face is hair, and not the skin's.
void drop_hair(const synth::HeadModel& model, const MeshRaster& texels, const Eigen::Vector3f& skin, Image& weight,
               const Image& colour) {
  const float skin_light = std::max(1e-6F, luminance(skin.data()));
  for (int y = 0; y < texels.height; ++y) {
    for (int x = 0; x < texels.width; ++x) {
      const RasterCell& cell = texels.at(x, y);
      if (cell.triangle < 0 || weight(x, y) <= 0.0F) continue;
      const Eigen::RowVector3f p =
          cell.weights.transpose() * model.neutral(model.triangles.row(cell.triangle), Eigen::all);
      const float may_be_hair = std::max(smooth_step(kBrowTopM, kBrowTopM + 0.008F, p.y()),
                                         smooth_step(kFaceSideM, kFaceSideM + 0.008F, std::abs(p.x())));
      const float bright = smooth_step(0.35F, 0.65F, luminance(colour.pixel(x, y)) / skin_light);
      weight(x, y) *= 1.0F - may_be_hair * (1.0F - bright);
    }
  }
}

// A little of the skin's own colour everywhere, so that what is filled far from anything seen tends to it.
void add_prior(const Eigen::Vector3f& skin, Image& colour, Image& weight) {
  for (int y = 0; y < colour.height(); ++y) {
    for (int x = 0; x < colour.width(); ++x) {
      const float w = weight(x, y);
      const float prior = kPriorWeight * (1.0F - w);
      for (int c = 0; c < 3; ++c)
        colour(x, y, c) = (w * colour(x, y, c) + prior * skin[c]) / std::max(1e-6F, w + prior);
      weight(x, y) = w + prior;
    }
  }
}

double mean_where(const Image& value, const Image& where) {
  double sum = 0;
  double total = 0;
  for (std::size_t i = 0; i < value.values().size(); ++i) {
    sum += static_cast<double>(value.values()[i] * where.values()[i]);
    total += static_cast<double>(where.values()[i]);
  }
  return total > 0 ? sum / total : 0.0;
}

}  // namespace

std::string UnwrapOptions::validate() const {
  if (size_px < 16 || size_px > 4096)
    return "The texture's size must be 16 .. 4096 px, not " + std::to_string(size_px) + ".";
  if (!(max_yaw_deg > 0 && max_yaw_deg <= 60)) return "The largest yaw must be above 0 and at most 60 degrees.";
  if (focal_px && !(*focal_px > 0 && std::isfinite(*focal_px)))
    return "The focal length must be a positive number of pixels.";
  if (threads < 0) return "The number of threads must not be negative.";
  return {};
}

Unwrapped unwrap_face(const io::Photo& photo, const face::Face& face, const face::Camera& camera,
                      const synth::HeadModel& model, const UnwrapOptions& options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  check_model(model);
  const std::vector<int> skin = textured_skin(model);
  const LandmarkPairs pairs = landmark_pairs(model);

  Unwrapped out;
  const HeadFit fit = fit_head(model, pairs, face, camera);
  const Eigen::Vector3d forward = fit.camera_from_head.linear().col(2);
  const Eigen::Vector3d to_camera = -fit.camera_from_head.translation().normalized();
  const Eigen::Vector3d seen_from = fit.camera_from_head.linear().transpose() * to_camera;
  out.report.yaw_deg = degrees(std::atan2(seen_from.x(), seen_from.z()));
  out.report.pitch_deg = degrees(std::asin(std::clamp(forward.y(), -1.0, 1.0)));
  out.report.residual_px = fit.residual_px;
  out.report.face_width_px = static_cast<double>(face.box.width);
  if (std::abs(out.report.yaw_deg) > options.max_yaw_deg) {
    throw Error(ExitCode::kNoFace,
                "The face is turned by " + std::to_string(static_cast<int>(std::lround(std::abs(out.report.yaw_deg)))) +
                    " degrees, and a texture needs both halves: up to " +
                    std::to_string(static_cast<int>(options.max_yaw_deg)) + " are allowed. Give a frontal photo.");
  }

  const FacePicture picture = face_picture(photo, face, options.size_px);
  Seen seen{model,
            fit.vertices_cam,
            vertex_normals(fit.vertices_cam, model.triangles),
            picture_points(fit, pairs, face, camera, picture.crop, options.threads),
            landmark_nearness(model, pairs),
            {},
            {},
            picture.clipped};
  std::vector<int> all(static_cast<std::size_t>(model.triangles.rows()));
  std::iota(all.begin(), all.end(), 0);
  seen.raster = raster_mesh(seen.points, model.triangles, all, picture.linear.width(), picture.linear.height());
  highlight::SeparateOptions separate;
  separate.separator = options.separator;
  separate.threads = options.threads;
  seen.diffuse = highlight::separate(picture.linear, skin_mask(model, seen.raster, seen.nearness), separate).diffuse;

  const MeshRaster texel_raster = raster_texels(model, skin, options.size_px);
  Texels texels = read_texels(seen, texel_raster, options.threads);
  out.report.shading_taken =
      remove_slow_shading(texels.normal, bare_skin(model, texel_raster, texels.weight), texels.colour);
  const Eigen::Vector3f skin_mean = skin_colour(texels.colour, bare_skin(model, texel_raster, texels.weight));
  drop_hair(model, texel_raster, skin_mean, texels.weight, texels.colour);
  out.report.covered = mean_where(texels.weight, texels.skin);
  out.coverage = texels.weight;
  add_mirrored(model, skin, texel_raster, texels.colour, texels.weight);
  add_prior(skin_mean, texels.colour, texels.weight);
  out.texture = encode_srgb(push_pull(texels.colour, texels.weight));
  return out;
}

Unwrapped unwrap(const io::Photo& photo, const synth::HeadModel& model, const face::FaceFinder& finder,
                 const UnwrapOptions& options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  check_model(model);
  EstimateOptions camera_options;
  camera_options.focal_px = options.focal_px;
  const face::Camera camera = camera_of(photo, camera_options).camera;
  const std::vector<face::Face> faces = finder.find(photo.linear, camera);
  if (faces.empty()) {
    throw Error(ExitCode::kNoFace, "No face was found in this picture of " + std::to_string(photo.linear.width()) +
                                       " x " + std::to_string(photo.linear.height()) +
                                       " px; a texture needs a frontal photo of a face.");
  }
  const auto width = [](const face::Face& face) { return face.box.width; };
  const auto largest =
      std::max_element(faces.begin(), faces.end(), [&](const auto& a, const auto& b) { return width(a) < width(b); });
  return unwrap_face(photo, *largest, camera, model, options);
}

}  // namespace faceprobe::pipeline
