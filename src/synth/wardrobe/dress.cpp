#include "faceprobe/synth/wardrobe.h"
#include "synth/wardrobe/beard.h"
#include "synth/wardrobe/glasses.h"
#include "synth/wardrobe/hair.h"
#include "synth/wardrobe/headwear.h"
#include "synth/wardrobe/held.h"
#include "synth/wardrobe/torso.h"

namespace faceprobe::synth {

Figure dress(const Head& head, const WardrobeSettings& settings) {
  const Anatomy anatomy = measure(head);
  const float s = anatomy.scale;
  Figure out;
  const Eigen::Vector3f low(-0.26F * s, -0.42F * s, anatomy.skin.vertices.col(2).minCoeff() - 0.06F * s);
  const Eigen::Vector3f high(0.26F * s, anatomy.skin.vertices.col(1).maxCoeff() + 0.04F * s, 0.10F * s);
  SkinField field(low, high, 0.0065F * s);
  field.add(anatomy.skin);
  const HatShell hat = add_hat(settings, anatomy, field, out);
  add_held(settings, anatomy, field, out);
  out.meshes.push_back(make_torso(settings, anatomy, field));
  field.add(out.meshes.back());
  field.finish();
  add_hair(settings, anatomy, field, hat, out);
  add_scarf(settings, anatomy, field, out);
  add_beard(settings, anatomy, field, out);
  add_lashes(settings, anatomy, out);
  add_glasses(settings, anatomy, field, out);
  return out;
}

}  // namespace faceprobe::synth
