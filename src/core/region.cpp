#include "faceprobe/core/region.h"

namespace faceprobe {

std::string_view region_name(Region region) {
  switch (region) {
    case Region::kNone: return "none";
    case Region::kForehead: return "forehead";
    case Region::kNose: return "nose";
    case Region::kCheeks: return "cheeks";
    case Region::kUpperLip: return "upper lip";
    case Region::kLips: return "lips";
    case Region::kChin: return "chin";
    case Region::kJaw: return "jaw";
    case Region::kEyelids: return "eyelids";
    case Region::kBrows: return "brows";
    case Region::kOther: return "other";
    case Region::kEyes: return "eyes";
    case Region::kMouth: return "mouth";
    case Region::kHair: return "hair";
    case Region::kGlasses: return "glasses";
    case Region::kObject: return "object";
    case Region::kClothes: return "clothes";
  }
  return "none";
}

std::array<std::uint8_t, 3> region_colour(Region region) {
  switch (region) {
    case Region::kNone: return {0, 0, 0};
    case Region::kForehead: return {102, 194, 165};
    case Region::kNose: return {252, 141, 98};
    case Region::kCheeks: return {141, 160, 203};
    case Region::kUpperLip: return {231, 138, 195};
    case Region::kLips: return {228, 26, 28};
    case Region::kChin: return {166, 216, 84};
    case Region::kJaw: return {255, 217, 47};
    case Region::kEyelids: return {152, 78, 163};
    case Region::kBrows: return {102, 60, 20};
    case Region::kOther: return {179, 179, 179};
    case Region::kEyes: return {255, 255, 255};
    case Region::kMouth: return {90, 0, 30};
    case Region::kHair: return {60, 60, 60};
    case Region::kGlasses: return {0, 200, 255};
    case Region::kObject: return {255, 120, 0};
    case Region::kClothes: return {20, 60, 120};
  }
  return {0, 0, 0};
}

}  // namespace faceprobe
