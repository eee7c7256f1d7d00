#include "faceprobe/pipeline/unwrap.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/pipeline/dense_landmarks.h"
#include "pipeline/mask_head.h"
#include "pipeline/portrait.h"

#include <gtest/gtest.h>
#include <cmath>

namespace faceprobe::pipeline {
namespace {

using testing::mask_head;
using testing::mask_photo;

const Eigen::Vector3f kSkin(0.5F, 0.33F, 0.24F);

// Lighter and darker patches of one chromaticity, the same on both halves.
float pattern(const Eigen::Vector2f& uv) {
  return 1.0F + 0.25F * std::sin(60.0F * std::abs(uv.x() - 0.5F)) * std::sin(50.0F * uv.y());
}

Eigen::Vector3f texel(const ByteImage& texture, int x, int y) {
  const std::uint8_t* code = texture.pixel(x, y);
  return {linear_from_srgb(static_cast<float>(code[0]) / 255.0F), linear_from_srgb(static_cast<float>(code[1]) / 255.0F),
          linear_from_srgb(static_cast<float>(code[2]) / 255.0F)};
}

// Rms relative error of the texture's green against skin times pattern, up to one gain, over texels `where` accepts.
template <class Where>
double pattern_error(const Unwrapped& out, const Where& where, int* count = nullptr) {
  const int size = out.texture.width();
  double sum = 0;
  double square = 0;
  int n = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      if (!where(x, y)) continue;
      const Eigen::Vector2f uv((static_cast<float>(x) + 0.5F) / static_cast<float>(size),
                               1.0F - (static_cast<float>(y) + 0.5F) / static_cast<float>(size));
      const double ratio = std::log(static_cast<double>(texel(out.texture, x, y)[1] / (kSkin[1] * pattern(uv))));
      sum += ratio;
      square += ratio * ratio;
      ++n;
    }
  }
  if (count != nullptr) *count = n;
  return std::sqrt(std::max(0.0, square / n - sum / n * sum / n));
}

UnwrapOptions small(int threads = 0) {
  UnwrapOptions options;
  options.size_px = 192;
  options.threads = threads;
  return options;
}

TEST(Unwrap, KnownTextureComesBackFromAnEvenlyLitPhoto) {
  const auto known = mask_photo(
      6, [](const Eigen::Vector2f& uv, const Eigen::Vector3f&) -> Eigen::Vector3f { return kSkin * pattern(uv); });
  const Unwrapped out = unwrap_face(known.photo, known.face, known.camera, mask_head(), small());
  EXPECT_LT(out.report.residual_px, 0.05);            // the mesh is the model: only rounding is left
  EXPECT_NEAR(std::abs(out.report.yaw_deg), 6, 1.0);  // seen from the camera's place, which is not quite the head's axis
  EXPECT_GT(out.report.covered, 0.5);
  int count = 0;
  // The pattern's rms is .125; bilinear reading of it at 200 px, slow shading fitted to it and separation leave a quarter of that.
  EXPECT_LT(pattern_error(
                out, [&](int x, int y) { return out.coverage(x, y) > 0.95F; }, &count),
            0.035);
  EXPECT_GT(count, 4000);
}

TEST(Unwrap, SlowShadingIsTakenOut) {
  const Eigen::Vector3f lamp = Eigen::Vector3f(0.8F, 0.3F, 0.6F).normalized();
  const auto lit = mask_photo(0, [&](const Eigen::Vector2f& uv, const Eigen::Vector3f& normal) -> Eigen::Vector3f {
    return kSkin * pattern(uv) * (0.5F + 0.5F * normal.dot(lamp));
  });
  const Unwrapped out = unwrap_face(lit.photo, lit.face, lit.camera, mask_head(), small());
  EXPECT_GT(out.report.shading_taken, 0.1);
  // As above, plus what the logarithm of a linear function of the normal has beyond second order.
  EXPECT_LT(pattern_error(out, [&](int x, int y) { return out.coverage(x, y) > 0.95F; }), 0.06);
}

TEST(Unwrap, WhatATurnedFaceHidesIsFilledFromTheOtherHalf) {
  const auto turned = mask_photo(
      28, [](const Eigen::Vector2f& uv, const Eigen::Vector3f&) -> Eigen::Vector3f { return kSkin * pattern(uv); });
  const Unwrapped out = unwrap_face(turned.photo, turned.face, turned.camera, mask_head(), small());
  const int size = out.coverage.width();
  const auto hidden = [&](int x, int y) { return out.coverage(x, y) < 0.1F && out.coverage(size - 1 - x, y) > 0.95F; };
  int count = 0;
  EXPECT_LT(pattern_error(out, hidden, &count), 0.06);  // as above, nearest texel opposite
  EXPECT_GT(count, 500);
}

