#include "faceprobe/pipeline/scene_files.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/core/version.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

namespace faceprobe::pipeline {
namespace {

std::ostringstream number_stream() {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(9);
  return text;
}

std::string triple(const Eigen::Vector3d& v) {
  std::ostringstream text = number_stream();
  text << '(' << v.x() << ", " << v.y() << ", " << v.z() << ')';
  return text.str();
}

// Full angle of a round lamp of that solid angle.
double disc_angle_deg(double solid_angle_sr) {
  return 2 * degrees(std::acos(std::clamp(1 - solid_angle_sr / (2 * kPi), -1.0, 1.0)));
}

// Sun angles beyond this are no longer suns: a wide glow lights as a wide glow.
constexpr double kWidestDeg = 60;

double lamp_angle_deg(const lighting::MainLight& light) {
  return std::clamp(disc_angle_deg(light.solid_angle_sr), 0.5, kWidestDeg);
}

// Lamps shine along their own -z: z towards the light, x and y at right angles to it.
Eigen::Matrix3d lamp_axes(const Eigen::Vector3d& towards) {
  return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), towards).toRotationMatrix();
}

}  // namespace

EnvMap rest_of_environment(const LightResult& light, const EstimateOptions& options) {
  const SphereGrid grid(options.solve.nside);
  const int lamps = light.lights.empty() ? 0 : 1;
  const Eigen::MatrixX3f rest =
      lighting::without_main_lights(light.light.radiance, grid, lamps, options.main_lights, light.light.confidence);
  return env_map_from_grid(rest, grid, options.map_width, options.map_width / 2);
}

std::string usd_scene(const LightResult& light, const std::string& map_file) {
  std::ostringstream text = number_stream();
  text << "#usda 1.0\n(\n    doc = \"Light of a portrait, by faceprobe " << kVersion
       << ". Camera frame: +x right, +y up, +z to the viewer; relative units.\"\n"
       << "    defaultPrim = \"Light\"\n    metersPerUnit = 1\n    upAxis = \"Y\"\n)\n\n"
       << "def Xform \"Light\"\n{\n"
       << "    def DomeLight \"Environment\"\n    {\n"
       << "        asset inputs:texture:file = @" << map_file << "@\n"
       << "        token inputs:texture:format = \"latlong\"\n"
       << "        float inputs:intensity = 1\n    }\n";
  if (!light.lights.empty()) {
    const lighting::MainLight& main = light.lights.front();
    const double angle = lamp_angle_deg(main);
    const double solid_angle = 2 * kPi * (1 - std::cos(radians(angle / 2)));
    const Eigen::Matrix3d axes = lamp_axes(main.direction);
    // The matrix is of row vectors: each row says where an axis goes. Intensity is the radiance of the disc.
    text << "\n    def DistantLight \"MainLight\"\n    {\n"
         << "        float inputs:angle = " << angle << "\n"
         << "        color3f inputs:color = " << triple(main.colour) << "\n"
         << "        float inputs:intensity = " << main.irradiance / solid_angle << "\n"
         << "        matrix4d xformOp:transform = (";
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d row = axes.col(axis);
      text << " (" << row.x() << ", " << row.y() << ", " << row.z() << ", 0),";
    }
    text << " (0, 0, 0, 1) )\n        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n    }\n";
  }
  text << "}\n";
  return text.str();
}

std::string blender_script(const LightResult& light, const std::string& map_file) {
  std::ostringstream text = number_stream();
  text << "# Light of a portrait, by faceprobe " << kVersion << ".\n"
       << "# In Blender: Scripting, Open, this file, Run Script. Or: blender --python blender.py\n"
       << "# The portrait's camera looks along +y; what was at the right of the photo is at +x, up is +z.\n"
       << "import math\nimport os\n\nimport bpy\nfrom mathutils import Vector\n\n"
       << "MAP = " << '"' << map_file << '"' << "\n"
       << "STRENGTH = 1.0  # of all the light; a photo does not tell how bright it was\n";
  if (!light.lights.empty()) {
    const lighting::MainLight& main = light.lights.front();
    const Eigen::Vector3d& d = main.direction;
    // Blender's axes: right +x, away from the viewer +y, up +z.
    text << "LAMP = {\n    \"towards\": " << triple({d.x(), -d.z(), d.y()})
         << ",\n    \"colour\": " << triple(main.colour) << ",\n    \"irradiance\": " << main.irradiance
         << ",\n    \"angle_deg\": " << lamp_angle_deg(main) << ",\n}\n";
  } else {
    text << "LAMP = None\n";
  }
  text << R"PY(
try:
    folder = os.path.dirname(os.path.abspath(__file__))
except NameError:
    folder = bpy.path.abspath("//")
if bpy.context.space_data and getattr(bpy.context.space_data, "text", None):
    folder = os.path.dirname(bpy.path.abspath(bpy.context.space_data.text.filepath)) or folder

world = bpy.data.worlds.new("Portrait light")
world.use_nodes = True
nodes, links = world.node_tree.nodes, world.node_tree.links
nodes.clear()
output = nodes.new("ShaderNodeOutputWorld")
background = nodes.new("ShaderNodeBackground")
background.inputs["Strength"].default_value = STRENGTH
texture = nodes.new("ShaderNodeTexEnvironment")
texture.image = bpy.data.images.load(os.path.join(folder, MAP))
mapping = nodes.new("ShaderNodeMapping")
# The map's centre column is behind the photographer; Blender's is at +x.
mapping.inputs["Rotation"].default_value = (0.0, 0.0, math.radians(90.0))
coordinates = nodes.new("ShaderNodeTexCoord")
links.new(coordinates.outputs["Generated"], mapping.inputs["Vector"])
links.new(mapping.outputs["Vector"], texture.inputs["Vector"])
links.new(texture.outputs["Color"], background.inputs["Color"])
links.new(background.outputs["Background"], output.inputs["Surface"])
bpy.context.scene.world = world

if LAMP:
    sun = bpy.data.lights.new("Portrait lamp", "SUN")
    sun.color = [max(0.0, c) for c in LAMP["colour"]]
    sun.energy = STRENGTH * LAMP["irradiance"]
    sun.angle = math.radians(LAMP["angle_deg"])
    lamp = bpy.data.objects.new("Portrait lamp", sun)
    lamp.rotation_mode = "QUATERNION"
    lamp.rotation_quaternion = Vector(LAMP["towards"]).to_track_quat("Z", "Y")
    bpy.context.scene.collection.objects.link(lamp)
)PY";
  return text.str();
}

}  // namespace faceprobe::pipeline
