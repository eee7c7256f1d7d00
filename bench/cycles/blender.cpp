#include "cycles/blender.h"

#include "cycles/append_matrix.h"
#include "cycles/passes.h"
#include "cycles/run_blender.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/picture_file.h"

#include <fstream>
#include <nlohmann/json.hpp>

namespace faceprobe::bench {

namespace {

CyclesPicture read_passes(const std::filesystem::path& path) {
  const PassFile file(path);
  CyclesPicture picture;
  picture.diffuse = file.pass("DiffDir", "RGB");
  picture.glossy = file.pass("GlossDir", "RGB");
  picture.coverage = file.pass("Combined", "A");
  return picture;
}

}  // namespace

void write_map_for_blender(const std::filesystem::path& path, const EnvMap& map) {
  io::write_picture(path, to_orientation(map, Orientation::kThree).radiance(), {}, false);
}

std::vector<CyclesPicture> render_with_cycles(const CyclesSetup& setup, const std::vector<CyclesRender>& renders) {
  const std::filesystem::path folder = std::filesystem::absolute(setup.folder);
  const std::filesystem::path mesh_file = folder / "mesh.bin";
  const std::filesystem::path report_file = folder / "report.json";
  const std::filesystem::path log_file = folder / "blender.log";
  {
    std::ofstream file(mesh_file, std::ios::binary);
    append(file, setup.mesh_cam.vertices);
    append(file, setup.mesh_cam.normals);
    append(file, setup.mesh_cam.triangles);
    if (!file.flush()) throw Error(ExitCode::kOutput, "Cannot write " + mesh_file.string() + ".");
  }
  nlohmann::json job = {{"mesh", mesh_file.string()},
                        {"vertices", setup.mesh_cam.vertices.rows()},
                        {"triangles", setup.mesh_cam.triangles.rows()},
                        {"width", setup.camera.width_px},
                        {"height", setup.camera.height_px},
                        {"focal_px", setup.camera.focal_px},
                        {"alpha", setup.alpha},
                        {"threads", setup.threads},
                        {"report", report_file.string()},
                        {"renders", nlohmann::json::array()}};
  std::vector<std::filesystem::path> pictures;
  for (const CyclesRender& render : renders) {
    pictures.push_back(folder / ("cycles_" + std::to_string(pictures.size()) + ".exr"));
    job["renders"].push_back({{"map", std::filesystem::absolute(render.map).string()},
                              {"samples", render.samples},
                              {"seed", render.seed},
                              {"light_threshold", render.light_threshold},
                              {"out", pictures.back().string()}});
  }
  const std::filesystem::path job_file = folder / "job.json";
  std::ofstream(job_file) << job.dump(1);
  std::filesystem::remove(report_file);
  if (!run_blender(setup.blender, FACEPROBE_CYCLES_SCRIPT, job_file, log_file) || !std::filesystem::exists(report_file)) {
    throw Error(ExitCode::kModel, "Blender (" + setup.blender + ") did not finish; see " + log_file.string() +
                                      ". Blender 3.x with Cycles is needed; name it with --blender.");
  }
  std::ifstream report(report_file);
  const std::vector<double> seconds = nlohmann::json::parse(report).at("seconds").get<std::vector<double>>();
  std::vector<CyclesPicture> out;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    out.push_back(read_passes(pictures[i]));
    out.back().seconds = seconds.at(i);
  }
  return out;
}

}  // namespace faceprobe::bench
