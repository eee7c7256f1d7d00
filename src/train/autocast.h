#pragma once
// Internal: a network's products in bfloat16 on a card, its weights, sums of gradients and losses in float.
//
//   { const Bf16Products bf16; raw = net->forward(input); }      // then raw.to(torch::kFloat)

#include <ATen/autocast_mode.h>
#include <torch/torch.h>
#include <torch/version.h>

namespace faceprobe::train {

// While it lives, in this thread. Has no effect on the processor.
class Bf16Products {
 public:
  Bf16Products() : enabled_(enabled()), type_(type()) {
    at::autocast::increment_nesting();
    set(true, at::kBFloat16);
  }
  ~Bf16Products() {
    // Weights in bfloat16 are kept from one product to the next, and after the optimiser's step they are others.
    if (at::autocast::decrement_nesting() == 0) at::autocast::clear_cache();
    set(enabled_, type_);
  }
  Bf16Products(const Bf16Products&) = delete;
  Bf16Products& operator=(const Bf16Products&) = delete;

 private:
// libtorch 2.4 gave the calls a device.
#if TORCH_VERSION_MAJOR > 2 || (TORCH_VERSION_MAJOR == 2 && TORCH_VERSION_MINOR >= 4)
  static bool enabled() { return at::autocast::is_autocast_enabled(at::kCUDA); }
  static at::ScalarType type() { return at::autocast::get_autocast_dtype(at::kCUDA); }
  static void set(bool on, at::ScalarType type) {
    at::autocast::set_autocast_enabled(at::kCUDA, on);
    at::autocast::set_autocast_dtype(at::kCUDA, type);
  }
#else
  static bool enabled() { return at::autocast::is_enabled(); }
  static at::ScalarType type() { return at::autocast::get_autocast_gpu_dtype(); }
  static void set(bool on, at::ScalarType type) {
    at::autocast::set_enabled(on);
    at::autocast::set_autocast_gpu_dtype(type);
  }
#endif

  bool enabled_;
  at::ScalarType type_;
};

}  // namespace faceprobe::train
