#include "train/augment.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/mirror.h"
#include "faceprobe/core/region.h"
#include "faceprobe/synth/photo_layers.h"
#include "net/close_view.h"
#include "train/augment_view.h"
#include "train/open_shading.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace faceprobe::train {
namespace {

// Those of Shi et al. and of the paper's albedo and shading learn from the shading.
bool learns_surface(const TrainConfig& config) {
  return config.architecture == "face" || config.architecture == "shi" || config.architecture == "albedo_shading";
}

// The paper's networks are trained without.
bool changes_light(const TrainConfig& config) {
  return config.architecture != "mscr" && config.architecture != "albedo_shading";
}

// Rec.709 luminance in all channels of both layers, as a grey photo has.
void take_colour(TrainingPicture& picture) {
  for (std::size_t i = 0; i < picture.linear.pixel_count(); ++i) {
    float* light = picture.linear.data() + 3 * i;
    float* highlight = picture.highlight.data() + 3 * i;
    std::fill_n(light, 3, luminance(light));
    std::fill_n(highlight, 3, std::min(light[0], luminance(highlight)));
    std::uint8_t* clip = picture.clip.data() + 3 * i;
    std::fill_n(clip, 3, static_cast<std::uint8_t>(clip[0] & clip[1] & clip[2]));
  }
  // How much of a grey photo's tone is the light's colour cannot be seen.
  std::fill(picture.shading.values().begin(), picture.shading.values().end(), 0.0F);
  for (std::size_t i = 0; i < picture.open.values().size(); i += 3) {
    float* light = picture.open.data() + i;
    std::fill_n(light, 3, luminance(light));
  }
}

// A plain matt ellipse over part of the picture.
void put_before(TrainingPicture& picture, Random& random) {
  const auto size = static_cast<double>(picture.linear.width());
  const double x0 = random.uniform() * size;
  const double y0 = random.uniform() * static_cast<double>(picture.linear.height());
  const double a = random.between(0.05, 0.22) * size;
  const double b = random.between(0.05, 0.22) * size;
  const double angle = random.between(0, kPi);
  std::array<float, 3> colour{};
  for (float& channel : colour) channel = static_cast<float>(random.log_between(0.01, 0.8));
  for (int y = 0; y < picture.linear.height(); ++y) {
    for (int x = 0; x < picture.linear.width(); ++x) {
      const double dx = x + 0.5 - x0;
      const double dy = y + 0.5 - y0;
      const double u = (dx * std::cos(angle) + dy * std::sin(angle)) / a;
      const double v = (dy * std::cos(angle) - dx * std::sin(angle)) / b;
      if (u * u + v * v > 1) continue;
      const float shade = static_cast<float>(1.0 - 0.4 * v);
      for (std::size_t c = 0; c < 3; ++c) {
        picture.linear(x, y, static_cast<int>(c)) = std::min(1.0F, shade * colour[c]);
        picture.highlight(x, y, static_cast<int>(c)) = 0;
        picture.clip(x, y, static_cast<int>(c)) = 0;
      }
      picture.skin(x, y) = 0;
      if (picture.has_surface()) {
        picture.region(x, y) = static_cast<std::uint8_t>(Region::kObject);
        std::fill_n(picture.shading.pixel(x, y), 3, 0.0F);
        std::fill_n(picture.open.pixel(x, y), 3, 0.0F);
      }
    }
  }
}

// In the place of what is behind the person, a plain backdrop that is lit from one side: in synthetic photos the background is the light itself, in
// a studio it is not.
void put_behind(TrainingPicture& picture, Random& random) {
  const double angle = random.between(-kPi, kPi);
  const double slope = random.between(0, 0.8) / static_cast<double>(picture.linear.width());
  std::array<float, 3> colour{};
  const double level = random.log_between(0.005, 0.9);
  for (float& channel : colour) channel = static_cast<float>(level * std::exp(random.normal(0, 0.2)));
  for (int y = 0; y < picture.linear.height(); ++y) {
    for (int x = 0; x < picture.linear.width(); ++x) {
      if (picture.region(x, y) != static_cast<std::uint8_t>(Region::kNone)) continue;
      const double shade = std::exp(2 * slope * (x * std::cos(angle) + y * std::sin(angle)));
      for (int c = 0; c < 3; ++c) {
        picture.linear(x, y, c) = std::min(1.0F, static_cast<float>(shade) * colour[static_cast<std::size_t>(c)]);
        picture.highlight(x, y, c) = 0;
        picture.clip(x, y, c) = picture.linear(x, y, c) >= 1.0F ? 1 : 0;
      }
    }
  }
}

void mirror_surface(TrainingPicture& picture) {
  for (Image* normals : {&picture.normal, &picture.mesh}) {
    mirror(*normals);
    for (std::size_t i = 0; i < normals->values().size(); i += 3) normals->data()[i] *= -1;
  }
  mirror(picture.depth_m);
  mirror(picture.shading);
  mirror(picture.open);
  mirror(picture.region);
}

// What is missing at the left, top, right and bottom, of the whole: each side is cut in half of the pictures.
std::array<double, 4> draw_cuts(Random& random) {
  std::array<double, 4> cuts{};
  for (double& cut : cuts) {
    const bool there = random.chance(0.5);
    const double share = random.between(0.02, 0.3);
    cut = there ? share : 0;
  }
  return cuts;
}

// The mask an estimate has is the mesh's; without a mesh it has none.
void put_mesh(const synth::ShardReader& reader, int number, TrainingPicture& picture) {
  synth::FoundMesh mesh = reader.copy_mesh(number);
  bool found = false;
  for (std::size_t i = 0; i < mesh.region.pixel_count(); ++i) {
    const std::uint8_t region = mesh.region.data()[i];
    picture.mask.data()[i] = is_skin(static_cast<Region>(region)) ? 1 : 0;
    found = found || region != 0;
  }
  if (!found) std::fill(picture.mask.values().begin(), picture.mask.values().end(), std::uint8_t{1});
  picture.mesh = std::move(mesh.normal_cam);
}

TrainingPicture picture_of(const synth::ShardReader& reader, int number, float mask_scale, bool surface) {
  synth::Sample sample = surface ? reader.copy_sample(number) : reader.copy_light(number);
  synth::ViewLayers view = surface ? reader.copy_view(number) : reader.copy_faces(number);
  synth::PhotoLayers layers = synth::photo_layers(sample);
  TrainingPicture picture{.linear = std::move(layers.linear),
                          .clip = ByteImage(sample.clip.width(), sample.clip.height(), 3),
                          .mask = synth::face_mask(view, mask_scale),
                          .highlight = std::move(layers.highlight),
                          .skin = synth::skin_mask(view),
                          .mesh = {},
                          .normal = std::move(view.normal),
                          .depth_m = std::move(view.depth_m),
                          .shading = std::move(sample.shading),
                          .region = surface ? std::move(view.region) : ByteImage()};
  if (surface && reader.has_meshes()) {
    put_mesh(reader, number, picture);
  } else if (surface) {
    picture.mesh = Image(picture.linear.width(), picture.linear.height(), 3);  // as where no face was found
  }
  if (surface) picture.open = open_shading(sample.environment, picture.normal, picture.region);
  for (std::size_t i = 0; i < sample.clip.pixel_count(); ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      picture.clip.data()[3 * i + c] = static_cast<std::uint8_t>(sample.clip.data()[i] >> c & 1U);
  }
  return picture;
}

bool masked_everywhere(const TrainingPicture& picture) {
  return std::ranges::all_of(picture.mask.values(), [](std::uint8_t m) { return m != 0; });
}

// None where no face was found.
std::optional<Window> near_window(const TrainingPicture& picture, int picture_px) {
  if (masked_everywhere(picture)) return std::nullopt;
  return net::close_window(picture.mask, picture_px);
}

Window whole_window(const TrainingPicture& picture, int picture_px) {
  return net::whole_window(picture.linear.width(), picture.linear.height(), picture_px);
}

// `window` enlarged by `zoom` about its middle, which moves by shares of its sides.
Window moved(Window window, double zoom, double right, double down) {
  const double half_width = 0.5 * window.width / window.scale;
  const double half_height = 0.5 * window.height / window.scale;
  window.left_px += half_width * (1 + 2 * right - 1 / zoom);
  window.top_px += half_height * (1 + 2 * down - 1 / zoom);
  window.scale *= zoom;
  return window;
}

}  // namespace

