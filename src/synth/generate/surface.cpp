#include "faceprobe/core/microfacet.h"
#include "faceprobe/synth/compose.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

const SurfaceMesh& mesh_of(const Person& person, const Fragments& fragments, int i) {
  const auto f = static_cast<std::size_t>(fragments.figure[static_cast<std::size_t>(i)] - person.first_figure);
  return person.figures[f].meshes[fragments.part[static_cast<std::size_t>(i)]];
}

const Strands& strands_of(const Person& person, const Fragments& fragments, int i) {
  const auto f = static_cast<std::size_t>(fragments.figure[static_cast<std::size_t>(i)] - person.first_figure);
  return person.figures[f].strands[fragments.part[static_cast<std::size_t>(i)]];
}

Material material_of(const Fragments& fragments, int i) { return fragments.material[static_cast<std::size_t>(i)]; }

const Reflectance& reflectance_of(const Person& person, const Fragments& fragments, int i) {
  return material_of(fragments, i) == Material::kHair ? strands_of(person, fragments, i).reflectance
                                                      : mesh_of(person, fragments, i).reflectance;
}

constexpr float kIrisRadius = 0.0059F;  // metres, adults
constexpr float kPupilShare = 0.36F;    // of the iris
constexpr float kLimbusShare = 0.86F;   // where the dark ring around the iris begins
const Eigen::Vector3f kSclera(0.62F, 0.53F, 0.48F);

Eigen::Vector3f eye_albedo(const std::vector<Eyeball>& eyes, const Eigen::Vector3f& position) {
  const Eyeball* nearest = nullptr;
  for (const Eyeball& eye : eyes) {
    if (nearest == nullptr || (position - eye.centre).norm() < (position - nearest->centre).norm()) nearest = &eye;
  }
  if (nearest == nullptr) return kSclera;
  const Eigen::Vector3f from_centre = position - nearest->centre;
  const float along = from_centre.dot(nearest->gaze);
  if (along <= 0) return kSclera;
  const float r = (from_centre - along * nearest->gaze).norm() / kIrisRadius;  // 1 at the iris' rim
  if (r > 1.08F) return kSclera;
  if (r < kPupilShare) return Eigen::Vector3f::Constant(0.004F);
  const float limbus = std::clamp((r - kLimbusShare) / (1.0F - kLimbusShare), 0.0F, 1.0F);
  const Eigen::Vector3f iris = nearest->iris_colour * (1.0F - 0.6F * limbus) * (0.8F + 0.4F * (1.0F - r));
  const float white = std::clamp((r - 0.98F) / 0.10F, 0.0F, 1.0F);
  return (1.0F - white) * iris + white * kSclera;
}

Eigen::Vector3f mesh_albedo(const SurfaceMesh& mesh, const Fragments& fragments, int i, int offset) {
  if (mesh.vertex_albedo.rows() == 0) return mesh.reflectance.albedo;
  Eigen::Vector3f albedo = Eigen::Vector3f::Zero();
  for (int corner = 0; corner < 3; ++corner) {
    albedo += fragments.weights(i, corner) * mesh.vertex_albedo.row(fragments.vertex(i, corner) - offset).transpose();
  }
  return albedo;
}

std::vector<int> fragments_of(const Person& person, const Fragments& fragments) {
  std::vector<int> own;
  for (int i = 0; i < fragments.count(); ++i) {
    if (person.owns_figure(fragments.figure[static_cast<std::size_t>(i)])) own.push_back(i);
  }
  return own;
}

std::vector<int> skin_among(const std::vector<int>& rows, const Fragments& fragments) {
  std::vector<int> skin;
  for (const int i : rows) {
    if (material_of(fragments, i) == Material::kSkin) skin.push_back(i);
  }
  return skin;
}

Eigen::MatrixX3f in_head_frame(const Person& person, const Eigen::MatrixX3f& points) {
  const Eigen::Isometry3f head_from_scene = person.scene_from_head.inverse();
  return (points * head_from_scene.linear().transpose()).rowwise() + head_from_scene.translation().transpose();
}

int skin_row(Region region) {
  const int row = static_cast<int>(region) - 1;
  return row >= 0 && row < kSkinRegionCount ? row : kSkinRegionCount - 1;
}

}  // namespace

FragmentSurface plain_lobes(const Fragments& fragments) {
  return {fragments.normal, Eigen::VectorXf::Constant(fragments.count(), 0.3F),
          Eigen::VectorXf::Constant(fragments.count(), kSkinF0)};
}

