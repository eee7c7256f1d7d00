#include "faceprobe/synth/head_model.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string_view>

namespace faceprobe::synth {
namespace {

// "mouthSmile_L" of ICT-FaceKit and "mouthSmileLeft" of ARKit are the same action: mouthsmile, side l.
std::string plain_name(std::string_view name) {
  std::string plain;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return plain;
}

// The weights of one face, addressed by the names of its expressions. Names that the model lacks are passed over.
class Expression {
 public:
  explicit Expression(const HeadModel& model)
      : weights_(Eigen::VectorXf::Zero(static_cast<Eigen::Index>(model.expression.size()))) {
    for (const std::string& name : model.expression_names) names_.push_back(plain_name(name));
  }

  void add(std::string_view name, double weight) {
    const std::string plain = plain_name(name);
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (names_[i] == plain) weights_(static_cast<Eigen::Index>(i)) += static_cast<float>(weight);
    }
  }
  void add_side(std::string_view name, bool left, double weight) {
    add(std::string(name) + (left ? "L" : "R"), weight);
    add(std::string(name) + (left ? "Left" : "Right"), weight);
  }
  // Both sides, a little uneven as faces are; a model that has the action in one piece gets that.
  void add_both(std::string_view name, double weight, Random& random) {
    const double tilt = random.normal(0, 0.08);
    add_side(name, true, weight * (1 + tilt));
    add_side(name, false, weight * (1 - tilt));
    add(name, weight);
  }

  bool any() const { return weights_.size() > 0 && weights_.maxCoeff() > 0; }
  Eigen::VectorXf finished() const { return weights_.cwiseMax(0.0F).cwiseMin(1.0F); }

 private:
  std::vector<std::string> names_;
  Eigen::VectorXf weights_;
};

void smile(Expression& face, Random& random) {
  const double strength = random.between(0.3, 1.0);
  face.add_both("mouthSmile", strength, random);
  face.add_both("cheekSquint", strength * random.between(0.3, 0.8), random);
  face.add_both("eyeSquint", strength * random.between(0.0, 0.4), random);
  if (random.chance(0.5)) {  // with teeth
    face.add_both("mouthUpperUp", strength * random.between(0.15, 0.45), random);
    face.add_both("mouthLowerDown", strength * random.between(0.0, 0.3), random);
    face.add("jawOpen", strength * random.between(0.0, 0.2));
  }
}

void speak(Expression& face, Random& random) {
  face.add("jawOpen", random.between(0.12, 0.55));
  if (random.chance(0.4)) face.add("mouthFunnel", random.between(0.1, 0.5));
  if (random.chance(0.4)) face.add_both("mouthStretch", random.between(0.1, 0.4), random);
}

void surprise(Expression& face, Random& random) {
  face.add("jawOpen", random.between(0.05, 0.5));
  const double strength = random.between(0.4, 1.0);
  face.add_both("browInnerUp", strength, random);
  face.add_both("browOuterUp", strength, random);
  face.add_both("eyeWide", strength * random.between(0.3, 0.8), random);
}

void closed_eyes(Expression& face, Random& random) {
  const double strength = random.between(0.9, 1.0);
  face.add_side("eyeBlink", true, strength);
  face.add_side("eyeBlink", false, strength);
  if (random.chance(0.3)) face.add_both("mouthSmile", random.between(0.1, 0.5), random);
}

void squint(Expression& face, Random& random) {
  face.add_both("eyeSquint", random.between(0.4, 1.0), random);
  face.add_both("cheekSquint", random.between(0.1, 0.6), random);
  face.add_both("browDown", random.between(0.0, 0.6), random);
}

void raised_brows(Expression& face, Random& random) {
  face.add_both("browInnerUp", random.between(0.2, 0.9), random);
  face.add_both("browOuterUp", random.between(0.0, 0.8), random);
}

void frown(Expression& face, Random& random) {
  face.add_both("browDown", random.between(0.4, 1.0), random);
  face.add_both("mouthFrown", random.between(0.0, 0.6), random);
  face.add_both("noseSneer", random.between(0.0, 0.4), random);
}

void pucker(Expression& face, Random& random) {
  if (random.chance(0.6)) {
    face.add("mouthPucker", random.between(0.3, 0.9));
  } else {
    face.add("mouthFunnel", random.between(0.3, 0.8));
  }
}

void pressed_lips(Expression& face, Random& random) {
  face.add_both("mouthPress", random.between(0.3, 0.9), random);
  face.add(random.chance(0.5) ? "mouthLeft" : "mouthRight", random.between(0.0, 0.35));
}

void look_aside(Expression& face, Random& random) {
  const double aside = std::clamp(random.normal(0, 0.28), -0.7, 0.7);  // positive: to the subject's left
  const bool left = aside > 0;
  face.add_side("eyeLookOut", left, std::abs(aside));
  face.add_side("eyeLookIn", !left, std::abs(aside));
  const double up = std::clamp(random.normal(-0.05, 0.18), -0.5, 0.4);
  for (const bool side : {true, false}) face.add_side(up > 0 ? "eyeLookUp" : "eyeLookDown", side, std::abs(up));
}

struct Action {
  double share;
  void (*apply)(Expression&, Random&);
};
// Smiles and speech are most of what photos show.
constexpr Action kActions[] = {{0.28, smile},       {0.16, speak},  {0.08, surprise},
                               {0.08, closed_eyes}, {0.10, squint}, {0.10, raised_brows},
                               {0.08, frown},       {0.06, pucker}, {0.06, pressed_lips}};

Eigen::VectorXf normal_draw(std::size_t count, double deviation, Random& random) {
  Eigen::VectorXf values(static_cast<Eigen::Index>(count));
  for (float& value : values) value = static_cast<float>(random.normal(0, deviation));
  return values;
}

constexpr double kUnnamedDeviation = 0.7;  // of modes that are statistics: less than one, for they mix badly

}  // namespace

HeadParameters draw_identity(const HeadModel& model, const HeadDraw& options, Random& random) {
  HeadParameters parameters;
  parameters.identity = normal_draw(model.identity.size(), static_cast<double>(options.identity_deviation), random);
  parameters.expression = Eigen::VectorXf::Zero(static_cast<Eigen::Index>(model.expression.size()));
  parameters.albedo = normal_draw(model.albedo_modes.size(), 1.0, random);
  return parameters;
}

Eigen::VectorXf draw_expression(const HeadModel& model, const HeadDraw& options, Random& random) {
  Expression face(model);
  if (random.chance(static_cast<double>(options.neutral_share))) return face.finished();
  if (model.expression_names.empty()) return normal_draw(model.expression.size(), kUnnamedDeviation, random);

  double pick = random.uniform();
  for (const Action& action : kActions) {
    pick -= action.share;
    if (pick >= 0) continue;
    action.apply(face, random);
    break;
  }
  if (random.chance(0.6)) look_aside(face, random);
  // Names of nobody we know: one of them at a time.
  if (!face.any() && !model.expression.empty()) {
    face.add(model.expression_names[static_cast<std::size_t>(random.below(static_cast<int>(model.expression.size())))],
             random.between(0.2, 0.8));
  }
  return face.finished();
}

}  // namespace faceprobe::synth
