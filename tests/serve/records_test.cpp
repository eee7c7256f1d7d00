#include "serve/records.h"

#include "support/expect_error.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <memory>
#include <set>

namespace faceprobe::serve {
namespace {

using faceprobe::testing::TempFolder;
namespace fs = std::filesystem;

// Records of a test, made in its folder.
class RecordsTest : public ::testing::Test {
 protected:
  std::shared_ptr<EstimateRecord> estimate(bool keep = false) {
    return std::make_shared<EstimateRecord>(new_id(), "photo.jpg", folder_.path(), keep);
  }
  std::shared_ptr<EstimateRecord> ended() {
    auto record = estimate();
    record->job.succeed();
    return record;
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }
  static std::shared_ptr<InsertionRecord> insertion(const std::shared_ptr<EstimateRecord>& of) {
    return std::make_shared<InsertionRecord>(new_id(), of);
  }

  TempFolder folder_;
};

void expect_refused(FailureKind kind, const std::function<void()>& body) {
  try {
    body();
    ADD_FAILURE() << "nothing was refused";
  } catch (const Refusal& refusal) {
    EXPECT_EQ(refusal.failure().kind, kind) << refusal.what();
  }
}

std::vector<std::string> ids(const std::vector<std::shared_ptr<EstimateRecord>>& records) {
  std::vector<std::string> all;
  for (const auto& record : records) all.push_back(record->id);
  return all;
}

TEST(Ids, Are16HexadecimalDigitsAndDiffer) {
  std::set<std::string> seen;
  for (int i = 0; i < 1000; ++i) {
    const std::string id = new_id();
    EXPECT_EQ(id.size(), 16U);
    EXPECT_EQ(id.find_first_not_of("0123456789abcdef"), std::string::npos) << id;
    seen.insert(id);
  }
  EXPECT_EQ(seen.size(), 1000U);  // two of 1000 among 2^64 are alike once in 4e13 runs
}

TEST_F(RecordsTest, AreFoundByTheirIds) {
  Records records(3);
  const auto one = estimate();
  const auto two = estimate();
  records.add(one);
  records.add(two);
  EXPECT_EQ(records.estimate(two->id), two);
  EXPECT_EQ(ids(records.estimates()), (std::vector<std::string>{two->id, one->id}));  // newest first
  const auto drawn = insertion(one);
  records.add(drawn);
  EXPECT_EQ(records.insertion(drawn->id), drawn);
  expect_refused(FailureKind::kNotFound, [&] { records.estimate("0123456789abcdef"); });
  expect_refused(FailureKind::kNotFound, [&] { records.estimate(drawn->id); });
  expect_refused(FailureKind::kNotFound, [&] { records.insertion(one->id); });
  expect_refused(FailureKind::kNotFound, [&] { records.remove_estimate("0123456789abcdef"); });
  expect_refused(FailureKind::kNotFound, [&] { records.remove_insertion(""); });
}

TEST_F(RecordsTest, TheOldestThatHasEndedMakesRoom) {
  Records records(3);
  const auto running = estimate();
  running->job.progress("Looking", 0.5);
  const auto failed = estimate();
  failed->job.fail({FailureKind::kInput, "Nothing."});
  const auto done = ended();
  for (const auto& record : {running, failed, done}) records.add(record);
  const auto fourth = estimate();
  records.add(fourth);
  EXPECT_EQ(ids(records.estimates()), (std::vector<std::string>{fourth->id, done->id, running->id}));
  records.add(estimate());
  expect_refused(FailureKind::kNotFound, [&] { records.estimate(done->id); });
  EXPECT_EQ(records.estimate(running->id), running);
}

TEST_F(RecordsTest, AreBusyWhenNoneHasEnded) {
  Records records(2, 1);
  const auto one = estimate();
  records.add(one);
  records.add(estimate());
  const auto third = estimate();
  expect_refused(FailureKind::kBusy, [&] { records.add(third); });
  EXPECT_EQ(records.estimates().size(), 2U);
  const auto drawn = insertion(one);
  records.add(drawn);
  expect_refused(FailureKind::kBusy, [&] { records.add(insertion(one)); });
  drawn->job.succeed();
  records.add(insertion(one));
  expect_refused(FailureKind::kNotFound, [&] { records.insertion(drawn->id); });
  one->job.succeed();
  records.add(third);
  EXPECT_EQ(records.estimate(third->id), third);
}

TEST_F(RecordsTest, AnEstimateTakesItsInsertionsAlong) {
  Records records(3);
  const auto one = ended();
  const auto two = ended();
  const auto of_one = insertion(one);
  const auto of_two = insertion(two);
  records.add(one);
  records.add(two);
  records.add(of_one);
  records.add(of_two);
  records.remove_estimate(one->id);
  EXPECT_TRUE(one->job.stopped());
  EXPECT_TRUE(of_one->job.stopped());
  EXPECT_FALSE(of_two->job.stopped());
  expect_refused(FailureKind::kNotFound, [&] { records.estimate(one->id); });
  expect_refused(FailureKind::kNotFound, [&] { records.insertion(of_one->id); });
  EXPECT_EQ(records.insertion(of_two->id), of_two);
}

// Else the layers of estimates that nobody can ask for any more would stay in memory.
TEST_F(RecordsTest, AnEstimateThatMakesRoomTakesItsInsertionsAlong) {
  Records records(1);
  auto one = ended();
  auto drawn = insertion(one);
  records.add(one);
  records.add(drawn);
  const fs::path folder = one->home.path();
  const std::string id = drawn->id;
  drawn.reset();
  one.reset();
  records.add(estimate());
  expect_refused(FailureKind::kNotFound, [&] { records.insertion(id); });
  EXPECT_FALSE(fs::exists(folder));
}

// Between looking the estimate up and adding what is drawn into it, somebody may remove it.
TEST_F(RecordsTest, NothingIsDrawnIntoAnEstimateThatIsGone) {
  Records records(2);
  const auto one = ended();
  records.add(one);
  const auto drawn = insertion(one);
  records.remove_estimate(one->id);
  expect_refused(FailureKind::kNotFound, [&] { records.add(drawn); });
  expect_refused(FailureKind::kNotFound, [&] { records.insertion(drawn->id); });
}

TEST_F(RecordsTest, AnInsertionGoesAlone) {
  Records records(2);
  const auto one = ended();
  const auto drawn = insertion(one);
  records.add(one);
  records.add(drawn);
  records.remove_insertion(drawn->id);
  EXPECT_TRUE(drawn->job.stopped());
  EXPECT_FALSE(one->job.stopped());
  expect_refused(FailureKind::kNotFound, [&] { records.insertion(drawn->id); });
  EXPECT_EQ(records.estimate(one->id), one);
}

TEST_F(RecordsTest, FoldersGoWhenNobodyHoldsThem) {
  Records records(2);
  auto one = ended();
  auto drawn = insertion(one);
  records.add(one);
  records.add(drawn);
  const fs::path home = one->home.path();
  const fs::path inner = drawn->home.path();
  EXPECT_EQ(inner.parent_path(), home);
  std::ofstream(one->photo_file()) << "photo";
  std::ofstream(inner / "composite.png") << "picture";
  records.remove_estimate(one->id);
  EXPECT_TRUE(fs::exists(one->photo_file())) << "somebody holds it still";
  one.reset();
  EXPECT_TRUE(fs::exists(home)) << "its insertion needs it";
  drawn.reset();
  EXPECT_FALSE(fs::exists(home));
  EXPECT_EQ(entries(), 0U);
}

TEST_F(RecordsTest, FoldersThatAreToBeKeptStay) {
  auto one = estimate(true);
  auto drawn = insertion(one);
  const fs::path inner = drawn->home.path();
  std::ofstream(inner / "composite.png") << "picture";
  drawn.reset();
  one.reset();
  EXPECT_TRUE(fs::exists(inner / "composite.png"));
}

TEST_F(RecordsTest, AFolderThatCannotBeMadeIsASentence) {
  std::ofstream(folder_ / "taken") << "a file";
  faceprobe::testing::expect_error(ExitCode::kOutput, {"taken"}, [&] { OwnedFolder(folder_ / "taken/below", false); });
}

TEST_F(RecordsTest, AtTheEndEverythingIsStopped) {
  Records records(3);
  const auto one = estimate();
  const auto two = ended();
  const auto drawn = insertion(two);
  records.add(one);
  records.add(two);
  records.add(drawn);
  records.stop_all();
  EXPECT_TRUE(one->job.stopped() && two->job.stopped() && drawn->job.stopped());
}

TEST_F(RecordsTest, FilesAreListedWithSlashesAndSizes) {
  fs::create_directories(folder_ / "face_2/deep");
  fs::create_directories(folder_ / "empty");
  std::ofstream(folder_ / "report.json") << "{}";
  std::ofstream(folder_ / "face_2/deep/map.exr") << "12345";
  const std::vector<ServedFile> files = files_of(folder_.path());
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0].path, "face_2/deep/map.exr");
  EXPECT_EQ(files[0].bytes, 5U);
  EXPECT_EQ(files[1].path, "report.json");
}

}  // namespace
}  // namespace faceprobe::serve
