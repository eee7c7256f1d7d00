#include "net/torch/planar_shuffle.h"

#include <ATen/Parallel.h>

namespace faceprobe::net {
namespace {

constexpr std::int64_t kRowsToAThread = 8;

struct Sizes {
  std::int64_t pictures, channels, height, width, fold;  // channels of the planes; height and width of the features

  std::int64_t of_feature() const { return channels * fold * fold; }
};

// Calls each(features' index, planes' index) for every number, a features' row in one thread.
template <class Each>
void for_each_number(const Sizes& s, const Each& each) {
  at::parallel_for(0, s.pictures * s.height, kRowsToAThread, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t row = first; row < last; ++row) {
      const std::int64_t picture = row / s.height;
      const std::int64_t y = row % s.height;
      for (std::int64_t c = 0; c < s.channels; ++c) {
        for (std::int64_t dy = 0; dy < s.fold; ++dy) {
          std::int64_t in = row * s.width * s.of_feature() + (c * s.fold + dy) * s.fold;
          std::int64_t out = (((picture * s.channels + c) * s.height + y) * s.fold + dy) * s.width * s.fold;
          for (std::int64_t x = 0; x < s.width; ++x, in += s.of_feature(), out += s.fold) {
            for (std::int64_t dx = 0; dx < s.fold; ++dx) each(in + dx, out + dx);
          }
        }
      }
    }
  });
}

class PlanarShuffle : public torch::autograd::Function<PlanarShuffle> {
 public:
  static torch::Tensor forward(torch::autograd::AutogradContext* context, const torch::Tensor& x, std::int64_t fold) {
    const Sizes sizes{x.size(0), x.size(1) / (fold * fold), x.size(2), x.size(3), fold};
    const torch::Tensor features = x.contiguous(torch::MemoryFormat::ChannelsLast);
    torch::Tensor planes =
        torch::empty({sizes.pictures, sizes.channels, sizes.height * fold, sizes.width * fold}, x.options());
    const float* from = features.data_ptr<float>();
    float* to = planes.data_ptr<float>();
    for_each_number(sizes, [from, to](std::int64_t in, std::int64_t out) { to[out] = from[in]; });
    context->saved_data["fold"] = fold;
    return planes;
  }

  static torch::autograd::variable_list backward(torch::autograd::AutogradContext* context,
                                                 torch::autograd::variable_list gradients) {
    const std::int64_t fold = context->saved_data["fold"].toInt();
    const torch::Tensor planes = gradients[0].contiguous();
    const Sizes sizes{planes.size(0), planes.size(1), planes.size(2) / fold, planes.size(3) / fold, fold};
    torch::Tensor features = torch::empty({sizes.pictures, sizes.of_feature(), sizes.height, sizes.width},
                                          planes.options().memory_format(torch::MemoryFormat::ChannelsLast));
    const float* from = planes.data_ptr<float>();
    float* to = features.data_ptr<float>();
    for_each_number(sizes, [from, to](std::int64_t in, std::int64_t out) { to[in] = from[out]; });
    return {features, torch::Tensor()};
  }
};

}  // namespace

torch::Tensor planar_pixel_shuffle(const torch::Tensor& x, std::int64_t fold) {
  const bool ours = x.device().is_cpu() && x.scalar_type() == torch::kFloat && x.dim() == 4 && fold > 0 &&
                    x.size(1) % (fold * fold) == 0;
  return ours ? PlanarShuffle::apply(x, fold) : torch::pixel_shuffle(x, fold);
}

}  // namespace faceprobe::net
