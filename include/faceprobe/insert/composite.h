#pragma once
// Rendered layers over a photo, in linear light. Per pixel, with coverage a of the model and g of the ground, and shadow s:
//
//   picture = model + (g s + 1 - a - g) photo,
//
// and where the matte says that someone stands nearer than model or ground, the photo is kept.

#include "faceprobe/insert/insert.h"

namespace faceprobe::insert {

// How much of each pixel is hidden behind the matte's person: [0] of the model, [1] of the ground. Sizes of `layers`.
struct Hidden {
  Image model, ground;  // 0..1
};
// `part`: the view that the layers were drawn with; `box`: where that lies in the photo, of the layers' size. `matte`: the photo's size.
Hidden hidden_by(const Matte& matte, const render::Layers& layers, const render::PinholeView& part,
                 const std::optional<render::Ground>& ground, const PixelBox& box);

// Writes into the box of `picture`, which holds the photo, linear, 3 channels. `hidden` may be empty pictures.
void composite(Image& picture, const PixelBox& box, const render::Layers& layers, const Hidden& hidden);

}  // namespace faceprobe::insert