TEST(Unwrap, IsTheSameForAnyNumberOfThreads) {
  const auto known = mask_photo(
      6, [](const Eigen::Vector2f& uv, const Eigen::Vector3f&) -> Eigen::Vector3f { return kSkin * pattern(uv); });
  const Unwrapped one = unwrap_face(known.photo, known.face, known.camera, mask_head(), small(1));
  const Unwrapped three = unwrap_face(known.photo, known.face, known.camera, mask_head(), small(3));
  EXPECT_EQ(one.texture, three.texture);
  EXPECT_EQ(one.coverage, three.coverage);
}

ExitCode code_of(const std::function<void()>& call, std::string_view word) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_NE(std::string_view(error.what()).find(word), std::string_view::npos) << error.what();
    return error.code();
  }
  return ExitCode::kOk;
}

TEST(Unwrap, RefusesWhatItCannotUseWithASentence) {
  const auto even = [](const Eigen::Vector2f&, const Eigen::Vector3f&) -> Eigen::Vector3f { return kSkin; };
  const auto front = mask_photo(0, even);
  const auto profile = mask_photo(50, even);
  const auto call = [](const testing::MaskPhoto& photo, const synth::HeadModel& model, const UnwrapOptions& options) {
    return [&photo, model, options] { unwrap_face(photo.photo, photo.face, photo.camera, model, options); };
  };
  EXPECT_EQ(code_of(call(profile, mask_head(), small()), "turned"), ExitCode::kNoFace);
  synth::HeadModel bare = mask_head();
  bare.uv.resize(0, 2);
  bare.triangle_uv.resize(0, 3);
  EXPECT_EQ(code_of(call(front, bare, small()), "texture coordinates"), ExitCode::kModel);
  synth::HeadModel blind = mask_head();
  blind.dense_landmarks.clear();
  EXPECT_EQ(code_of(call(front, blind, small()), "landmarks"), ExitCode::kModel);
  UnwrapOptions options;
  options.size_px = 3;
  EXPECT_EQ(code_of(call(front, mask_head(), options), "size"), ExitCode::kUsage);
  const face::FaceFinder finder;
  EXPECT_EQ(code_of([&] { unwrap(testing::blank(300, 300), mask_head(), finder, small()); }, "No face"),
            ExitCode::kNoFace);
}

TEST(Unwrap, OfARealPortraitShowsAFaceThatIsFoundAgain) {
  const face::FaceFinder finder;
  const io::Photo photo = io::load_photo(io::data_file("samples/astronaut.png"));
  synth::HeadModel model = mask_head();
  UnwrapOptions options;
  options.size_px = 256;
  const Unwrapped out = unwrap(photo, model, finder, options);
  EXPECT_LT(out.report.residual_px,
            0.06 * out.report.face_width_px);  // the mean face, rigid: no face fits better than a few per cent
  EXPECT_GT(out.report.covered, 0.5);
  const auto at_vertex = [&](int vertex) {
    return texel(out.texture, static_cast<int>(model.uv(vertex, 0) * 256.0F),
                 static_cast<int>((1.0F - model.uv(vertex, 1)) * 256.0F));
  };
  // A cheek (vertex 50) is skin; the lower lip (17) is redder.
  const Eigen::Vector3f cheek = at_vertex(50);
  const Eigen::Vector3f lip = at_vertex(17);
  EXPECT_GT(cheek[0], cheek[1]);
  EXPECT_GT(lip[0] / lip[1], cheek[0] / cheek[1]);

  // The mask with this skin is a face to the finder, whose points lie where the mask's own vertices are.
  DenseLandmarkOptions look;
  look.texture = out.texture;
  const std::vector<synth::SurfacePoint> found = locate_dense_landmarks(model, finder, look);
  ASSERT_EQ(found.size(), 468U);
  double sum = 0;
  for (int v = 0; v < 468; ++v) {
    const synth::SurfacePoint& at = found[static_cast<std::size_t>(v)];
    ASSERT_NEAR(at.weights.sum(), 1.0F, 1e-5F);
    ASSERT_GE(at.weights.minCoeff(), -1e-5F);
    const Eigen::RowVector3f p = at.weights.transpose() * model.neutral(model.triangles.row(at.triangle), Eigen::all);
    sum += static_cast<double>((p - model.neutral.row(v)).norm());
  }
  EXPECT_LT(sum / 468,
            0.010);  // metres; the network's points on a photo of 300 px stray by about 2 % of a face 15 cm wide, twice
}

}  // namespace
}  // namespace faceprobe::pipeline
