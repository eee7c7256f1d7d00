#include "net/convolution.h"

#include <oneapi/dnnl/dnnl.hpp>

#include <stdexcept>
#include <unordered_map>
#include <vector>

#if DNNL_CPU_THREADING_RUNTIME != DNNL_RUNTIME_OMP
#error "oneDNN must be built with OpenMP, which is how its number of threads is set"
#endif

namespace faceprobe::net {
namespace {

using dnnl::memory;
using Forward = dnnl::convolution_forward;

memory::desc described(const memory::dims& dims, memory::format_tag tag) {
  return memory::desc(dims, memory::data_type::f32, tag);
}

// oneDNN takes no pointer to const, but reads what it is given as source or weights.
memory wrapped(const memory::desc& what, const dnnl::engine& engine, const float* values) {
  return memory(what, engine, const_cast<float*>(values));
}

}  // namespace

struct Convolution::State {
  ConvolutionShape shape;
  std::vector<float> weight, bias;
  dnnl::engine engine{dnnl::engine::kind::cpu, 0};

  memory::dims weight_dims() const { return {shape.out, shape.in, shape.kernel, shape.kernel}; }

  Forward::primitive_desc plan(const memory::dims& in, const memory::dims& out) const {
    const memory::desc from = described(in, memory::format_tag::nhwc);
    const memory::desc to = described(out, memory::format_tag::nhwc);
    const memory::desc by = described(weight_dims(), memory::format_tag::any);
    const memory::desc plus = shape.bias ? described({shape.out}, memory::format_tag::x) : memory::desc();
    const memory::dims stride = {shape.stride, shape.stride};
    const memory::dims pad = {shape.kernel / 2, shape.kernel / 2};
    constexpr auto kKind = dnnl::prop_kind::forward_inference;
    constexpr auto kAlgorithm = dnnl::algorithm::convolution_direct;
#if DNNL_VERSION_MAJOR >= 3
    return {engine, kKind, kAlgorithm, from, by, plus, to, stride, pad, pad};
#else
    return {{kKind, kAlgorithm, from, by, plus, to, stride, pad, pad}, engine};
#endif
  }
};

Convolution::Convolution(WeightList& weights, const std::string& name, const ConvolutionShape& shape)
    : state_(std::make_unique<State>()) {
  state_->shape = shape;
  state_->weight = weights.take(name + ".weight", {shape.out, shape.in, shape.kernel, shape.kernel});
  if (shape.bias) state_->bias = weights.take(name + ".bias", {shape.out});
}

Convolution::Convolution(Convolution&&) noexcept = default;
Convolution& Convolution::operator=(Convolution&&) noexcept = default;
Convolution::~Convolution() = default;

Image Convolution::operator()(const Image& features) const {
  const State& s = *state_;
  if (features.channels() != s.shape.in || features.empty()) {
    throw std::invalid_argument("A convolution of " + std::to_string(s.shape.in) + " channels was given " +
                                std::to_string(features.channels()));
  }
  const int stride = s.shape.stride;
  Image result((features.width() + stride - 1) / stride, (features.height() + stride - 1) / stride, s.shape.out);
  const Forward::primitive_desc plan =
      s.plan({1, s.shape.in, features.height(), features.width()}, {1, s.shape.out, result.height(), result.width()});
  dnnl::stream stream(s.engine);
  // The plan says how it wants the weights; putting them in order costs little beside the convolution.
  memory stored = wrapped(described(s.weight_dims(), memory::format_tag::oihw), s.engine, s.weight.data());
  memory ordered = stored;
  if (plan.weights_desc() != stored.get_desc()) {
    ordered = memory(plan.weights_desc(), s.engine);
    dnnl::reorder(stored, ordered).execute(stream, stored, ordered);
  }
  std::unordered_map<int, memory> arguments = {{DNNL_ARG_SRC, wrapped(plan.src_desc(), s.engine, features.data())},
                                               {DNNL_ARG_WEIGHTS, ordered},
                                               {DNNL_ARG_DST, wrapped(plan.dst_desc(), s.engine, result.data())}};
  if (s.shape.bias) arguments[DNNL_ARG_BIAS] = wrapped(plan.bias_desc(), s.engine, s.bias.data());
  Forward(plan).execute(stream, arguments);
  stream.wait();
  return result;
}

}  // namespace faceprobe::net
