#pragma once
// Lights that are smaller than a cell: distant ones and lamps at a place, with a shadow ray each for every point they may reach.

#include "faceprobe/synth/light_sample.h"
#include "synth/transport/known_sky.h"
#include "synth/transport/light_points.h"

namespace faceprobe::synth {

// Adds the light that reaches the points first .. first + count - 1.

// lit[row]: LightSeen of the row's vertex. A ray is traced where `sky` does not know.
void add_distant(const Scene& scene, const SurfacePoints& vertices, int first, int count, const DistantLight& light,
                 const KnownSky& sky, Eigen::MatrixX3f& shading, std::uint8_t* lit);
// The lamp's middle throws the shadow, and its irradiance is exact above the horizon.
void add_near(const Scene& scene, const SurfacePoints& vertices, int first, int count, const NearLight& light,
              Eigen::MatrixX3f& shading);

// `lit`: what add_distant() said of the vertices. Where all three around a fragment are certain of the same, no ray is traced. Where they
// disagree, with one another or with the fragment's own ray, a shadow's edge is near, and four more rays from over the pixel make it
// smooth.
void add_distant(const Scene& scene, const SurfacePoints& fragments, int first, int count, const DistantLight& light,
                 const std::uint8_t* lit, Eigen::MatrixX3f& shading, Eigen::MatrixX3f& specular);
// `samples`: points on the lamp.
void add_near(const Scene& scene, const SurfacePoints& fragments, int first, int count, const NearLight& light,
              int samples, Eigen::MatrixX3f& shading, Eigen::MatrixX3f& specular);

// All hairs. A ray says whether one strand is lit; what a picture shows is many, so shadows are means over neighbouring pixels.
void add_distant(const Scene& scene, const HairPoints& hairs, const DistantLight& light, Eigen::MatrixX3f& shading,
                 Eigen::MatrixX3f& specular);
void add_near(const Scene& scene, const HairPoints& hairs, const NearLight& light, int samples,
              Eigen::MatrixX3f& shading, Eigen::MatrixX3f& specular);

}  // namespace faceprobe::synth
