#pragma once
// The directions that an estimated light amounts to, as they are compared with known lights.

#include "faceprobe/pipeline/estimate.h"

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace faceprobe::cli {

// Of each cell of the light's grid.
Eigen::VectorXd luminances(const lighting::Light& light);

// A light of another method as a result that the functions below take: with its main lights, and without maps. `radiance`: cells of a sphere grid x 3.
// `confidence`: of each cell; empty = all certain.
pipeline::LightResult result_of(Eigen::MatrixX3f radiance, const Eigen::VectorXf& confidence = {});

// Unit vectors towards the main lights, strongest first; towards the brightest cell alone when there is no main light. Empty for
// an even sky, which says nothing about direction.
std::vector<Eigen::Vector3d> light_directions(const pipeline::LightResult& result);

// Mean direction of the cells above the median luminance, weighted by how much they are above it: where most of the light
// comes from, whatever the number of lights. Empty for an even sky.
std::optional<Eigen::Vector3d> energy_centroid(const pipeline::LightResult& result);

// A yardstick: the one distant lamp, without ambient light and cast shadows, that fits the shading best in the sense of least
// squares (luminance, patches without clipping).
std::optional<Eigen::Vector3d> single_lamp(const lighting::Observations& observations);

// Normalised mean of unit vectors; empty when they cancel or there are none.
std::optional<Eigen::Vector3d> mean_direction(const std::vector<Eigen::Vector3d>& directions);
// Smallest angle to one of the candidates (at least one), in degrees.
double nearest_deg(const Eigen::Vector3d& direction, const std::vector<Eigen::Vector3d>& candidates);

// For each map its mean correlation (Pearson, -1..1) with the maps of other people. `maps`: #cells x #maps. `person`: whose each is. NaN for an
// even map and where there is nobody else. Their mean is that over all pairs of two people when each person has as many maps.
std::vector<double> agreement_with_others(const Eigen::MatrixXd& maps, const std::vector<int>& person);

}  // namespace faceprobe::cli
