#pragma once
// Pictures of a data set, to be looked at before anything is trained on it.
//
//   io::write_picture("sheet.png", contact_sheet(samples, 8));
//   io::write_picture("layers.png", layer_sheet(samples[0], views[0]));

#include "faceprobe/synth/sample.h"

#include <span>

namespace faceprobe::synth {

// The photos in rows of `columns`, with thin gaps.
ByteImage contact_sheet(std::span<const Sample> samples, int columns);

// Side by side: photo, highlight, diffuse, albedo, shading (brightened or darkened to fit), normals, depth, regions, clipped pixels.
ByteImage layer_sheet(const Sample& sample, const ViewLayers& view);

}  // namespace faceprobe::synth
