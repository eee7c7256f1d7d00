// ICC profiles made here with lcms2 against primaries computed from first principles.

#include "faceprobe/core/color.h"
#include "faceprobe/io/photo.h"
#include "fixtures.h"
#include "io/icc.h"

#include <lcms2.h>
#include <Eigen/LU>
#include <memory>

namespace faceprobe::io {
namespace {

using namespace testing;

struct Primaries {
  double rx, ry, gx, gy, bx, by;
};
constexpr Primaries kRec709 = {0.64, 0.33, 0.30, 0.60, 0.15, 0.06};
constexpr Primaries kDisplayP3 = {0.680, 0.320, 0.265, 0.690, 0.150, 0.060};
constexpr Primaries kAdobe = {0.64, 0.33, 0.21, 0.71, 0.15, 0.06};

Bytes saved(cmsHPROFILE profile) {
  cmsUInt32Number size = 0;
  EXPECT_TRUE(cmsSaveProfileToMem(profile, nullptr, &size));
  Bytes bytes(size);
  EXPECT_TRUE(cmsSaveProfileToMem(profile, bytes.data(), &size));
  cmsCloseProfile(profile);
  return bytes;
}

using Curve = std::unique_ptr<cmsToneCurve, void (*)(cmsToneCurve*)>;
Curve srgb_curve() {
  const cmsFloat64Number p[5] = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
  return {cmsBuildParametricToneCurve(nullptr, 4, p), cmsFreeToneCurve};
}
Curve gamma_curve(double gamma) { return {cmsBuildGamma(nullptr, gamma), cmsFreeToneCurve}; }

Bytes rgb_profile(const Primaries& p, const Curve& curve) {
  const cmsCIExyY white = {0.3127, 0.3290, 1};
  const cmsCIExyYTRIPLE primaries = {{p.rx, p.ry, 1}, {p.gx, p.gy, 1}, {p.bx, p.by, 1}};
  cmsToneCurve* const curves[3] = {curve.get(), curve.get(), curve.get()};
  return saved(cmsCreateRGBProfile(&white, &primaries, curves));
}

// RGB to XYZ from chromaticities and the D65 white they share (SMPTE RP 177).
Eigen::Matrix3d xyz_from_rgb(const Primaries& p) {
  Eigen::Matrix3d m;
  const double xy[3][2] = {{p.rx, p.ry}, {p.gx, p.gy}, {p.bx, p.by}};
  for (int k = 0; k < 3; ++k) m.col(k) << xy[k][0] / xy[k][1], 1, (1 - xy[k][0] - xy[k][1]) / xy[k][1];
  const Eigen::Vector3d white(0.3127 / 0.3290, 1, (1 - 0.3127 - 0.3290) / 0.3290);
  return m * (m.inverse() * white).asDiagonal();
}

OIIO::ParamValueList with_profile(const Bytes& profile) {
  OIIO::ParamValueList list;
  list.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())), profile.data());
  return list;
}

ByteImage flat(const std::vector<std::array<std::uint8_t, 3>>& colours) {
  ByteImage image(static_cast<int>(colours.size()), 2, 3);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < image.width(); ++x)
      std::copy_n(colours[static_cast<std::size_t>(x)].data(), 3, image.pixel(x, y));
  }
  return image;
}

// A profile stores primaries as 1/65536 and curves likewise, and white is adapted by lcms's Bradford matrix: 1e-3 covers it.
constexpr double kProfileTolerance = 1e-3;

const std::vector<std::array<std::uint8_t, 3>> kColours = {{255, 255, 255}, {128, 128, 128}, {200, 120, 90},
                                                           {255, 0, 0},     {0, 255, 0},     {30, 60, 200}};

TEST(Colour, NoProfileIsSrgb) {
  TempFolder folder;
  write_bytes("png", folder / "x.png", flat(kColours));
  const Photo photo = load_photo(folder / "x.png");
  EXPECT_EQ(photo.colour_space, "sRGB (assumed)");
  for (int x = 0; x < photo.linear.width(); ++x) {
    for (int c = 0; c < 3; ++c) {
      const float code = static_cast<float>(kColours[static_cast<std::size_t>(x)][static_cast<std::size_t>(c)]) / 255.0F;
      EXPECT_FLOAT_EQ(photo.linear(x, 1, c), linear_from_srgb(code));
    }
  }
}

void expect_converted(const Primaries& primaries, const Curve& curve, double (*decode)(double)) {
  TempFolder folder;
  const Bytes profile = rgb_profile(primaries, curve);
  const Eigen::Matrix3d m = xyz_from_rgb(kRec709).inverse() * xyz_from_rgb(primaries);
  for (const char* format : {"png", "tiff"}) {
    write_bytes(format, folder / "x", flat(kColours), with_profile(profile));
    const Photo photo = load_photo(folder / "x");
    EXPECT_TRUE(photo.warnings.empty()) << photo.warnings.front();
    for (int x = 0; x < photo.linear.width(); ++x) {
      Eigen::Vector3d encoded;
      for (int c = 0; c < 3; ++c)
        encoded[c] = decode(kColours[static_cast<std::size_t>(x)][static_cast<std::size_t>(c)] / 255.0);
      const Eigen::Vector3d expected = (m * encoded).cwiseMax(0.0);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(photo.linear(x, 0, c), expected[c], kProfileTolerance) << format << " " << x;
    }
  }
}

