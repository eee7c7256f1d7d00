#include "faceprobe/eval/geometry_benchmark.h"
#include "faceprobe/face/geometry.h"
#include "faceprobe/io/data_files.h"

#include <utility>

namespace faceprobe::eval {

GeometryMethod mesh_method(std::shared_ptr<const face::FaceFinder> finder) {
  return surface_method("mesh", std::move(finder), {});
}

GeometryMethod surface_method(std::string name, std::shared_ptr<const face::FaceFinder> finder, face::SurfaceFit fit) {
  auto mesh =
      std::make_shared<const face::CanonicalMesh>(face::load_canonical_mesh(io::data_file("canonical-face-model.obj")));
  return {std::move(name),
          [finder = std::move(finder), mesh, fit = std::move(fit)](const PhotoInput& input) -> GeometryEstimate {
            const std::vector<face::Face> found = finder->find(input.linear, input.camera);
            if (found.empty()) return {};
            const face::Face& largest = face::largest_of(found);
            const face::Crop whole{
                .x_px = 0, .y_px = 0, .scale = 1, .width = input.linear.width(), .height = input.linear.height()};
            face::FaceGeometry geometry = face::rasterize(largest, input.camera, *mesh, whole);
            if (fit) fit(largest, input.camera, geometry);
            return {std::move(geometry.normal_cam), {}, std::move(geometry.region)};
          }};
}

}  // namespace faceprobe::eval
