#include "train/rerender_loss.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/sh.h"
#include "net/face_outputs.h"
#include "train/face_loss.h"
#include "train/smooth_error.h"

#include <cmath>
#include <stdexcept>

namespace faceprobe::train {
namespace {

// Of a shading whose mean is 1. Below it a difference is relative to this: shadows are dim, and their light comes from other skin too.
constexpr double kShadow = 0.1;
constexpr double kLeastLight = 0.02;     // of such a shading; an albedo is not divided by less
constexpr double kAlbedoFloor = 0.1;     // of the person's mean albedo
constexpr double kLeastContrast = 0.05;  // of the first network's, to measure changes by: flat light has little
constexpr double kLeastCurl = 0.005;     // likewise
constexpr double kSteepest = 0.2;        // z of a normal; slopes end there
constexpr int kScaleRounds = 6;          // light, scales of the photos, light, ...; each leaves a third of the error

torch::Tensor mean_over(const torch::Tensor& values, const torch::Tensor& weight) {
  return (values * weight).sum() / weight.sum().clamp_min(1e-9);
}

torch::Tensor level_of(const torch::Tensor& shading) { return shading.mean(-2, true); }

// A photo as rows of the least squares: P pixels.
struct Rows {
  torch::Tensor basis;    // K x P
  torch::Tensor shading;  // 3 x P, scaled
  torch::Tensor weight;   // 1 x P, sum 1
  torch::Tensor scale;    // that the shading was divided by
};

Rows rows_of(const PhotoSurface& photo, const torch::Tensor& skin, int order, Trust trust) {
  const torch::Tensor shown = skin.to(torch::kDouble).reshape({1, -1});
  if (!(shown.sum().item<double>() > 0)) throw std::invalid_argument("A photo to render again must show some skin.");
  torch::Tensor weight = shown;
  if (trust == Trust::kStated) weight = weight * confidence(photo.spread).detach().to(torch::kDouble).reshape({1, -1});
  const torch::Tensor basis = irradiance_basis(photo.normal, order);
  const torch::Tensor shading = photo.shading.to(torch::kDouble).reshape({3, -1});
  const torch::Tensor scale = mean_over(level_of(shading), shown);
  return {basis.reshape({basis.size(1), -1}), shading / scale, weight / weight.sum(), scale};
}

// Of squared differences, which are relative.
torch::Tensor squares_weight(const Rows& rows) { return rows.weight / (level_of(rows.shading) + kShadow).square(); }

torch::Tensor light_of(const std::vector<Rows>& photos, double ridge) {
  const std::int64_t count = photos.front().basis.size(0);
  torch::Tensor matrix = ridge * torch::eye(count, torch::kDouble);
  torch::Tensor right = torch::zeros({count, 3}, torch::kDouble);
  const double share = 1.0 / static_cast<double>(photos.size());
  for (const Rows& rows : photos) {
    const torch::Tensor weighted = share * rows.basis * squares_weight(rows);
    matrix = matrix + weighted.matmul(rows.basis.t());
    right = right + weighted.matmul(rows.shading.t());
  }
  return torch::linalg_solve(matrix, right);
}

// Photos of faces that show other parts of the sphere have other means under the same light.
void rescale(std::vector<Rows>& photos, const torch::Tensor& light) {
  for (Rows& rows : photos) {
    const torch::Tensor by_light = light.t().matmul(rows.basis);
    const torch::Tensor weight = squares_weight(rows);
    const torch::Tensor gain =
        (weight * by_light * rows.shading).sum() / (weight * by_light.square()).sum().clamp_min(1e-9);
    rows.shading = rows.shading / gain;
    rows.scale = rows.scale * gain;
  }
}

// Beyond the slack, in units of it.
torch::Tensor beyond(const torch::Tensor& change, double slack) {
  return ((change - slack) / slack).clamp_min(0).square();
}

}  // namespace

PhotoSurface photo_surface(const net::FaceSurface& found) {
  return {found.normal, found.spread, found.log_level.exp() * found.colour};
}

torch::Tensor confidence(const torch::Tensor& spread) {
  return 1 / (1 + (spread / net::FaceOutputs::kUsualError).square());
}

torch::Tensor irradiance_basis(const torch::Tensor& normal, int order) {
  if (normal.dim() != 4 || normal.size(1) != 3 || order < 0)
    throw std::invalid_argument("The irradiance of harmonics is of normals, N x 3 x H x W, and of an order from 0 on.");
  const torch::Tensor n = normal.to(torch::kDouble);
  const torch::Tensor x = n.narrow(1, 0, 1);
  const torch::Tensor y = n.narrow(1, 1, 1);
  const torch::Tensor z = n.narrow(1, 2, 1);
  std::vector<torch::Tensor> values(static_cast<std::size_t>(sh::coefficient_count(order)));
  const auto put = [&](int band, int m, const torch::Tensor& value) {
    values[static_cast<std::size_t>(band * (band + 1) + m)] = value;
  };
  // The recurrences of sh::basis, in the same order.
  torch::Tensor cosine = torch::ones_like(z);
  torch::Tensor sine = torch::zeros_like(z);
  double diagonal = std::sqrt(0.25 / kPi);
  for (int m = 0; m <= order; ++m) {
    torch::Tensor before = torch::zeros_like(z);
    torch::Tensor current = torch::full_like(z, diagonal);
    for (int band = m; band <= order; ++band) {
      const double scale = m == 0 ? 1.0 : std::sqrt(2.0);
      put(band, m, scale * current * cosine);
      if (m > 0) put(band, -m, scale * current * sine);
      const double next = band + 1;
      const double a = std::sqrt((4.0 * next * next - 1.0) / (next * next - m * m));
      const double b =
          band == m ? 0.0 : std::sqrt(((next - 1.0) * (next - 1.0) - m * m) / (4.0 * (next - 1.0) * (next - 1.0) - 1.0));
      const torch::Tensor following = a * (z * current - b * before);
      before = current;
      current = following;
    }
    diagonal *= std::sqrt((2.0 * m + 3.0) / (2.0 * m + 2.0));
    const torch::Tensor turned = cosine * x - sine * y;
    sine = cosine * y + sine * x;
    cosine = turned;
  }
  std::vector<torch::Tensor> shown;
  for (int band = 0; band <= order; ++band) {
    const double factor = sh::cosine_lobe(band) / kPi;
    for (int m = -band; m <= band && factor != 0; ++m)
      shown.push_back(factor * values[static_cast<std::size_t>(band * (band + 1) + m)]);
  }
  return torch::cat(shown, 1);
}

Rerendered rerender(std::span<const PhotoSurface> photos, std::span<const torch::Tensor> skin,
                    const RerenderOptions& options, Trust trust) {
  if (photos.empty() || photos.size() != skin.size())
    throw std::invalid_argument("Rendering again needs photos, and the skin of each.");
  std::vector<Rows> all;
  for (std::size_t k = 0; k < photos.size(); ++k) all.push_back(rows_of(photos[k], skin[k], options.order, trust));
  Rerendered out;
  out.light = light_of(all, options.ridge);
  for (int round = 1; round < kScaleRounds && all.size() > 1; ++round) {
    rescale(all, out.light);
    out.light = light_of(all, options.ridge);
  }
  out.residual = torch::zeros({}, torch::kDouble);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Rows& rows = all[k];
    const torch::Tensor by_light = out.light.t().matmul(rows.basis);
    const torch::Tensor error = (by_light - rows.shading) / (level_of(rows.shading) + kShadow);
    out.residual = out.residual + (smooth_abs(error) * rows.weight).sum() / (3.0 * static_cast<double>(all.size()));
    out.shading.push_back((by_light * rows.scale).view(photos[k].shading.sizes()));
  }
  return out;
}

