// Photos of people from files: a real portrait, as the camera saw it and as others would have.
#include "faceprobe/train/people.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/synth/shard.h"
#include "train/person_loss.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <string>

namespace faceprobe::train {
namespace {

constexpr double kSmile = 0.06;  // she smiles, at .05

class People : public ::testing::Test {
 protected:
  People()
      : folder_(std::filesystem::temp_directory_path() / ("faceprobe_people_" + std::to_string(::getpid()))),
        portrait_(io::load_photo(io::data_file("samples/astronaut.png")).linear) {
    std::filesystem::create_directories(folder_);
  }
  ~People() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  void put(const std::string& name, const ByteImage& picture) const {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    io::write_picture(path, picture);
  }
  // At another exposure, the lights' colours as they were.
  Image exposed(float gain) const {
    Image picture = portrait_;
    for (float& value : picture.values()) value = std::min(1.0F, gain * value);
    return picture;
  }

  std::filesystem::path folder_;
  Image portrait_;
};

TEST_F(People, ManyExposuresOfOneFaceAreOnePersonAndItsColoursAgree) {
  for (int i = 0; i < 4; ++i)
    put("collins/" + std::to_string(i) + ".png", encode_srgb(exposed(1.0F - 0.15F * static_cast<float>(i))));
  put("nobody/0.png", ByteImage(200, 200, 3, 90));
  const std::vector<PersonSet> people = load_people(folder_, {.least_photos = 4, .max_expression = kSmile});
  ASSERT_EQ(people.size(), 1U);
  EXPECT_EQ(people[0].name, "collins");
  ASSERT_EQ(people[0].photos.size(), 4U);
  EXPECT_TRUE(people[0].left_out.empty());
  // The same face in the same place: no skin is lost to misalignment, and after the histogram transfer the chromaticities are of rank one
  // but for rounding to bytes.
  std::vector<PersonPhoto> photos;
  std::vector<Image> nothing;
  for (const auto& photo : people[0].photos) {
    photos.push_back(*photo);
    nothing.emplace_back(photo->linear.width(), photo->linear.height(), 3);
  }
  const PersonPhotos group(std::move(photos), people[0].regions);
  EXPECT_GT(group.pixels(), 1000);
  EXPECT_LT(group.loss(nothing).residual, 5e-3);  // different people's photos show ten times that
}

TEST_F(People, UnsuitablePhotosAreLeftOutWithTheReason) {
  for (int i = 0; i < 2; ++i) put("collins/good" + std::to_string(i) + ".png", encode_srgb(portrait_));
  Image grey = portrait_;
  for (std::size_t i = 0; i < grey.pixel_count(); ++i)
    std::fill_n(grey.data() + 3 * i, 3, luminance(grey.data() + 3 * i));
  put("collins/grey.png", encode_srgb(grey));
  put("collins/nobody.png", ByteImage(200, 200, 3, 90));
  put("collins/overexposed.png", encode_srgb(exposed(6)));
  const std::vector<PersonSet> people = load_people(folder_, {.least_photos = 2, .max_expression = kSmile});
  ASSERT_EQ(people.size(), 1U);
  EXPECT_EQ(people[0].photos.size(), 2U);
  ASSERT_EQ(people[0].left_out.size(), 3U);
  EXPECT_NE(people[0].left_out[0].find("grey.png: it is grey"), std::string::npos) << people[0].left_out[0];
  EXPECT_NE(people[0].left_out[1].find("nobody.png: "), std::string::npos) << people[0].left_out[1];
  EXPECT_NE(people[0].left_out[2].find("overexposed.png: "), std::string::npos) << people[0].left_out[2];
}

// A window to the left and a lamp to the right of the face, in one of four photos.
TEST_F(People, SeveralLightColoursAreLeftOutWithTheReason) {
  for (int i = 0; i < 4; ++i) put("collins/" + std::to_string(i) + ".png", encode_srgb(exposed(0.6F)));
  Image mixed = exposed(0.6F);
  for (int y = 0; y < mixed.height(); ++y) {
    for (int x = 0; x < mixed.width(); ++x) {
      const float lamp = static_cast<float>(std::clamp((x - 150) / 150.0, 0.0, 1.0));  // her face lies between
      mixed(x, y, 0) *= 0.6F + 0.9F * lamp;
      mixed(x, y, 2) *= 1.5F - 0.9F * lamp;
    }
  }
  put("collins/mixed.png", encode_srgb(mixed));
  std::string said;
  const std::vector<PersonSet> people = load_people(folder_, {.least_photos = 4, .max_expression = kSmile},
                                                    [&](const std::string& sentence) { said += sentence + "\n"; });
  ASSERT_EQ(people.size(), 1U);
  EXPECT_EQ(people[0].photos.size(), 4U);
  ASSERT_EQ(people[0].left_out.size(), 1U);
  EXPECT_NE(said.find("collins/mixed.png: The photo is left out because the lights have several colours"),
            std::string::npos)
      << said;
  const PeopleOptions lenient{.least_photos = 4, .max_expression = kSmile, .max_light_colours = 0.5};
  EXPECT_EQ(load_people(folder_, lenient)[0].photos.size(), 5U);
}

TEST_F(People, ASmileIsLeftOutByDefault) {
  put("collins/0.png", encode_srgb(portrait_));
  std::string said;
  EXPECT_TRUE(load_people(folder_, {}, [&](const std::string& sentence) { said += sentence + "\n"; }).empty());
  EXPECT_NE(said.find("collins/0.png: The photo is left out because the expression"), std::string::npos) << said;
}

// A data set in which one person has four photos and another too few.
TEST_F(People, PeopleOfADataSetAreReadByTheirNumbers) {
  const ByteImage photo = encode_srgb(portrait_);
  ASSERT_EQ(photo.width(), photo.height());
  const int size = photo.width();
  std::vector<synth::ViewSamples> views(2);
  for (int person = 0; person < 2; ++person) {
    synth::ViewSamples& view = views[static_cast<std::size_t>(person)];
    view.view.normal = Image(size, size, 3);
    view.view.depth_m = Image(size, size, 1);
    view.view.region = view.view.owner = ByteImage(size, size, 1, 1);
    view.view.faces.resize(1);
    view.view.faces[0].person = 7 + person;
    for (int i = 0; i < (person == 0 ? 4 : 2); ++i) {
      synth::Sample sample;
      sample.photo = photo;
      sample.clip = ByteImage(size, size, 1);
      sample.highlight = sample.diffuse = sample.albedo = sample.shading = Image(size, size, 3);
      sample.environment = EnvMap(4, 2);
      sample.settings_json = "{}";
      view.samples.push_back(std::move(sample));
    }
  }
  const synth::ShardWriter writer(folder_ / "faces", {.size_px = size, .environment_height = 2, .recipe = "{}"});
  writer.write(0, views);
  writer.finish(1, "");
  const PeopleOptions options{.least_photos = 4, .max_expression = kSmile};
  const std::vector<PersonSet> people = load_synthetic_people(folder_ / "faces", 10, options);
  ASSERT_EQ(people.size(), 1U);
  EXPECT_EQ(people[0].name, "person 7");
  EXPECT_EQ(people[0].photos.size(), 4U);
  EXPECT_THROW(load_synthetic_people(folder_ / "faces", 0, options), Error);
  EXPECT_THROW(load_synthetic_people(folder_ / "absent", 1, options), Error);
}

TEST_F(People, FoldersThatAreNotThereOrEmptyAreRefused) {
  EXPECT_THROW(load_people(folder_ / "absent", {}), Error);
  EXPECT_THROW(load_people(folder_, {}), Error);
  EXPECT_THROW(load_people(folder_, {.least_photos = 1}), Error);
}

}  // namespace
}  // namespace faceprobe::train
