// bench_synth_speed: what light costs. A head of some 11,000 vertices, its transport, and its pictures under many maps; the rate of the
// matrix product and its share of what the same library reaches on large square matrices. Prints Markdown; needs no data.

#include "faceprobe/core/angles.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/random.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/core/vertex_normals.h"
#include "faceprobe/synth/matrix_product.h"
#include "faceprobe/synth/transport.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <utility>
#include <vector>

namespace {

using namespace faceprobe;
using namespace faceprobe::synth;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

template <class Work>
double seconds(const Work& work) {
  const double start = now();
  work();
  return now() - start;
}

float bump(const Eigen::Vector3f& d, const Eigen::Vector3f& at, float width, float height) {
  return height * std::exp(-(d - at.normalized()).squaredNorm() / (2 * width * width));
}

// A ball with a nose, eye sockets, a chin and a neck: enough for shadows and bounces to cost what they cost on a head.
SurfaceMesh make_head() {
  constexpr int kRings = 75;
  constexpr int kAround = 150;
  SurfaceMesh mesh;
  mesh.vertices.resize(kRings * kAround, 3);
  for (int i = 0; i < kRings; ++i) {
    for (int k = 0; k < kAround; ++k) {
      const float theta = static_cast<float>(kPi) * (static_cast<float>(i) + 0.5F) / kRings;
      const float phi = 6.2831853F * static_cast<float>(k) / kAround;
      const Eigen::Vector3f d(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
      float radius = 0.095F + bump(d, {0, -0.1F, 1}, 0.10F, 0.028F) + bump(d, {0, -0.75F, 0.8F}, 0.2F, 0.012F);
      radius -= bump(d, {0.35F, 0.2F, 0.95F}, 0.13F, 0.010F) + bump(d, {-0.35F, 0.2F, 0.95F}, 0.13F, 0.010F);
      radius += bump(d, {0, -1, -0.2F}, 0.3F, 0.10F);
      mesh.vertices.row(i * kAround + k) = (radius * Eigen::Vector3f(0.85F * d.x(), 1.2F * d.y(), d.z())).transpose();
    }
  }
  mesh.triangles.resize(2 * (kRings - 1) * kAround, 3);
  for (int i = 0, t = 0; i + 1 < kRings; ++i) {
    for (int k = 0; k < kAround; ++k) {
      const int a = i * kAround + k;
      const int b = i * kAround + (k + 1) % kAround;
      mesh.triangles.row(t++) << a, a + kAround, b;
      mesh.triangles.row(t++) << b, a + kAround, b + kAround;
    }
  }
  mesh.normals = vertex_normals(mesh.vertices, mesh.triangles);
  mesh.vertex_region.assign(static_cast<std::size_t>(mesh.vertices.rows()), Region::kCheeks);
  return mesh;
}

PinholeCamera make_camera(int size) {
  PinholeCamera camera;
  camera.width_px = camera.height_px = size;
  camera.focal_px = 2.7F * static_cast<float>(size);
  camera.centre_px.setConstant(0.5F * static_cast<float>(size));
  camera.camera_from_scene.translation().z() = -0.8F;
  return camera;
}

std::vector<LightSample> make_light(int count, int cells, int small_lights) {
  std::vector<LightSample> samples(static_cast<std::size_t>(count));
  for (std::size_t s = 0; s < samples.size(); ++s) {
    Random random({17, s});
    samples[s].cells.resize(cells, 3);
    for (Eigen::Index i = 0; i < samples[s].cells.size(); ++i)
      samples[s].cells(i) = static_cast<float>(random.uniform());
    for (int k = 0; k < small_lights; ++k) samples[s].distant.push_back({random.direction(), Eigen::Vector3f::Ones()});
  }
  return samples;
}

// GFLOP/s of the machine, as this library's product reaches it where nothing is in its way: one large block per thread.
double measure_peak(int threads, ProductKernel kernel) {
  constexpr int kSize = 1536;
  const int workers = threads > 0 ? threads : default_thread_count();
  PackedRows::Block block{std::vector<int>(kSize), std::vector<int>(kSize), RowMatrix::Random(kSize, kSize)};
  std::iota(block.row.begin(), block.row.end(), 0);
  block.column = block.row;
  const RowMatrix light = RowMatrix::Random(kSize, kSize);
  double best = 1e9;
  for (int repeat = 0; repeat < 5; ++repeat) {
    best = std::min(best, seconds([&] {
                      parallel_for(workers, workers, [&](int, int) {
                        Eigen::MatrixXf out;
                        ProductScratch scratch;
                        multiply_block(block, light, out, scratch, kernel);
                      });
                    }));
  }
  return 2e-9 * workers * kSize * static_cast<double>(kSize) * kSize / best;
}

struct View {
  int size = 0;
  double fragments_s = 0, scene_s = 0, view_s = 0;
  SceneTransport scene_transport;
  ViewTransport view;

  double transport_s() const { return fragments_s + scene_s + view_s; }
  double flop_per_sample() const {
    return 6.0 * static_cast<double>(scene_transport.diffuse.stored() + view.specular.stored());
  }
};

View make_view(const Scene& scene, int size, int threads) {
  const PinholeCamera camera = make_camera(size);
  View out;
  out.size = size;
  Fragments fragments;
  out.fragments_s =
      seconds([&] { fragments = find_fragments(scene, camera, {.samples_per_side = 3, .threads = threads}); });
  const TransportOptions options{.threads = threads};
  out.scene_s = seconds([&] {
    out.scene_transport = build_scene_transport(scene, vertices_seen(std::vector{&std::as_const(fragments)}), options);
  });
  FragmentSurface surface{fragments.normal, Eigen::VectorXf::Constant(fragments.count(), 0.3F),
                          Eigen::VectorXf::Constant(fragments.count(), 0.028F)};
  out.view_s = seconds([&] {
    out.view = build_view_transport(scene, out.scene_transport, std::move(fragments), std::move(surface),
                                    camera.camera_from_scene.inverse().translation(), options);
  });
  return out;
}

void report(const Scene& scene, const View& view, int threads, double peak) {
  const auto cells = static_cast<int>(view.scene_transport.diffuse.cols());
  const double dense = 6.0 * static_cast<double>(cells) *
                       static_cast<double>(view.scene_transport.diffuse.rows() + view.view.specular.rows());
  std::printf("\n### %d px\n\n%d fragments, %d vertex rows, %d cells\n\n", view.size, view.view.fragments.count(),
              static_cast<int>(view.scene_transport.diffuse.rows()), cells);
  std::printf(
      "| part | seconds |\n|---|---|\n| fragments | %.3f |\n| diffuse rows and bounce | %.3f |\n| specular rows | %.3f "
      "|\n"
      "| transport, together | %.3f |\n\n",
      view.fragments_s, view.scene_s, view.view_s, view.transport_s());
  std::printf("Matrices: %.0f MB, %.0f %% of the full ones.\n\n",
              static_cast<double>(view.scene_transport.diffuse.stored() + view.view.specular.stored()) * 4e-6,
              100 * view.flop_per_sample() / dense);
  std::printf(
      "| maps at once | light, ms per map | with 4 small lights | product, GFLOP/s | share of peak | transport and "
      "light, ms per image |\n"
      "|---|---|---|---|---|---|\n");
  for (const int maps : {1, 8, 64, 512}) {
    const ShadeOptions options{.threads = threads};
    const std::vector<LightSample> plain = make_light(maps, cells, 0);
    const std::vector<LightSample> sunny = make_light(maps, cells, 4);
    const auto time = [&](const std::vector<LightSample>& samples) {
      double best = 1e9;
      for (int repeat = 0; repeat < 3; ++repeat) {
        best = std::min(best, seconds([&] {
                          // As a caller would: no more results at a time than fit into memory.
                          for (std::size_t first = 0; first < samples.size(); first += 64) {
                            shade(scene, view.scene_transport, view.view,
                                  std::span(samples).subspan(first, std::min<std::size_t>(64, samples.size() - first)),
                                  options);
                          }
                        }));
      }
      return best;
    };
    const double light = time(plain);
    const double with_lamps = time(sunny);
    const double rate = 1e-9 * maps * view.flop_per_sample() / light;
    std::printf("| %d | %.2f | %.2f | %.0f | %.0f %% | %.2f |\n", maps, 1e3 * light / maps, 1e3 * with_lamps / maps,
                rate, 100 * rate / peak, 1e3 * (view.transport_s() + with_lamps) / maps);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("What the light of synthetic faces costs");
  int threads = 0;
  std::vector<int> sizes{128, 256};
  app.add_option("--threads", threads, "0 = all");
  app.add_option("--size", sizes, "pixels; several may be given");
  CLI11_PARSE(app, argc, argv);

  Figure figure;
  figure.meshes.push_back(make_head());
  const auto vertices = static_cast<int>(figure.meshes[0].vertices.rows());
  const Scene scene({figure});
  const double peak = measure_peak(threads, ProductKernel::kBest);
  const double library = measure_peak(threads, ProductKernel::kLibrary);
  std::printf("Head of %d vertices, %d threads. Large square products: %.0f GFLOP/s (%s), %.0f (%s).\n", vertices,
              threads > 0 ? threads : default_thread_count(), peak, product_kernel().c_str(), library,
              product_kernel(ProductKernel::kLibrary).c_str());
  for (const int size : sizes) report(scene, make_view(scene, size, threads), threads, peak);
  return 0;
}
