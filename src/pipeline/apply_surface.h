#pragma once
// Puts what the network sees of a face's surface in the place of what the mesh says.

#include "pipeline/face_reader.h"

namespace faceprobe::pipeline {

// Where the mesh covers the face: the network's normals and their errors.
void apply_normals(const Surface& surface, face::FaceGeometry& geometry);
// There too: the network's regions, so that hair, glasses and hands before the face are no skin.
void apply_regions(const Surface& surface, face::FaceGeometry& geometry);

struct AlbedoShading {
  Image albedo;                  // H x W x 3
  Image shading;                 // H x W x 3; 0 off the skin
  Eigen::Vector3f light_colour;  // mean shading on the skin, green = 1
};
// albedo * shading = diffuse on the skin (`skin`: H x W x 1, non-zero). `shading`: H x W x 3, on the skin and off it.
AlbedoShading split_diffuse(const Image& shading, const Image& diffuse, const ByteImage& skin);

}  // namespace faceprobe::pipeline
