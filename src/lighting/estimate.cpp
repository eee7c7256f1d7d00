#include "faceprobe/lighting/estimate.h"

#include "faceprobe/core/error.h"

#include <stdexcept>

namespace faceprobe::lighting {

std::string_view solver_name(Solver solver) { return solver == Solver::kPaper ? "paper" : "transport"; }

Solver solver_from_name(std::string_view name) {
  if (name == "transport") return Solver::kTransport;
  if (name == "paper") return Solver::kPaper;
  throw Error(ExitCode::kUsage, "There is no solver '" + std::string(name) + "'; choose transport or paper.");
}

std::string SolveOptions::validate() const {
  if (nside < 2 || nside > 32) return "nside must be from 2 to 32, found " + std::to_string(nside) + ".";
  if (iterations < 1 || iterations > 10'000) {
    return "iterations must be from 1 to 10000, found " + std::to_string(iterations) + ".";
  }
  if (iterations_from_expected < 1) return "iterations_from_expected must be 1 or more.";
  if (!(highlight_weight >= 0 && shading_weight >= 0 && highlight_weight + shading_weight > 0 &&
        highlight_weight + shading_weight < 1e6F)) {
    return "The weights of highlights and shading must not be negative, nor both zero.";
  }
  if (!(prior_weight >= 0 && prior_weight < 1e6F)) return "prior_weight must be from 0 to a million.";
  if (!(highlight_gain > 0 && highlight_gain < 1e6F)) return "highlight_gain must lie between 0 and a million.";
  if (!(max_leak >= 0 && max_leak <= 1)) return "max_leak must lie in [0, 1].";
  if (colour_iterations < 0 || colour_iterations > 1000) return "colour_iterations must be from 0 to 1000.";
  return {};
}

Light solve(const Observations& observations, const SolveOptions& options, const Eigen::MatrixX3f& expected) {
  return options.solver == Solver::kPaper ? solve_paper(observations, options)
                                          : solve_transport(observations, options, expected);
}

}  // namespace faceprobe::lighting