double decode_srgb_value(double code) { return linear_from_srgb(static_cast<float>(code)); }
double decode_adobe_value(double code) { return std::pow(code, 563.0 / 256.0); }

TEST(Colour, DisplayP3) { expect_converted(kDisplayP3, srgb_curve(), decode_srgb_value); }
TEST(Colour, AdobeRgb) { expect_converted(kAdobe, gamma_curve(563.0 / 256.0), decode_adobe_value); }

TEST(Colour, SrgbProfileGivesExactlyWhatNoProfileGives) {
  TempFolder folder;
  write_bytes("png", folder / "plain.png", flat(kColours));
  write_bytes("png", folder / "tagged.png", flat(kColours), with_profile(rgb_profile(kRec709, srgb_curve())));
  const Photo tagged = load_photo(folder / "tagged.png");
  EXPECT_NE(tagged.colour_space, "sRGB (assumed)");
  EXPECT_EQ(tagged.linear, load_photo(folder / "plain.png").linear);
}

// The table-and-matrix path against lcms's own transform between the same two profiles.
TEST(Colour, FastPathAgreesWithLcms) {
  const Bytes profile = rgb_profile(kDisplayP3, gamma_curve(1.8));
  std::string problem;
  const auto model = model_from_icc(profile, 3, 65536, problem);
  ASSERT_TRUE(model) << problem;
  ASSERT_FALSE(model->transform);
  const Bytes linear = rgb_profile(kRec709, gamma_curve(1.0));
  const auto open = [](const Bytes& b) {
    return cmsOpenProfileFromMem(b.data(), static_cast<cmsUInt32Number>(b.size()));
  };
  cmsHPROFILE from = open(profile);
  cmsHPROFILE to = open(linear);
  cmsHTRANSFORM transform =
      cmsCreateTransform(from, TYPE_RGB_FLT, to, TYPE_RGB_FLT, INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOCACHE);
  for (std::uint16_t v = 0; v < 60000; v = static_cast<std::uint16_t>(v + 1499)) {
    const std::uint16_t codes[3] = {v, static_cast<std::uint16_t>(60000 - v), 30000};
    const float unit[3] = {static_cast<float>(codes[0]) / 65535.0F, static_cast<float>(codes[1]) / 65535.0F,
                           30000.0F / 65535.0F};
    float expected[3];
    float found[3];
    cmsDoTransform(transform, unit, expected, 1);
    model->to_linear(codes, 3, 1, found);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], std::max(expected[c], 0.0F), 2e-4F);  // both round XYZ to 1/65536
  }
  cmsDeleteTransform(transform);
  cmsCloseProfile(from);
  cmsCloseProfile(to);
}

TEST(Colour, GreyProfile) {
  TempFolder folder;
  const cmsCIExyY white = {0.3127, 0.3290, 1};
  const Bytes profile = saved(cmsCreateGrayProfile(&white, gamma_curve(1.8).get()));
  write_bytes("tiff", folder / "x.tif", gradient(32, 8, 1), with_profile(profile));
  const Photo photo = load_photo(folder / "x.tif");
  const ByteImage codes = gradient(32, 8, 1);
  EXPECT_TRUE(photo.warnings.empty());
  EXPECT_TRUE(photo.grey);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(photo.linear(20, 3, c), std::pow(codes(20, 3) / 255.0, 1.8), kProfileTolerance);
}

TEST(Colour, ProfilesThatCannotBeUsedGiveAWarningAndSrgb) {
  TempFolder folder;
  const ByteImage image = flat(kColours);
  write_bytes("tiff", folder / "plain.tif", image);
  const Image expected = load_photo(folder / "plain.tif").linear;
  Bytes damaged = rgb_profile(kDisplayP3, srgb_curve());
  for (std::size_t i = 128; i < damaged.size(); ++i) damaged[i] = static_cast<std::byte>(0xA5);
  const cmsCIExyY white = {0.3127, 0.3290, 1};
  const Bytes grey = saved(cmsCreateGrayProfile(&white, gamma_curve(1.8).get()));
  const Bytes noise = to_bytes("this is no profile at all, only text");
  const Bytes huge(5 << 20, std::byte{1});
  for (const Bytes* profile : std::initializer_list<const Bytes*>{&damaged, &grey, &noise, &huge}) {
    write_bytes("tiff", folder / "x.tif", image, with_profile(*profile));
    const Photo photo = load_photo(folder / "x.tif");
    ASSERT_EQ(photo.warnings.size(), 1U);
    EXPECT_NE(photo.warnings[0].find("ICC profile"), std::string::npos) << photo.warnings[0];
    EXPECT_NE(photo.warnings[0].find("sRGB is assumed"), std::string::npos) << photo.warnings[0];
    EXPECT_EQ(photo.linear, expected);
    EXPECT_EQ(photo.colour_space, "sRGB (assumed)");
  }
}

}  // namespace
}  // namespace faceprobe::io