torch::Tensor albedo_disagreement(const torch::Tensor& diffuse, const torch::Tensor& shading,
                                  const torch::Tensor& weight) {
  if (diffuse.dim() != 3 || diffuse.size(1) != 3 || diffuse.sizes() != shading.sizes() || weight.dim() != 3 ||
      weight.size(0) != diffuse.size(0) || weight.size(2) != diffuse.size(2))
    throw std::invalid_argument("Albedos are compared by layers of N x 3 x P and weights of N x 1 x P.");
  const torch::Tensor skin = weight.to(torch::kDouble).amin(0, true);
  if (!(skin.sum().item<double>() > 0)) return torch::zeros({}, torch::kDouble);
  const torch::Tensor raw = shading.to(torch::kDouble);
  const torch::Tensor light = raw / ((level_of(raw) * skin).sum(2, true) / skin.sum());
  // In shadow what is divided is noise and light from other skin.
  const torch::Tensor lit = skin * level_of(light).detach().clamp_max(1);
  const torch::Tensor by_all = lit.amin(0, true);
  torch::Tensor albedo = diffuse.to(torch::kDouble) / light.clamp_min(kLeastLight);
  albedo = albedo / ((albedo * by_all).sum({1, 2}, true) / (3 * by_all.sum())).clamp_min(1e-9);
  const torch::Tensor mean = (albedo * lit).sum(0, true) / lit.sum(0, true).clamp_min(1e-9);
  return (smooth_abs((albedo - mean) / (mean + kAlbedoFloor)) * lit).sum() / (3 * lit.sum());
}

