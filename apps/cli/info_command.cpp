#include "commands.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "json_line.h"
#include "shared_options.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace faceprobe::cli {

namespace {

struct Options : SharedOptions {
  bool json = false;
};

std::string clipped_share(const io::Photo& photo) {
  std::size_t clipped = 0;
  for (const std::uint8_t flags : photo.clipped.values()) clipped += (flags & 7) != 0 ? 1U : 0U;
  char text[32];
  std::snprintf(text, sizeof text, "%.2f %%",
                100.0 * static_cast<double>(clipped) / static_cast<double>(photo.clipped.pixel_count()));
  return text;
}

nlohmann::ordered_json describe(const std::string& source, const io::Photo& photo, const std::vector<face::Face>& faces) {
  nlohmann::ordered_json out = {{"source", source},
                                {"format", photo.format},
                                {"width_px", photo.linear.width()},
                                {"height_px", photo.linear.height()},
                                {"bits_per_channel", photo.bits_per_channel},
                                {"colour_space", photo.colour_space},
                                {"grey", photo.grey},
                                {"exif_orientation_applied", photo.exif_orientation},
                                {"clipped", clipped_share(photo)}};
  out["focal_px"] = photo.focal_px ? nlohmann::ordered_json(*photo.focal_px) : nlohmann::ordered_json();
  out["faces"] = nlohmann::ordered_json::array();
  for (const face::Face& face : faces) {
    const Eigen::Vector3d position = face.position_m();
    out["faces"].push_back(
        {{"box_px", {{"x", face.box.x}, {"y", face.box.y}, {"width", face.box.width}, {"height", face.box.height}}},
         {"score", face.score},
         {"position_m", {position.x(), position.y(), position.z()}},
         {"yaw_deg", azimuth_deg(face.camera_from_face.rotation().col(2))}});
  }
  out["warnings"] = photo.warnings;
  return out;
}

void print(const nlohmann::ordered_json& d) {
  std::printf("%s\n  %s, %d x %d px, %d bit, %s%s, %s clipped\n", d["source"].get<std::string>().c_str(),
              d["format"].get<std::string>().c_str(), d["width_px"].get<int>(), d["height_px"].get<int>(),
              d["bits_per_channel"].get<int>(), d["colour_space"].get<std::string>().c_str(),
              d["grey"].get<bool>() ? ", grey" : "", d["clipped"].get<std::string>().c_str());
  for (const auto& face : d["faces"]) {
    std::printf("  face %.0f x %.0f px at (%.0f, %.0f), %.2f m away, turned %+.0f deg, score %.2f\n",
                face["box_px"]["width"].get<double>(), face["box_px"]["height"].get<double>(),
                face["box_px"]["x"].get<double>(), face["box_px"]["y"].get<double>(),
                -face["position_m"][2].get<double>(), face["yaw_deg"].get<double>(), face["score"].get<double>());
  }
  if (d["faces"].empty()) std::printf("  no face\n");
  for (const auto& warning : d["warnings"]) std::printf("  %s\n", warning.get<std::string>().c_str());
}

int run(const Options& options) {
  const pipeline::Estimator estimator(estimate_options(options));
  int code = 0;
  for (const std::string& input : options.inputs) {
    const int one = run_guarded([&] {
      const io::Photo photo = io::load_photo(input, options.limits);
      const nlohmann::ordered_json description = describe(input, photo, estimator.find_faces(photo));
      if (options.json) {
        print_json_line(description);
      } else {
        print(description);
      }
      return 0;
    });
    if (one != 0) code = options.inputs.size() > 1 ? static_cast<int>(ExitCode::kBatchFailures) : one;
  }
  return code;
}

}  // namespace

void add_info(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("info", "what a photo file is, and which faces are in it");
  add_inputs(*command, *options);
  command->add_flag("--json", options->json, "one JSON object per photo and line");
  command->footer("Example:\n  faceprobe info --json *.jpg > photos.jsonl");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli
