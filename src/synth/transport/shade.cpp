#include "faceprobe/core/parallel.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/synth/matrix_product.h"
#include "faceprobe/synth/transport.h"
#include "synth/transport/small_lights.h"
#include "synth/transport/vertex_mix.h"

#include <algorithm>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

constexpr int kSamplesAtOnce = 64;  // of a product; more would not be faster
constexpr int kChunk = 1024;        // points of small lights that one piece of work takes

void check(const SceneTransport& transport, const ViewTransport& view, std::span<const LightSample> samples) {
  if (view.specular.cols() != transport.diffuse.cols())
    throw std::invalid_argument("Scene and view must have the same cells.");
  for (const LightSample& sample : samples) {
    if (sample.cells.rows() != transport.diffuse.cols()) {
      throw std::invalid_argument("A light sample must have as many cells as the transport.");
    }
  }
}

// #cells x (3 samples), row-major: column 3 s + c is channel c of sample s.
RowMatrix light_matrix(std::span<const LightSample> samples, Eigen::Index cells) {
  RowMatrix light(cells, 3 * static_cast<Eigen::Index>(samples.size()));
  for (std::size_t s = 0; s < samples.size(); ++s) {
    light.middleCols<3>(3 * static_cast<Eigen::Index>(s)) = samples[s].cells;
  }
  return light;
}

// target(s) (a matrix with three columns) of each sample = rows x light.
template <class Target>
void multiply(const PackedRows& rows, const RowMatrix& light, const std::vector<int>* place, int threads,
              const Target& target) {
  const std::vector<PackedRows::Block>& blocks = rows.blocks();
  parallel_for(static_cast<int>(blocks.size()), threads, [&](int first, int last) {
    ProductScratch scratch;
    Eigen::MatrixXf out;
    for (int b = first; b < last; ++b) {
      const PackedRows::Block& block = blocks[static_cast<std::size_t>(b)];
      multiply_block(block, light, out, scratch);
      for (Eigen::Index column = 0; column < out.cols(); ++column) {
        Eigen::MatrixX3f& to = target(static_cast<std::size_t>(column / 3));
        float* values = to.col(column % 3).data();
        for (std::size_t r = 0; r < block.row.size(); ++r) {
          const int row = place != nullptr ? (*place)[static_cast<std::size_t>(block.row[r])] : block.row[r];
          values[row] = out(static_cast<Eigen::Index>(r), column);
        }
      }
    }
  });
}

class SmallLights {
 public:
  SmallLights(const Scene& scene, const SceneTransport& transport, const ViewTransport& view,
              const ShadeOptions& options)
      : scene_(scene), transport_(transport), grid_(transport.nside), vertices_(vertex_points(scene, transport)),
        surfaces_(fragment_points(scene, transport, view)),
        hairs_(hair_points(scene, view.fragments, view.surface, view.camera_position)), options_(options) {}

  void add(std::span<const LightSample> samples, std::span<FragmentLight> out) {
    lit_.clear();
    sky_.clear();
    for (const LightSample& sample : samples) {
      lit_.emplace_back(sample.distant.size(), std::vector<std::uint8_t>(static_cast<std::size_t>(vertices_.count())));
      sky_.emplace_back();
      for (const DistantLight& light : sample.distant) sky_.back().emplace_back(transport_, grid_, light.direction);
    }
    const auto count = static_cast<int>(samples.size());
    for_pieces(count, chunks(vertices_.count()),
               [&](std::size_t s, int chunk) { light_vertices(samples[s], s, chunk, out[s]); });
    for_pieces(count, chunks(surfaces_.count()),
               [&](std::size_t s, int chunk) { light_surfaces(samples[s], s, chunk, out[s]); });
    if (hairs_.count() > 0) for_pieces(count, 1, [&](std::size_t s, int) { light_hairs(samples[s], out[s]); });
  }

 private:
  static int chunks(int count) { return (count + kChunk - 1) / kChunk; }

  template <class Work>
  void for_pieces(int samples, int per_sample, const Work& work) const {
    parallel_for(samples * per_sample, options_.threads, [&](int first, int last) {
      for (int piece = first; piece < last; ++piece)
        work(static_cast<std::size_t>(piece / per_sample), piece % per_sample);
    });
  }

  void light_vertices(const LightSample& sample, std::size_t s, int chunk, FragmentLight& out) {
    const int first = chunk * kChunk;
    const int count = std::min(kChunk, vertices_.count() - first);
    for (std::size_t k = 0; k < sample.distant.size(); ++k) {
      add_distant(scene_, vertices_, first, count, sample.distant[k], sky_[s][k], out.vertex_shading, lit_[s][k].data());
    }
    for (const NearLight& light : sample.near) add_near(scene_, vertices_, first, count, light, out.vertex_shading);
  }

  void light_surfaces(const LightSample& sample, std::size_t s, int chunk, FragmentLight& out) const {
    const int first = chunk * kChunk;
    const int count = std::min(kChunk, surfaces_.count() - first);
    for (std::size_t k = 0; k < sample.distant.size(); ++k) {
      add_distant(scene_, surfaces_, first, count, sample.distant[k], lit_[s][k].data(), out.shading, out.specular);
    }
    for (const NearLight& light : sample.near) {
      add_near(scene_, surfaces_, first, count, light, options_.near_light_samples, out.shading, out.specular);
    }
  }

  void light_hairs(const LightSample& sample, FragmentLight& out) const {
    for (const DistantLight& light : sample.distant) add_distant(scene_, hairs_, light, out.shading, out.specular);
    for (const NearLight& light : sample.near) {
      add_near(scene_, hairs_, light, options_.near_light_samples, out.shading, out.specular);
    }
  }

  const Scene& scene_;
  const SceneTransport& transport_;
  SphereGrid grid_;
  SurfacePoints vertices_;
  SurfacePoints surfaces_;
  HairPoints hairs_;
  ShadeOptions options_;
  std::vector<std::vector<std::vector<std::uint8_t>>> lit_;  // sample, distant light, row
  std::vector<std::vector<KnownSky>> sky_;                   // sample, distant light
};

}  // namespace

std::string ShadeOptions::validate() const {
  if (near_light_samples < 1)
    return "near_light_samples must be 1 or more, found " + std::to_string(near_light_samples) + ".";
  return {};
}

std::vector<FragmentLight> shade(const Scene& scene, const SceneTransport& transport, const ViewTransport& view,
                                 std::span<const LightSample> samples, const ShadeOptions& options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  check(transport, view, samples);

  const Eigen::Index fragments = view.fragments.count();
  std::vector<FragmentLight> out(samples.size());
  parallel_for(static_cast<int>(samples.size()), options.threads, [&](int first, int last) {
    for (int s = first; s < last; ++s) {
      FragmentLight& light = out[static_cast<std::size_t>(s)];
      light.shading.resize(fragments, 3);
      light.specular.resize(fragments, 3);
      light.vertex_shading.resize(transport.diffuse.rows(), 3);
    }
  });
  for (std::size_t first = 0; first < samples.size(); first += kSamplesAtOnce) {
    const std::size_t count = std::min<std::size_t>(kSamplesAtOnce, samples.size() - first);
    const RowMatrix light = light_matrix(samples.subspan(first, count), transport.diffuse.cols());
    const auto of = [&](std::size_t s) -> FragmentLight& { return out[first + s]; };
    multiply(transport.diffuse, light, nullptr, options.threads,
             [&](std::size_t s) -> Eigen::MatrixX3f& { return of(s).vertex_shading; });
    multiply(view.specular, light, nullptr, options.threads,
             [&](std::size_t s) -> Eigen::MatrixX3f& { return of(s).specular; });
    multiply(view.hair_diffuse, light, &view.hair, options.threads,
             [&](std::size_t s) -> Eigen::MatrixX3f& { return of(s).shading; });
  }
  const std::vector<int> rows = mix_rows(transport, view.fragments);
  parallel_for(static_cast<int>(samples.size()), options.threads, [&](int first, int last) {
    for (int s = first; s < last; ++s) {
      FragmentLight& light = out[static_cast<std::size_t>(s)];
      mix(view.fragments, rows, light.vertex_shading, light.shading);
    }
  });
  const bool any_small =
      std::ranges::any_of(samples, [](const LightSample& s) { return !s.distant.empty() || !s.near.empty(); });
  if (any_small) SmallLights(scene, transport, view, options).add(samples, out);
  return out;
}

}  // namespace faceprobe::synth
