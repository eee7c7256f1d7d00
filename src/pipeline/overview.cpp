#include "faceprobe/pipeline/overview.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/face/canonical_mesh.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/io/text.h"
#include "faceprobe/render/sphere.h"
#include "pipeline/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace faceprobe::pipeline {

namespace {

constexpr Colour kDim = {150, 154, 162};
constexpr Colour kMesh = {90, 220, 255};
constexpr std::array<Colour, 5> kLights = {
    {{255, 92, 80}, {255, 200, 60}, {110, 225, 120}, {110, 170, 255}, {225, 130, 255}}};

// Layout on a page 1600 px wide: the photo at the left, six small layers beside it, the map and the balls below.
constexpr int kWidth = 1600;
constexpr int kMargin = 24;
constexpr int kCaption = 30;
constexpr int kPhotoWidth = 600;
constexpr int kPhotoHeight = 640;
constexpr int kLayerColumns = 3;
constexpr int kLayerWidth = (kWidth - kPhotoWidth - (kLayerColumns + 2) * kMargin) / kLayerColumns;
constexpr int kMapWidth = 640;
constexpr int kMapHeight = kMapWidth / 2;
constexpr int kConfidenceWidth = 220;
constexpr int kBall = 196;

struct Page {
  ByteImage canvas;
  void text(int x, int y, const std::string& words, int size = 17, const Colour& colour = kInk, bool bold = false) {
    io::draw_text(canvas, x, y, words, size, colour, bold);
  }
};

// Part of the photo around the face, as much as fits the frame's shape.
face::Crop photo_frame(const Estimate& estimate, const face::Box& box) {
  const double wanted =
      1.9 * std::max(static_cast<double>(box.width) * kPhotoHeight / kPhotoWidth, static_cast<double>(box.height));
  const double height = std::min(
      wanted, std::max<double>(estimate.photo_height, 1.0 * estimate.photo_width * kPhotoHeight / kPhotoWidth));
  const double width = height * kPhotoWidth / kPhotoHeight;
  const auto placed = [](double centre, double size, double limit) {
    return size >= limit ? (limit - size) / 2 : std::clamp(centre - size / 2, 0.0, limit - size);
  };
  face::Crop crop;
  crop.x_px = placed(box.x + 0.5 * box.width, width, estimate.photo_width);
  crop.y_px = placed(box.y + 0.5 * box.height, height, estimate.photo_height);
  crop.scale = kPhotoHeight / height;
  crop.width = kPhotoWidth;
  crop.height = kPhotoHeight;
  return crop;
}

void draw_photo(Page& page, const Estimate& estimate, const io::Photo& photo, std::size_t index, int x, int y) {
  const face::Crop frame = photo_frame(estimate, estimate.faces[index].face.box);
  ByteImage picture = encode_srgb(face::crop_picture(photo.linear, frame));
  const face::CanonicalMesh mesh = face::load_canonical_mesh(io::data_file("canonical-face-model.obj"));
  for (std::size_t f = 0; f < estimate.faces.size(); ++f) {
    const Eigen::MatrixX3f& points = estimate.faces[f].face.landmarks_px;
    const float opacity = f == index ? 0.28F : 0.10F;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const int a = mesh.triangles(t, k);
        const int b = mesh.triangles(t, (k + 1) % 3);
        if (a > b) continue;  // inner edges belong to two triangles
        const auto at = [&](int i) -> Eigen::Vector2d { return frame.crop_from_photo(points(i, 0), points(i, 1)); };
        draw_line(picture, at(a), at(b), kMesh, opacity);
      }
    }
  }
  paste(page.canvas, picture, x, y);
}

