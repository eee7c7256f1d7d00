#include "render/bsdf.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/core/random.h"
#include "faceprobe/core/sphere_grid.h"
#include "render/sobol.h"

#include <gtest/gtest.h>

namespace faceprobe::render {
namespace {

Eigen::Vector3f tilted(double degrees) {
  return {static_cast<float>(std::sin(radians(degrees))), 0, static_cast<float>(std::cos(radians(degrees)))};
}

TEST(Ggx, ReturnsAllLightAndItsDensityIsOne) {
  const SphereGrid grid(128);  // 0.5 degree
  for (const float alpha : {0.05F, 0.1F, 0.3F, 0.8F}) {
    const Ggx lobe(alpha);
    for (const double angle : {0.0, 40.0, 75.0}) {
      double value = 0;
      double density = 0;
      for (int i = 0; i < grid.cell_count(); ++i) {
        value += lobe.value(tilted(angle), grid.directions().row(i).transpose());
        density += lobe.density(tilted(angle), grid.directions().row(i).transpose());
      }
      // The table's error and, at grazing, that between its entries.
      EXPECT_NEAR(value * grid.cell_solid_angle(), 1, 0.01) << alpha << ' ' << angle;
      EXPECT_NEAR(density * grid.cell_solid_angle(), 1, 0.005) << alpha << ' ' << angle;
    }
  }
}

TEST(Ggx, NarrowLobesKeepTheirDensity) {
  // At roughness .03 the lobe is .05 degrees wide: what is drawn must have the density of its own draw, value over density about 1.
  const Ggx lobe(0.0009F);
  double mean = 0;
  for (std::uint32_t s = 0; s < 1024; ++s) {
    SobolSampler random(4, s);
    const Eigen::Vector3f view = tilted(30);
    const Eigen::Vector3f light = lobe.draw(view, random.pair());
    const double weight = lobe.value(view, light) / lobe.density(view, light);
    EXPECT_NEAR(weight, 1, 0.02);
    mean += weight / 1024;
  }
  EXPECT_NEAR(mean, 1, 1e-3);
}

TEST(Ggx, OneScatteringIsReciprocal) {
  const Ggx lobe(0.4F);
  Random random({7});
  for (int i = 0; i < 200; ++i) {
    Eigen::Vector3f a = random.direction();
    Eigen::Vector3f b = random.direction();
    a.z() = std::abs(a.z()) + 0.01F;
    b.z() = std::abs(b.z()) + 0.01F;
    a.normalize();
    b.normalize();
    const float there = lobe.single(a, b) / b.z();
    const float back = lobe.single(b, a) / a.z();
    EXPECT_NEAR(there, back, 1e-4F * (there + back));
  }
}

TEST(Fresnel, ClosedForms) {
  EXPECT_NEAR(dielectric_fresnel(1, 1.5F), 0.04F, 1e-6F);  // ((n - 1) / (n + 1))^2
  EXPECT_NEAR(dielectric_fresnel(0, 1.5F), 1, 1e-6F);      // grazing
  EXPECT_EQ(dielectric_fresnel(0.5F, 1 / 1.5F), 1);        // beyond the critical angle, 41.8 degrees
  EXPECT_NEAR(dielectric_fresnel(0.3F, 1), 0, 1e-6F);      // no surface
  const float brewster = static_cast<float>(std::cos(std::atan(1.5)));
  const float across = std::pow((1.0F - 2.25F) / (1 + 2.25F), 2.0F);  // only one polarisation is left there
  EXPECT_NEAR(dielectric_fresnel(brewster, 1.5F), across / 2, 1e-5F);
}

std::vector<Material> scattering_materials() {
  return {material_preset("diffuse"), material_preset("plastic"), material_preset("silver"),
          Material{.kind = MaterialKind::kPlastic, .colour = {0.2F, 0.5F, 0.7F}, .roughness = 0.5F},
          Material{.kind = MaterialKind::kMetal, .colour = {1, 0.5F, 0.2F}, .roughness = 0.8F}};
}

// What draw() finds under a light that depends on the direction = the integral of value().
TEST(Bsdf, DrawingIntegratesWhatValueSays) {
  const SphereGrid grid(64);
  const auto light_from = [](const Eigen::Vector3f& d) { return 1 + d.x() + 0.5F * d.y(); };
  for (const Material& material : scattering_materials()) {
    const Finish finish(material);
    const Bsdf bsdf{&finish, material.colour, Eigen::Vector3f(0.1F, 0.2F, 1).normalized(), tilted(50), false};
    double sum = 0;
    for (int i = 0; i < grid.cell_count(); ++i) {
      const Eigen::Vector3f d = grid.directions().row(i).transpose();
      sum += bsdf.value(d).y() * light_from(d);
    }
    sum *= grid.cell_solid_angle();
    double drawn = 0;
    constexpr std::uint32_t kDraws = 1 << 14;
    for (std::uint32_t s = 0; s < kDraws; ++s) {
      SobolSampler random(9, s);
      const float choice = random.one();
      const Bsdf::Draw draw = bsdf.draw(choice, random.pair());
      if (draw.density > 0) drawn += draw.weight.y() * light_from(draw.light);  // picked directions are not in value()
    }
    EXPECT_NEAR(drawn / kDraws, sum, 0.01 * sum) << material.name << ' ' << material.roughness;
  }
}

TEST(Bsdf, NoMaterialGivesMoreLightThanItGets) {
  for (const std::string& name : material_preset_names()) {
    const Finish finish(material_preset(name));
    for (const double angle : {0.0, 45.0, 85.0}) {
      const Bsdf bsdf{&finish, finish.material.colour, Eigen::Vector3f::UnitZ(), tilted(angle), false};
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      constexpr std::uint32_t kDraws = 4096;
      for (std::uint32_t s = 0; s < kDraws; ++s) {
        SobolSampler random(2, s);
        const float choice = random.one();
        sum += bsdf.draw(choice, random.pair()).weight.cast<double>();
      }
      EXPECT_LE((sum / kDraws).maxCoeff(), 1.005) << name << ' ' << angle;  // noise of 4096 draws
    }
  }
}

TEST(Bsdf, HalvesAddUpToTheWhole) {
  for (const char* name : {"plastic", "glass"}) {
    const Finish finish(material_preset(name));
    Bsdf bsdf{&finish, finish.material.colour, Eigen::Vector3f::UnitZ(), tilted(70), false};
    ASSERT_TRUE(bsdf.has_halves()) << name;
    const auto drawn = [&](Bsdf::Half half) {
      bsdf.half = half;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      constexpr std::uint32_t kDraws = 4096;
      for (std::uint32_t s = 0; s < kDraws; ++s) {
        SobolSampler random(3, s);
        const float choice = random.one();
        sum += bsdf.draw(choice, random.pair()).weight.cast<double>();
      }
      return Eigen::Vector3d(sum / kDraws);
    };
    const Eigen::Vector3d halves = drawn(Bsdf::Half::kMirrored) + drawn(Bsdf::Half::kRest);
    EXPECT_LT((drawn(Bsdf::Half::kBoth) - halves).norm(), 5e-3) << name;  // noise of 4096 draws
  }
}

TEST(Bsdf, GlassRefractsBySnell) {
  const Finish finish(Material{.kind = MaterialKind::kGlass, .colour = Eigen::Vector3f::Ones(), .ior = 1.5F});
  const Eigen::Vector3f view = tilted(30);
  const Bsdf::Draw in =
      Bsdf{&finish, Eigen::Vector3f::Ones(), Eigen::Vector3f::UnitZ(), view, false}.draw(0.999F, {0, 0});
  EXPECT_NEAR(std::hypot(in.light.x(), in.light.y()), std::sin(radians(30)) / 1.5, 1e-6);
  EXPECT_LT(in.light.z(), 0);
  EXPECT_LT(in.light.x(), 0);
  // From inside and back: the way out is the way in.
  const Bsdf::Draw out =
      Bsdf{&finish, Eigen::Vector3f::Ones(), -Eigen::Vector3f::UnitZ(), in.light, true}.draw(0.999F, {0, 0});
  EXPECT_NEAR((out.light - view).norm(), 0, 1e-5);
}

}  // namespace
}  // namespace faceprobe::render
