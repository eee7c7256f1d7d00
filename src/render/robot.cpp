#include "faceprobe/render/shapes.h"

#include "loft.h"
#include "rounded_box.h"

#include "faceprobe/core/angles.h"

#include <utility>

namespace faceprobe::render {
namespace {

using Place3 = Eigen::Vector3f;

enum Paint { kRed, kSilver, kDark, kMirror, kWhite };  // places in the list of materials

std::vector<Material> paints() {
  Material dark = material_preset("diffuse");
  dark.name = "dark";
  dark.colour.setConstant(0.04F);
  return {material_preset("red"), material_preset("silver"), std::move(dark), material_preset("mirror"),
          material_preset("plastic")};
}

class Builder {
 public:
  Builder() { model_.materials = paints(); }

  void add(Paint paint, TriangleMesh mesh, const Eigen::Affine3f& robot_from_part) {
    mesh.material = paint;
    Model part;
    part.meshes.push_back(std::move(mesh));
    transform(part, robot_from_part);
    model_.meshes.push_back(std::move(part.meshes[0]));
  }
  void box(Paint paint, const Place3& centre, const Place3& size, float radius) {
    add(paint, rounded_box(size, radius), Eigen::Affine3f(Eigen::Translation3f(centre)));
  }
  void sphere(Paint paint, const Place3& centre, float radius) {
    add(paint, ball(radius, 20), Eigen::Affine3f(Eigen::Translation3f(centre)));
  }
  // A curve that lies in a plane z = constant.
  void wire(Paint paint, const Bezier<3>& curve, float radius, int steps = 24) {
    add(paint, tube(curve, radius, Place3::UnitZ(), steps, 24), Eigen::Affine3f::Identity());
  }
  void rod(Paint paint, const Place3& start, const Place3& end, float radius) {
    const Place3 third = (end - start) / 3;
    wire(paint, {start, start + third, end - third, end}, radius, 1);
  }
  // A coin with round edges; `axis` points out of its face.
  void disc(Paint paint, const Place3& centre, const Place3& axis, float radius, float thickness) {
    const float bend = thickness / 2;
    Profile outline({0, -bend});
    outline.line({radius - bend, -bend}).bend({radius, -bend}, {radius, 0}).bend({radius, bend}, {radius - bend, bend});
    outline.line({0, bend});
    add(paint, lathe(outline.points(), 48),
        Eigen::Translation3f(centre) * Eigen::Quaternionf::FromTwoVectors(Place3::UnitY(), axis));
  }
  Model take() { return std::move(model_); }

 private:
  Model model_;
};

void add_legs(Builder& robot) {
  for (const float side : {-1.0F, 1.0F}) {
    robot.box(kDark, {0.125F * side, 0.04F, 0.025F}, {0.18F, 0.08F, 0.26F}, 0.032F);
    robot.rod(kSilver, {0.12F * side, 0.07F, 0}, {0.12F * side, 0.28F, 0}, 0.036F);
    robot.disc(kDark, {0.12F * side, 0.165F, 0}, Place3::UnitY(), 0.052F, 0.035F);
  }
}

void add_body(Builder& robot) {
  robot.box(kRed, {0, 0.41F, 0}, {0.42F, 0.34F, 0.30F}, 0.065F);
  robot.box(kSilver, {0, 0.43F, 0.15F}, {0.25F, 0.18F, 0.03F}, 0.0135F);
  robot.disc(kMirror, {-0.06F, 0.445F, 0.168F}, Place3::UnitZ(), 0.045F, 0.024F);
  const Paint buttons[3] = {kRed, kWhite, kDark};
  for (int i = 0; i < 3; ++i) {
    robot.sphere(buttons[i], {0.055F, 0.485F - 0.047F * static_cast<float>(i), 0.165F}, 0.016F);
  }
  robot.rod(kSilver, {0, 0.56F, 0}, {0, 0.64F, 0}, 0.06F);
  robot.disc(kDark, {0, 0.597F, 0}, Place3::UnitY(), 0.085F, 0.028F);
}

void add_head(Builder& robot) {
  robot.box(kRed, {0, 0.755F, 0}, {0.44F, 0.28F, 0.32F}, 0.09F);
  robot.box(kDark, {0, 0.755F, 0.152F}, {0.32F, 0.19F, 0.04F}, 0.018F);
  for (const float side : {-1.0F, 1.0F}) {
    robot.sphere(kWhite, {0.08F * side, 0.782F, 0.165F}, 0.056F);
    robot.sphere(kDark, {0.076F * side, 0.782F, 0.2F}, 0.03F);
    robot.disc(kSilver, {0.225F * side, 0.755F, 0}, side * Place3::UnitX(), 0.07F, 0.05F);
    robot.sphere(kRed, {0.245F * side, 0.755F, 0}, 0.032F);
  }
  robot.wire(kSilver,
             {{-0.07F, 0.705F, 0.174F}, {-0.03F, 0.68F, 0.174F}, {0.03F, 0.68F, 0.174F}, {0.07F, 0.705F, 0.174F}},
             0.009F);
  robot.disc(kSilver, {0, 0.895F, 0}, Place3::UnitY(), 0.05F, 0.024F);
  robot.rod(kSilver, {0, 0.89F, 0}, {0, 0.95F, 0}, 0.011F);
  robot.sphere(kMirror, {0, 0.96F, 0}, 0.04F);
}

// Two fingers about a wrist; `turn_deg` about z, 0 = pointing up.
void add_hand(Builder& robot, const Place3& wrist, double turn_deg) {
  const Eigen::Affine3f robot_from_hand =
      Eigen::Translation3f(wrist) * Eigen::AngleAxisf(static_cast<float>(radians(turn_deg)), Place3::UnitZ());
  const Bezier<3> claw{{-0.03F, 0.1F, 0}, {-0.1F, -0.01F, 0}, {0.1F, -0.01F, 0}, {0.03F, 0.1F, 0}};
  robot.add(kRed, tube(claw, 0.021F, Place3::UnitZ(), 32, 24), robot_from_hand);
  robot.sphere(kDark, wrist, 0.04F);
}

// One hangs, one waves.
void add_arms(Builder& robot) {
  robot.sphere(kDark, {-0.215F, 0.5F, 0}, 0.062F);
  robot.wire(kSilver, {{-0.22F, 0.5F, 0}, {-0.33F, 0.5F, 0}, {-0.35F, 0.43F, 0}, {-0.34F, 0.31F, 0}}, 0.032F);
  add_hand(robot, {-0.34F, 0.29F, 0}, 176);
  robot.sphere(kDark, {0.215F, 0.5F, 0}, 0.062F);
  robot.wire(kSilver, {{0.22F, 0.5F, 0}, {0.33F, 0.46F, 0}, {0.39F, 0.5F, 0}, {0.40F, 0.63F, 0}}, 0.032F);
  add_hand(robot, {0.402F, 0.65F, 0}, -8);
}

}  // namespace

Model robot() {
  Builder robot;
  add_legs(robot);
  add_body(robot);
  add_head(robot);
  add_arms(robot);
  return robot.take();
}

}  // namespace faceprobe::render
