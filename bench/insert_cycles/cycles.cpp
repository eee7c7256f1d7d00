#include "insert_cycles/cycles.h"

#include "cycles/append_matrix.h"
#include "cycles/passes.h"
#include "cycles/run_blender.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/picture_file.h"

#include <fstream>
#include <nlohmann/json.hpp>

namespace faceprobe::bench {

namespace {

namespace fs = std::filesystem;

nlohmann::json write_mesh(const fs::path& path, const render::TriangleMesh& mesh, const nlohmann::json& material) {
  std::ofstream file(path, std::ios::binary);
  append(file, mesh.vertices);
  append(file, mesh.normals);
  append(file, mesh.triangles);
  if (!file.flush()) throw Error(ExitCode::kOutput, "Cannot write " + path.string() + ".");
  return {{"file", path.string()},
          {"vertices", mesh.vertices.rows()},
          {"triangles", mesh.triangles.rows()},
          {"material", material}};
}

nlohmann::json described(const std::string& kind, const render::Material& material) {
  return {{"kind", kind}, {"colour", material.colour.x()}, {"roughness", material.roughness}, {"index", material.ior}};
}

}  // namespace

std::vector<TimedPicture> render_with_cycles(const CyclesJob& job, const render::Model& model,
                                             const TestMaterial& material, const std::vector<TestMap>& maps,
                                             const std::vector<CyclesShot>& shots) {
  const fs::path folder = fs::absolute(job.folder);
  fs::create_directories(folder);
  const fs::path report_file = folder / "report.json";
  const fs::path log_file = folder / "blender.log";
  const render::PinholeView view = scene_view(job.size_px);
  nlohmann::json out = {{"width", view.width_px},
                        {"height", view.height_px},
                        {"focal_px", view.focal_px},
                        {"threads", job.threads},
                        {"max_bounces", job.max_bounces},
                        {"report", report_file.string()},
                        {"meshes", nlohmann::json::array()},
                        {"renders", nlohmann::json::array()}};
  for (const render::TriangleMesh& mesh : model.meshes) {
    const bool is_thing = mesh.material == 0;
    out["meshes"].push_back(write_mesh(
        folder / ("mesh_" + std::to_string(out["meshes"].size()) + ".bin"), mesh,
        described(is_thing ? material.name : "diffuse", model.materials[static_cast<std::size_t>(mesh.material)])));
  }
  std::vector<fs::path> map_files;
  for (const TestMap& map : maps) {
    map_files.push_back(folder / ("map_" + std::to_string(map_files.size()) + ".exr"));
    io::write_picture(map_files.back(), to_orientation(map.radiance, Orientation::kThree).radiance(), {}, false);
  }
  std::vector<fs::path> pictures;
  for (const CyclesShot& shot : shots) {
    pictures.push_back(folder / ("cycles_" + std::to_string(pictures.size()) + ".exr"));
    out["renders"].push_back({{"map", map_files.at(shot.map).string()},
                              {"samples", shot.samples},
                              {"seed", shot.seed},
                              {"out", pictures.back().string()}});
  }
  const fs::path job_file = folder / "job.json";
  std::ofstream(job_file) << out.dump(1);
  fs::remove(report_file);
  if (!run_blender(job.blender, FACEPROBE_CYCLES_MODEL_SCRIPT, job_file, log_file) || !fs::exists(report_file)) {
    throw Error(ExitCode::kModel, "Blender (" + job.blender + ") did not finish; see " + log_file.string() +
                                      ". Blender 3.x with Cycles is needed; name it with --blender.");
  }
  std::ifstream file(report_file);
  const nlohmann::json renders = nlohmann::json::parse(file).at("renders");
  std::vector<TimedPicture> done;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const nlohmann::json& report = renders.at(i);
    done.push_back({PassFile(pictures[i]).pass("Combined", "RGBA"),
                    report.at("seconds").get<double>() + report.at("set_up").get<double>(),
                    report.at("cpu_seconds").get<double>()});
  }
  return done;
}

}  // namespace faceprobe::bench