int draw_layers(Page& page, const FaceEstimate& face, int x, int y) {
  const double aspect = static_cast<double>(face.picture.height()) / face.picture.width();
  const int height = std::min(280, static_cast<int>(std::lround(kLayerWidth * aspect)));
  const int width = std::min(kLayerWidth, static_cast<int>(std::lround(height / aspect)));
  const auto exposed = [&](const Image& layer, float gain) { return encode_srgb(resized(layer, width, height), gain); };
  const float highlight_gain = std::min(8.0F, display_gain(face.layers.highlight));
  char amplified[64];
  std::snprintf(amplified, sizeof amplified, "highlight (x %.1f)", static_cast<double>(highlight_gain));
  const std::array<std::pair<std::string, ByteImage>, 6> tiles = {{
      {amplified, exposed(face.layers.highlight, highlight_gain)},
      {"diffuse", exposed(face.layers.diffuse, 1.0F)},
      {"albedo", exposed(face.albedo, 1.0F)},
      {"shading", exposed(face.shading, display_gain(face.shading))},
      {"normals", resized_labels(normals_picture(face.geometry), width, height)},
      {"regions", resized_labels(regions_picture(face.geometry), width, height)},
  }};
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const int column = static_cast<int>(i) % kLayerColumns;
    const int row = static_cast<int>(i) / kLayerColumns;
    const int left = x + column * (kLayerWidth + kMargin);
    const int top = y + row * (height + kCaption + 16);
    page.text(left, top + 18, tiles[i].first);
    paste(page.canvas, tiles[i].second, left + (kLayerWidth - width) / 2, top + kCaption);
  }
  return y + 2 * (height + kCaption + 16);
}

// Place of a direction on a drawn map.
Eigen::Vector2d on_map(const Eigen::Vector3d& direction, int width, int height) {
  const Eigen::Vector2f uv = uv_from_direction(direction.cast<float>());
  return {static_cast<double>(uv.x()) * width, static_cast<double>(uv.y()) * height};
}

void draw_map(Page& page, const FaceEstimate& face, int x, int y, float exposure) {
  ByteImage map = encode_srgb(resized(face.environment.radiance(), kMapWidth, kMapHeight), exposure);
  for (std::size_t i = 0; i < face.lights.size(); ++i) {
    const double radius = std::clamp(std::sqrt(face.lights[i].solid_angle_sr / kPi) / (2 * kPi) * kMapWidth, 6.0, 60.0);
    draw_ring(map, on_map(face.lights[i].direction, kMapWidth, kMapHeight), radius + 3, kLights[i % kLights.size()]);
    draw_ring(map, on_map(face.lights[i].direction, kMapWidth, kMapHeight), radius + 4, kLights[i % kLights.size()]);
  }
  page.text(x, y + 18, "environment map (centre: behind the camera; left half: right of the photo)");
  paste(page.canvas, map, x, y + kCaption);
}

void draw_confidence(Page& page, const FaceEstimate& face, int x, int y) {
  page.text(x, y + 18, "confidence");
  ByteImage map(kConfidenceWidth, kConfidenceWidth / 2, 3);
  const Image small = resized(face.confidence.radiance(), map.width(), map.height());
  std::transform(small.values().begin(), small.values().end(), map.values().begin(),
                 [](float v) { return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(v, 0.0F, 1.0F))); });
  paste(page.canvas, map, x, y + kCaption);
}

