#pragma once
// The look of a photo that a rendered object must share to belong in it: how grainy and how sharp the photo is, both measured
// on the photo itself, and the means to make a clean picture as grainy and as soft.
//
// Not for denoising or deblurring: the figures describe the photo as a whole, at its own size, and a resized photo has others.
// Grain is told from texture by its being everywhere; a photo with no flat patch reads as too grainy, and one that smoothed its
// dark or bright parts as a little too clean. JPEG removes grain first where it is weakest, and what is left is
// what is measured. The rounding to 8 bits reads as a sigma of about .001.
//
//   const Grain grain = estimate_grain(photo);
//   const float extra = blur_to_match(estimate_blur_px(photo), kRenderedBlurPx);
//   const Image soft = blur(rendered_rgba, extra);                     // premultiplied: colour and cover alike
//   Image picture = over(soft, photo);                                 // any compositing
//   add_grain(picture, cover, grain, seed);                            // cover: 1 where the object is, 0 where the photo is

#include "faceprobe/core/image.h"

#include <array>
#include <cstdint>
#include <string>

namespace faceprobe::insert {

// Noise of a photo in sRGB-encoded units: 1 = from black to white. A part that all channels share, and a part of colour that
// leaves the mean of the channels alone. Each is white noise that went through a Gaussian.
struct Grain {
  static constexpr float kMostColour = 100;  // largest value of `colour`

  // Standard deviation of the mean of the channels, at an encoded brightness of .1, .3, .5, .7, .9.
  std::array<float, 5> sigma{};
  float correlation_px = 0;         // that Gaussian's deviation; 0 = white
  float colour = 0;                 // deviation of a channel from the mean (rms of the three), as a multiple of sigma
  float colour_correlation_px = 0;  // mostly larger: chroma is kept at half size

  // At an encoded brightness; straight between the five levels, constant beyond them.
  float sigma_at(float brightness) const;
  std::string validate() const;  // empty when usable
};

// `linear`: one or three channels. All 0 when no patch of 16 x 16 pixels is free of clipped values.
// Throws std::invalid_argument for another number of channels.
Grain estimate_grain(const Image& linear);

// Adds grain to `linear`, one or three channels, by the share `where` says (the same size, one channel, 0 .. 1). Pixels where it
// is 0 keep their bits, light is never below 0, values that are not finite stay. The grain of a pixel depends on its place and
// the seed alone, so a crop of `where` changes nothing inside the crop.
// Throws std::invalid_argument for sizes that do not fit and for a grain that does not validate.
void add_grain(Image& linear, const Image& where, const Grain& grain, std::uint64_t seed);

// What estimate_blur_px says of a picture without an edge it could measure.
inline constexpr float kUnknownBlurPx = 0.5F;
// Of a picture whose pixels are means over their areas, such as a path tracer's with a box filter.
inline constexpr float kRenderedBlurPx = 0.3F;

// Standard deviation, 0 .. 5, of the Gaussian that a perfect step went through to look like the photo's sharpest edges. The
// pixel's own area counts as blur. Below .45 the pixels are too far apart to tell: a perfect step reads as 0 where it lies between
// two pixels, as about .2 where a box filter drew it at a slant, though that has .3. Sharpening in the camera reads as less blur.
// A tone curve other than sRGB's bends the edges and counts too. `linear`: one or three channels; throws std::invalid_argument for another number.
float estimate_blur_px(const Image& linear);

// The Gaussian that brings a picture of `from_px` to `to_px`; 0 when it is as soft already.
float blur_to_match(float to_px, float from_px);

// Through a Gaussian of that deviation, 0 .. 64; each channel alike, so premultiplied colour stays premultiplied. Outside, the
// picture goes on as its nearest pixel. Throws std::invalid_argument for a deviation out of range.
Image blur(const Image& picture, float sigma_px);

}  // namespace faceprobe::insert
