#pragma once
// Begins a U-Net with the weights of a narrower one that has been trained, so that it says nearly the same and has room to learn more: new
// channels are copies of old ones, and what reads them gives each copy its part (Net2WiderNet of Chen, Goodfellow & Shlens 2016).
//
//   net::UNet wide(options);
//   net::load_widened(wide, "models/highlight.safetensors");
//
// Channels are copied within their group of the group norm, whose mean and variance change a little if not all get as many copies.

#include "net/torch/unet.h"

#include <filesystem>

namespace faceprobe::net {

// The file's network must be a U-Net of as many levels and convolutions, nowhere wider, with no more inputs and outputs. Further inputs
// count for nothing at first, further outputs stay as they were. `noise`, of the weights' standard deviation and from torch's generator,
// lets the copies part. Throws Error(kModel).
void load_widened(UNet& net, const std::filesystem::path& weights, double noise = 0.1);

}  // namespace faceprobe::net