void add_person_lobes(const Person& person, const Fragments& fragments, const PinholeCamera& camera,
                      FragmentSurface& surface) {
  const SkinSettings& skin = person.skins.front();
  const std::vector<int> own = fragments_of(person, fragments);
  for (const int i : own) {
    if (material_of(fragments, i) == Material::kSkin) {
      surface.roughness(i) =
          skin.roughness[static_cast<std::size_t>(skin_row(fragments.region[static_cast<std::size_t>(i)]))];
      surface.f0(i) = kSkinF0;
    } else {
      const Reflectance& reflectance = reflectance_of(person, fragments, i);
      surface.roughness(i) = reflectance.roughness;
      surface.f0(i) = reflectance.f0;
    }
  }
  if (skin.pore_slope <= 0) return;
  const std::vector<int> rows = skin_among(own, fragments);
  const Eigen::MatrixX3f position = in_head_frame(person, fragments.position(rows, Eigen::all));
  // Apart from the product, which would copy the list of rows for every element.
  const Eigen::MatrixX3f normal_scene = fragments.normal(rows, Eigen::all);
  const Eigen::MatrixX3f normal = normal_scene * person.scene_from_head.linear();
  const Eigen::VectorXf footprint_m = fragments.depth_m(rows) / camera.focal_px;
  const PoreNormals pores = pore_normals(skin, position, normal, footprint_m);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const int i = rows[k];
    const auto row = static_cast<Eigen::Index>(k);
    surface.normal.row(i) = pores.normal.row(row) * person.scene_from_head.linear().transpose();
    // m^2 is twice the slope variance per axis (Beckmann).
    const float m = surface.roughness(i);
    surface.roughness(i) = std::sqrt(m * m + 2.0F * pores.added_slope_variance(row));
  }
}

ViewSurface empty_surface(const SceneTransport& transport, const Fragments& fragments) {
  return {Eigen::MatrixX3f::Zero(fragments.count(), 3), Eigen::VectorXf::Zero(fragments.count()),
          Eigen::MatrixX3f::Constant(transport.diffuse.rows(), 3, 0.3F)};
}

void add_person_surface(const Assets& assets, const Person& person, const SkinSettings& skin, const Scene& scene,
                        const SceneTransport& transport, const Fragments& fragments, ViewSurface& surface) {
  const HeadModel& model = assets.heads[static_cast<std::size_t>(person.head_model)];
  const std::vector<int> own = fragments_of(person, fragments);
  const Eigen::Isometry3f head_from_scene = person.scene_from_head.inverse();
  for (const int i : own) {
    const Material material = material_of(fragments, i);
    if (material == Material::kSkin) {
      surface.specular_albedo(i) =
          skin.specular_albedo[static_cast<std::size_t>(skin_row(fragments.region[static_cast<std::size_t>(i)]))];
      continue;
    }
    surface.specular_albedo(i) = reflectance_of(person, fragments, i).specular_albedo;
    if (material == Material::kHair) {
      surface.albedo.row(i) =
          strands_of(person, fragments, i).reflectance.albedo.transpose() * fragments.tone[static_cast<std::size_t>(i)];
    } else if (material == Material::kEye) {
      surface.albedo.row(i) =
          eye_albedo(person.eyes, head_from_scene * Eigen::Vector3f(fragments.position.row(i).transpose())).transpose();
    } else {
      const int f = fragments.figure[static_cast<std::size_t>(i)];
      const int offset = scene.vertex_offset(f, fragments.part[static_cast<std::size_t>(i)]);
      surface.albedo.row(i) = mesh_albedo(mesh_of(person, fragments, i), fragments, i, offset).transpose();
    }
  }

  const std::vector<int> rows = skin_among(own, fragments);
  SkinPoints points;
  points.uv = fragments.uv(rows, Eigen::all);
  points.rest_position = in_head_frame(person, fragments.position(rows, Eigen::all));
  for (const int i : rows) points.region.push_back(fragments.region[static_cast<std::size_t>(i)]);
  const SkinTexture* texture = skin.texture >= 0 ? &assets.skins[static_cast<std::size_t>(skin.texture)] : nullptr;
  if (texture == nullptr && model.uv_layout == UvLayout::kOwn && person.own_texture.has_value())
    texture = &*person.own_texture;
  const Eigen::MatrixX3f albedo = skin_albedo(texture, skin, points);
  for (std::size_t k = 0; k < rows.size(); ++k) surface.albedo.row(rows[k]) = albedo.row(static_cast<Eigen::Index>(k));

  // The bounce is soft: a mean albedo per mesh is enough for it.
  for (std::size_t f = 0; f < person.figures.size(); ++f) {
    for (std::size_t m = 0; m < person.figures[f].meshes.size(); ++m) {
      const SurfaceMesh& mesh = person.figures[f].meshes[m];
      const Eigen::RowVector3f mean = mesh.material == Material::kSkin ? skin.target_tone.transpose()
                                      : mesh.vertex_albedo.rows() > 0
                                          ? Eigen::RowVector3f(mesh.vertex_albedo.colwise().mean())
                                          : mesh.reflectance.albedo.transpose();
      const int offset = scene.vertex_offset(person.first_figure + static_cast<int>(f), static_cast<int>(m));
      for (int v = 0; v < mesh.vertices.rows(); ++v) {
        const int row = transport.row_of_vertex[static_cast<std::size_t>(offset + v)];
        if (row >= 0) surface.row_albedo.row(row) = mean;
      }
    }
  }
}

}  // namespace faceprobe::synth