void draw_balls(Page& page, const FaceEstimate& face, int x, int y, int threads) {
  const SphereGrid grid = SphereGrid::of_cells(face.light.radiance.rows());
  using render::SphereMaterial;
  struct Ball {
    std::string name;
    SphereMaterial material;
    int nside;  // of the light it is lit by: a cosine and a rough lobe see no more, and cost grows with the cells
  };
  const std::array<Ball, 3> balls = {{{"diffuse", SphereMaterial::kDiffuse, 4},
                                      {"matte", SphereMaterial::kMatte, 6},
                                      {"mirror", SphereMaterial::kMirror, grid.nside()}}};
  float exposure = 1.0F;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const SphereGrid cells(std::min(balls[i].nside, grid.nside()));
    const Eigen::MatrixX3f light =
        cells.nside() == grid.nside() ? face.light.radiance : grid_from_env_map(face.environment, cells);
    const Image ball =
        render::render_sphere(light, cells, {.material = balls[i].material, .size_px = kBall, .threads = threads});
    Image over(kBall, kBall, 3);
    for (int py = 0; py < kBall; ++py) {
      for (int px = 0; px < kBall; ++px) {
        for (int c = 0; c < 3; ++c) over(px, py, c) = ball(px, py, c) * ball(px, py, 3);
      }
    }
    // One exposure for the three, set by the diffuse ball.
    if (i == 0) exposure = display_gain(over);
    ByteImage picture = encode_srgb(over, exposure);
    for (int py = 0; py < kBall; ++py) {
      for (int px = 0; px < kBall; ++px) {
        if (ball(px, py, 3) <= 0.0F) std::copy_n(kPaper.data(), 3, picture.pixel(px, py));
      }
    }
    const int left = x + static_cast<int>(i) * (kBall + kMargin);
    page.text(left, y + 18, balls[i].name + " ball");
    paste(page.canvas, picture, left, y + kCaption);
  }
}

void draw_light_list(Page& page, const FaceEstimate& face, int x, int y) {
  page.text(x, y, face.lights.empty() ? "no main light: the light is even" : "main lights", 17, kInk, true);
  for (std::size_t i = 0; i < face.lights.size(); ++i) {
    const lighting::MainLight& light = face.lights[i];
    const int line = y + 26 + 23 * static_cast<int>(i);
    fill(page.canvas, x, line - 11, 11, 11, kLights[i % kLights.size()]);
    char words[160];
    std::snprintf(words, sizeof words,
                  "azimuth %+.0f, elevation %+.0f deg   %.0f %% of the energy   %.2f sr   rgb %.2f %.2f %.2f",
                  azimuth_deg(light.direction), elevation_deg(light.direction), 100 * light.share, light.solid_angle_sr,
                  light.colour[0], light.colour[1], light.colour[2]);
    page.text(x + 20, line, words, 15, kDim);
  }
}

}  // namespace

ByteImage draw_overview(const Estimate& estimate, const io::Photo& photo, std::size_t index, int threads) {
  const FaceEstimate& face = estimate.faces.at(index);
  const int top = kMargin + 34;
  const int lower = top + kCaption + kPhotoHeight + kMargin;
  Page page{ByteImage(kWidth, lower + kCaption + kMapHeight + kMargin + 16, 3)};
  fill(page.canvas, 0, 0, page.canvas.width(), page.canvas.height(), kPaper);

  char title[200];
  const Eigen::Vector3d at = face.face.position_m();
  std::snprintf(title, sizeof title, "face %zu of %zu: %.0f px wide, %.2f m away, turned %+.0f deg, tilted %+.0f deg",
                index + 1, estimate.faces.size(), static_cast<double>(face.face.box.width), at.norm(),
                azimuth_deg(face.face.camera_from_face.rotation().col(2)),
                elevation_deg(face.face.camera_from_face.rotation().col(2)));
  page.text(kMargin, kMargin + 18, "Faceprobe", 24, kInk, true);
  page.text(kMargin + 160, kMargin + 18, title, 17, kDim);

  page.text(kMargin, top + 18, "photo and face mesh");
  draw_photo(page, estimate, photo, index, kMargin, top + kCaption);
  draw_layers(page, face, kMargin + kPhotoWidth + kMargin, top);

  const float exposure = exposure_for_quantile(face.environment.radiance(), 0.9F, 0.5F);
  draw_map(page, face, kMargin, lower, exposure);
  const int right = kMargin + kMapWidth + kMargin;
  draw_balls(page, face, right, lower, threads);
  draw_confidence(page, face, right + 3 * (kBall + kMargin), lower);
  draw_light_list(page, face, right, lower + kCaption + kBall + 30);
  return std::move(page.canvas);
}

}  // namespace faceprobe::pipeline
