#include "io/icc.h"

#include "faceprobe/core/color.h"

#include <lcms2.h>
#include <Eigen/LU>
#include <memory>
#include <type_traits>

namespace faceprobe::io {
namespace {

// Own context: no global error handler, and safe in any thread.
struct ProfileDeleter {
  void operator()(void* profile) const { cmsCloseProfile(profile); }
};
using Context = std::shared_ptr<std::remove_pointer_t<cmsContext>>;
using Profile = std::unique_ptr<void, ProfileDeleter>;

constexpr double kSrgbTolerance = 2e-3;  // sRGB profiles of different makers differ by this much in curve and primaries

Profile linear_rec709(const Context& context) {
  const cmsCIExyY white = {0.3127, 0.3290, 1.0};
  const cmsCIExyYTRIPLE primaries = {{0.640, 0.330, 1.0}, {0.300, 0.600, 1.0}, {0.150, 0.060, 1.0}};
  const std::unique_ptr<cmsToneCurve, void (*)(cmsToneCurve*)> line(cmsBuildGamma(context.get(), 1.0), cmsFreeToneCurve);
  cmsToneCurve* const curves[3] = {line.get(), line.get(), line.get()};
  return Profile(cmsCreateRGBProfileTHR(context.get(), &white, &primaries, curves));
}

// Columns: XYZ (D50) of the profile's red, green and blue.
std::optional<Eigen::Matrix3d> colorants(cmsHPROFILE profile) {
  Eigen::Matrix3d m;
  const cmsTagSignature tags[3] = {cmsSigRedColorantTag, cmsSigGreenColorantTag, cmsSigBlueColorantTag};
  for (int k = 0; k < 3; ++k) {
    const auto* xyz = static_cast<const cmsCIEXYZ*>(cmsReadTag(profile, tags[k]));
    if (xyz == nullptr) return std::nullopt;
    m.col(k) << xyz->X, xyz->Y, xyz->Z;
  }
  if (!m.allFinite() || m.cwiseAbs().maxCoeff() > 10) return std::nullopt;
  return m;
}

std::vector<float> sample_tag(cmsHPROFILE profile, cmsTagSignature tag, std::size_t levels) {
  const auto* curve = static_cast<const cmsToneCurve*>(cmsReadTag(profile, tag));
  if (curve == nullptr) return {};
  std::vector<float> table =
      sample_curve(levels, [curve](double code) { return cmsEvalToneCurveFloat(curve, static_cast<float>(code)); });
  for (const float value : table) {
    if (!(std::abs(value) <= 10.0F)) return {};  // also NaN: a damaged curve
  }
  return table;
}

bool has_lookup_table(cmsHPROFILE profile) {
  for (const cmsTagSignature tag : {cmsSigAToB0Tag, cmsSigAToB1Tag, cmsSigDToB0Tag, cmsSigDToB1Tag}) {
    if (cmsIsTag(profile, tag)) return true;
  }
  return false;
}

bool is_srgb(const Eigen::Matrix3d& to_rec709, const ColourModel& model, std::size_t levels) {
  if (!to_rec709.isIdentity(kSrgbTolerance)) return false;
  for (const std::vector<float>& table : model.curve) {
    for (std::size_t i = 0; i < levels; ++i) {
      const float code = static_cast<float>(i) / static_cast<float>(levels - 1);
      if (std::abs(table[i] - linear_from_srgb(code)) > kSrgbTolerance) return false;
    }
  }
  return true;
}

// Curves and primaries straight from their tags: what a transform would compute per pixel, at the price of a table.
bool fill_from_curves(cmsHPROFILE profile, cmsHPROFILE target, std::size_t levels, ColourModel& model) {
  if (model.channels == 1) {
    model.curve[0] = sample_tag(profile, cmsSigGrayTRCTag, levels);
    return !model.curve[0].empty();
  }
  const std::optional<Eigen::Matrix3d> source = colorants(profile);
  const std::optional<Eigen::Matrix3d> rec709 = colorants(target);
  if (!source || !rec709 || std::abs(source->determinant()) < 1e-6) return false;
  const cmsTagSignature tags[3] = {cmsSigRedTRCTag, cmsSigGreenTRCTag, cmsSigBlueTRCTag};
  for (std::size_t k = 0; k < 3; ++k) {
    model.curve[k] = sample_tag(profile, tags[k], levels);
    if (model.curve[k].empty()) return false;
  }
  const Eigen::Matrix3d to_rec709 = rec709->inverse() * *source;
  if (is_srgb(to_rec709, model, levels)) {
    model.curve = srgb_model(3, levels).curve;  // the standard's curve instead of the maker's rounding of it
  } else {
    model.matrix = to_rec709.cast<float>();
  }
  return true;
}

bool fill_from_transform(const Context& context, cmsHPROFILE profile, cmsHPROFILE target, ColourModel& model) {
  const auto channels = static_cast<cmsUInt32Number>(model.channels);
  const cmsUInt32Number space = model.channels == 1 ? PT_GRAY : PT_RGB;
  const cmsUInt32Number input = FLOAT_SH(1) | COLORSPACE_SH(space) | CHANNELS_SH(channels) | BYTES_SH(4);
  std::shared_ptr<void> transform(cmsCreateTransformTHR(context.get(), profile, input, target, TYPE_RGB_FLT,
                                                        INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOCACHE),
                                  [context](void* made) {  // keeps the context alive as long as the transform
                                    if (made != nullptr) cmsDeleteTransform(made);
                                  });
  if (!transform) return false;
  model.transform = [transform](const float* codes, float* rgb, std::size_t n) {
    cmsDoTransform(transform.get(), codes, rgb, static_cast<cmsUInt32Number>(n));
  };
  return true;
}

std::string description(cmsHPROFILE profile) {
  char text[80] = {};
  cmsGetProfileInfoASCII(profile, cmsInfoDescription, "en", "US", text, sizeof(text));
  text[sizeof(text) - 1] = '\0';
  std::string name;
  for (const char* c = text; *c != '\0'; ++c) {
    if (*c >= ' ' && *c <= '~') name += *c;
  }
  return name.empty() ? "unnamed ICC profile" : name;
}

}  // namespace

std::optional<ColourModel> model_from_icc(std::span<const std::byte> profile_bytes, int channels, std::size_t levels,
                                          std::string& problem) {
  const Context context(cmsCreateContext(nullptr, nullptr), cmsDeleteContext);
  const Profile profile(cmsOpenProfileFromMemTHR(context.get(), profile_bytes.data(),
                                                 static_cast<cmsUInt32Number>(profile_bytes.size())));
  if (!profile) {
    problem = "is damaged";
    return std::nullopt;
  }
  const cmsColorSpaceSignature wanted = channels == 1 ? cmsSigGrayData : cmsSigRgbData;
  const cmsProfileClassSignature kind = cmsGetDeviceClass(profile.get());
  if (cmsGetColorSpace(profile.get()) != wanted || kind == cmsSigLinkClass || kind == cmsSigAbstractClass ||
      kind == cmsSigNamedColorClass) {
    problem = std::string("is not for ") + (channels == 1 ? "grey" : "RGB") + " pictures";
    return std::nullopt;
  }
  const Profile target = linear_rec709(context);
  ColourModel model;
  model.name = description(profile.get());
  model.channels = channels;
  const bool filled = !has_lookup_table(profile.get()) && levels > 0
                          ? fill_from_curves(profile.get(), target.get(), levels, model)
                          : fill_from_transform(context, profile.get(), target.get(), model);
  if (!filled) {
    problem = "is damaged";
    return std::nullopt;
  }
  return model;
}

}  // namespace faceprobe::io
