#include "faceprobe/core/skin_reflectance.h"

#include <array>

namespace faceprobe {

SkinReflectance skin_reflectance(Region region) {
  static constexpr std::array<SkinReflectance, kSkinRegionCount> kTable = {{
      {0.28F, 0.20F},  // forehead
      {0.25F, 0.24F},  // nose
      {0.32F, 0.17F},  // cheeks
      {0.34F, 0.15F},  // upper lip
      {0.26F, 0.22F},  // lips
      {0.34F, 0.16F},  // chin
      {0.36F, 0.14F},  // jaw
      {0.30F, 0.20F},  // eyelids
      {0.36F, 0.12F},  // brows
      {0.33F, 0.15F},  // other
  }};
  const int row = static_cast<int>(region) - 1;
  return row >= 0 && row < kSkinRegionCount ? kTable[static_cast<std::size_t>(row)] : kTable.back();
}

}  // namespace faceprobe
