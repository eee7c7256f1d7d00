#include "pipeline/model_card.h"

#include "faceprobe/io/data_files.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>
#include <fstream>
#include <string>

namespace faceprobe::pipeline {
namespace {

std::filesystem::path models_folder() { return io::data_file("face.safetensors").parent_path(); }

// The weights that are shipped are those that their cards tell of: data, terms and scores.
TEST(ModelCard, EveryShippedFileHasTheHashOnItsCard) {
  constexpr std::int64_t kMost = 1 << 26;
  const std::string card = io::read_text(models_folder() / "README.md", kMost);
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(models_folder())) {
    if (entry.path().extension() != ".safetensors") continue;
    ++files;
    EXPECT_EQ(hash_on_card(card, entry.path().filename().string()), io::sha256_of_file(entry.path(), kMost))
        << entry.path() << " is not the file that its card in models/README.md tells of; write the card anew.";
    EXPECT_LE(entry.file_size(), 15U << 20U) << entry.path();
  }
  EXPECT_GE(files, 3);
}

TEST(ModelCard, TheHashIsTheFilesOwn) {
  const std::string a(64, 'a');
  const std::string b(64, 'b');
  const std::string card = "| `x.tflite` | detector | `" + a +
                           "` |\n\n## y.safetensors\n\n| made by | `z.safetensors` |\n| sha256 | `" + b +
                           "` |\n\n## w.safetensors\n\n| sha256 | `" + a + "` |\n";
  EXPECT_EQ(hash_on_card(card, "x.tflite"), a);
  EXPECT_EQ(hash_on_card(card, "y.safetensors"), b);
  EXPECT_EQ(hash_on_card(card, "w.safetensors"), a);
  EXPECT_EQ(hash_on_card(card, "z.safetensors"), "") << "named in another's section";
  EXPECT_EQ(hash_on_card("## y.safetensors\n| sha256 | `" + b + "c` |\n", "y.safetensors"), "")
      << "too long for a hash";
}

TEST(ModelCard, AChangedFileIsFound) {
  const testing::TempFolder folder;
  std::ofstream(folder / "a.safetensors") << "weights";
  EXPECT_EQ(card_mismatch(folder / "a.safetensors"), "") << "without a card";
  std::ofstream(folder / "README.md") << "## a.safetensors\n\n| sha256 | `" << io::sha256_hex("weights") << "` |\n";
  EXPECT_EQ(card_mismatch(folder / "a.safetensors"), "");
  std::ofstream(folder / "a.safetensors", std::ios::app) << "!";
  EXPECT_NE(card_mismatch(folder / "a.safetensors").find("was changed"), std::string::npos);
  std::ofstream(folder / "b.safetensors") << "others";
  EXPECT_EQ(card_mismatch(folder / "b.safetensors"), "") << "not on the card";
}

}  // namespace
}  // namespace faceprobe::pipeline