void apply_gain(const std::array<float, 3>& gain, TrainingPicture& picture) {
  for (std::size_t i = 0; i < picture.linear.values().size(); ++i) {
    float& light = picture.linear.data()[i];
    float& highlight = picture.highlight.data()[i];
    std::uint8_t& clip = picture.clip.data()[i];
    // What was clipped stays white: how bright it was is not known.
    const float g = clip != 0 ? std::min(1.0F, gain[i % 3]) : gain[i % 3];
    const float diffuse = g * (light - highlight);
    light *= g;
    highlight *= g;
    if (picture.has_surface()) {
      picture.shading.data()[i] *= gain[i % 3];
      picture.open.data()[i] *= gain[i % 3];
    }
    if (light >= 1.0F) {
      light = 1.0F;
      highlight = 1.0F - std::min(1.0F, diffuse);
      clip = 1;
    }
  }
}

TrainingPicture plain_picture(const synth::ShardReader& reader, int sample, const TrainConfig& config) {
  TrainingPicture picture = picture_of(reader, sample, 1.0F, learns_surface(config));
  if (config.picture_px == 0) return picture;
  return seen_through(near_window(picture, config.picture_px).value_or(whole_window(picture, config.picture_px)),
                      picture);
}

TrainingPicture draw_picture(const synth::ShardReader& reader, int sample, const TrainConfig& config, Random& random) {
  const AugmentConfig& augment = config.augment;
  // Everything is drawn in the same order whatever comes of it, so that one setting does not change what another draws.
  const auto scale = static_cast<float>(random.between(0.94, 1.06));
  const bool turned = random.chance(0.5);
  const double exposure = random.normal(0, augment.exposure_deviation);
  std::array<float, 3> gain{};
  for (float& g : gain) g = static_cast<float>(std::exp(exposure + random.normal(0, augment.colour_deviation)));
  const bool grey = random.chance(augment.grey_share);
  const bool masked = !random.chance(augment.no_mask_share);
  const bool occluded = random.chance(augment.occluder_share);
  const bool another_zoom = random.chance(augment.zoom_share);
  // From a head with room around it to a face cut off at the brows.
  const double zoom = random.log_between(0.8, 1.6);
  const double centre_x = random.between(0.35, 0.65);
  const double centre_y = random.between(0.35, 0.65);
  const bool near = random.chance(augment.close_share);
  const double near_zoom = random.log_between(0.85, 1.15);
  const double right = random.between(-0.06, 0.06);
  const double down = random.between(-0.06, 0.06);
  const bool cut = random.chance(augment.cut_share);
  const std::array<double, 4> cuts = draw_cuts(random);
  Random behind = random.split(1);  // apart, so that what is drawn here is what was drawn before there were backdrops
  const bool before_backdrop = behind.chance(augment.backdrop_share);

  TrainingPicture picture = picture_of(reader, sample, scale, learns_surface(config));
  if (config.picture_px > 0) {
    const std::optional<Window> near_view = near ? near_window(picture, config.picture_px) : std::nullopt;
    const Window all = whole_window(picture, config.picture_px);
    const Window another = another_zoom ? moved(all, zoom, centre_x - 0.5, centre_y - 0.5) : all;
    picture = seen_through(near_view ? moved(*near_view, near_zoom, right, down) : another, picture);
  } else if (another_zoom) {
    picture = seen_through(
        zoom_window(picture, zoom, centre_x * picture.linear.width(), centre_y * picture.linear.height()), picture);
  }
  const double width = picture.linear.width();
  const double height = picture.linear.height();
  if (before_backdrop && picture.has_surface()) put_behind(picture, behind);
  if (changes_light(config)) apply_gain(gain, picture);
  if (occluded) put_before(picture, random);
  if (grey) take_colour(picture);
  if (!masked) {
    std::fill(picture.mask.values().begin(), picture.mask.values().end(), std::uint8_t{1});
    std::fill(picture.mesh.values().begin(), picture.mesh.values().end(), 0.0F);
  }
  if (cut) {
    cut_sides({.left = static_cast<int>(cuts[0] * width),
               .top = static_cast<int>(cuts[1] * height),
               .right = static_cast<int>(std::ceil((1 - cuts[2]) * width)),
               .bottom = static_cast<int>(std::ceil((1 - cuts[3]) * height))},
              picture);
  }
  if (augment.mirror && turned) {
    mirror(picture.linear);
    mirror(picture.clip);
    mirror(picture.mask);
    mirror(picture.highlight);
    mirror(picture.skin);
    if (picture.has_surface()) mirror_surface(picture);
  }
  return picture;
}

}  // namespace faceprobe::train
