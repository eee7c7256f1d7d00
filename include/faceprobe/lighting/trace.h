#pragma once
// The paper's environment map initialisation (section 4.1): each direction of the sphere looks up the face normal that mirrors it
// into the camera, N = (L + V) / |L + V|, and takes a highlight value interpolated from the nearest observed normals. Values are
// carried over as they are: a highlight is a function of the mirror direction, no Jacobian belongs to it.
//
//   const TracedMap traced = trace_highlights(observations, recolour_highlights(observations), SphereGrid(16));

#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/observations.h"

#include <string>

namespace faceprobe::lighting {

struct TraceOptions {
  int neighbours = 8;            // observed normals that a direction is interpolated from
  float max_normal_gap_deg = 6;  // directions whose mirror normal is further from any observed one stay unobserved

  std::string validate() const;  // empty when usable, else which value is wrong
};

struct TracedMap {
  Eigen::MatrixX3f value;           // #cells x 3, highlight traced to the cell; 0 where unobserved
  Eigen::VectorXf roughness;        // #cells, of the skin the value comes from
  Eigen::VectorXf specular_albedo;  // #cells
  Eigen::VectorXf weight;           // #cells, 1 where observed, else 0
};

// `highlight`: #patches x 3, usually recoloured. The view direction is the mean one (the paper's orthographic camera).
// Throws std::invalid_argument for another number of rows and options that do not validate.
TracedMap trace_highlights(const Observations& observations, const Eigen::MatrixX3f& highlight, const SphereGrid& grid,
                           const TraceOptions& options = {});

}  // namespace faceprobe::lighting