torch::Tensor shading_contrast(const torch::Tensor& shading, const torch::Tensor& skin) {
  const torch::Tensor weight = skin.to(torch::kDouble);
  const torch::Tensor level = shading.to(torch::kDouble).mean(1, true).clamp_min(1e-6).log();
  // A constant shading has a slope of 0, not of infinity.
  return (mean_over((level - mean_over(level, weight)).square(), weight) + 1e-8).sqrt();
}

torch::Tensor normal_curl(const torch::Tensor& normal, const torch::Tensor& skin) {
  const torch::Tensor n = normal.to(torch::kDouble);
  const torch::Tensor z = n.narrow(1, 2, 1).clamp_min(kSteepest);
  const torch::Tensor along_x = -n.narrow(1, 0, 1) / z;  // slope of the surface
  const torch::Tensor along_y = -n.narrow(1, 1, 1) / z;
  // In the middle of each four pixels.
  const auto corners = [](const torch::Tensor& t, int row, int column) {
    return t.narrow(2, row, t.size(2) - 1).narrow(3, column, t.size(3) - 1);
  };
  const torch::Tensor up = 0.5 * (corners(along_x, 0, 0) + corners(along_x, 0, 1) - corners(along_x, 1, 0) -
                                  corners(along_x, 1, 1));  // row 0 is up
  const torch::Tensor right =
      0.5 * (corners(along_y, 0, 1) + corners(along_y, 1, 1) - corners(along_y, 0, 0) - corners(along_y, 1, 0));
  const torch::Tensor weight = skin.to(torch::kDouble);
  return mean_over(smooth_abs(up - right),
                   corners(weight, 0, 0) * corners(weight, 0, 1) * corners(weight, 1, 0) * corners(weight, 1, 1));
}

SurfaceGuards surface_guards(const PhotoSurface& found, const PhotoSurface& start, const torch::Tensor& skin,
                             const RerenderOptions& options) {
  const torch::Tensor weight = skin.to(torch::kDouble);
  const torch::Tensor turned = chord(found.normal.to(torch::kDouble), start.normal.to(torch::kDouble));
  const torch::Tensor contrast = shading_contrast(start.shading, skin);
  const torch::Tensor change =
      (shading_contrast(found.shading, skin) - contrast).abs() / contrast.clamp_min(kLeastContrast);
  const auto sure = [&](const PhotoSurface& of) { return mean_over(confidence(of.spread.to(torch::kDouble)), weight); };
  const torch::Tensor least = (1 - options.confidence_slack) * sure(start);
  const torch::Tensor curl = normal_curl(start.normal, skin);
  const torch::Tensor more = (normal_curl(found.normal, skin) - curl) / curl.clamp_min(kLeastCurl);
  // An angle's chord is shorter than the angle by less than a hundredth here.
  return {mean_over(beyond(turned, radians(options.normal_slack_deg)), weight), beyond(change, options.contrast_slack),
          (4 * (1 - sure(found) / least).clamp_min(0).square()), beyond(more, options.curl_slack)};
}

}  // namespace faceprobe::train
