// What stays in memory of the photos and estimates that a server remembers.

#include "serve/studio.h"

#include "faceprobe/render/shapes.h"
#include "serve/last_photo.h"
#include "serve/running_server.h"
#include "support/expect_error.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

namespace faceprobe::serve::testing {
namespace {

namespace fs = std::filesystem;
using faceprobe::testing::expect_error;
using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

// A record with a photo of so many pixels; nothing has been done with it.
std::shared_ptr<EstimateRecord> record_of(const TempFolder& folder, int width, int height) {
  auto record = std::make_shared<EstimateRecord>(new_id(), "holiday.jpg", folder.path(), false);
  std::ofstream(record->photo_file(), std::ios::binary) << blank_picture(width, height);
  return record;
}

TEST(LastPhoto, IsDecodedOnceAndGoesWhenAnotherComes) {
  const TempFolder folder;
  const auto one = record_of(folder, 20, 10);
  const auto two = record_of(folder, 10, 20);
  LastPhoto last{io::Limits()};
  EXPECT_FALSE(last.kept());
  const std::weak_ptr<const io::Photo> first = last.of(one);
  ASSERT_FALSE(first.expired());
  EXPECT_EQ(last.of(one), first.lock());
  EXPECT_EQ(last.of(two)->linear.width(), 10);
  EXPECT_TRUE(first.expired());
  EXPECT_TRUE(last.kept());
  EXPECT_EQ(last.of(one)->linear.width(), 20);
}

TEST(LastPhoto, GoesWithItsRecordAndWhenItIsForgotten) {
  const TempFolder folder;
  auto one = record_of(folder, 20, 10);
  LastPhoto last{io::Limits()};
  std::weak_ptr<const io::Photo> photo = last.of(one);
  last.forget();
  EXPECT_TRUE(photo.expired());
  EXPECT_FALSE(last.kept());
  photo = last.of(one);
  EXPECT_TRUE(last.kept());
  one.reset();
  EXPECT_TRUE(photo.expired());
  EXPECT_FALSE(last.kept());
  last.forget();
}

TEST(LastPhoto, IsCalledByItsOwnNameAndNotByOurs) {
  const TempFolder folder;
  const auto record = record_of(folder, 20, 10);
  std::ofstream(record->photo_file()) << "words";
  LastPhoto last{io::Limits()};
  expect_error(ExitCode::kInput, {"'holiday.jpg'"}, [&] { last.of(record); });
  EXPECT_FALSE(last.kept());
}

class StudioTest : public ServerTest {
 protected:
  StudioOptions options() const { return quick_options(folder_.path()).studio; }
  TempFolder folder_;
};

std::shared_ptr<EstimateRecord> added(Studio& studio, const fs::path& photo) {
  return studio.add_photo("photo", [&](const fs::path& to) { fs::copy_file(photo, to); });
}

JobPhase end_of(const Job& job) {
  int seen = 0;
  const auto start = steady_clock::now();
  JobState state = job.state();
  while (!state.ended() && steady_clock::now() - start < seconds(120)) state = job.wait(seen, seconds(1));
  return state.phase;
}

// The worker lets go of what it worked on shortly after the job has ended.
void expect_let_go(const Studio& studio) {
  const auto start = steady_clock::now();
  while (studio.keeps_photo() && steady_clock::now() - start < seconds(10))
    std::this_thread::sleep_for(milliseconds(1));
  EXPECT_FALSE(studio.keeps_photo());
}

TEST_F(StudioTest, ThePhotoGoesWithItsEstimate) {
  Studio studio(options());
  auto record = added(studio, sample_photo_file());
  ASSERT_EQ(end_of(record->job), JobPhase::kDone);
  EXPECT_TRUE(studio.keeps_photo());
  studio.records().remove_estimate(record->id);
  record.reset();
  expect_let_go(studio);
}

TEST_F(StudioTest, ThePhotoGoesWhenNothingIsDoneForAWhile) {
  StudioOptions soon = options();
  soon.photo_kept = milliseconds(20);
  Studio studio(soon);
  const auto record = added(studio, sample_photo_file());
  ASSERT_EQ(end_of(record->job), JobPhase::kDone);
  expect_let_go(studio);
  // It is read again when it is needed.
  const auto drawn = studio.add_insertion(record->id, {.object = "cube", .material = "", .where = {}, .preview = true});
  EXPECT_EQ(end_of(drawn->job), JobPhase::kDone);
}

TEST_F(StudioTest, APhotoWithoutLightIsNotKept) {
  Studio studio(options());
  std::ofstream(folder_ / "blank.png", std::ios::binary) << blank_picture(200, 200);
  const auto record = added(studio, folder_ / "blank.png");
  ASSERT_EQ(end_of(record->job), JobPhase::kFailed);
  expect_let_go(studio);
}

TEST_F(StudioTest, LayersAreNotKept) {
  Studio studio(options());
  const auto record = added(studio, sample_photo_file());
  ASSERT_EQ(end_of(record->job), JobPhase::kDone);
  ASSERT_EQ(record->estimate.faces.size(), 1U);
  const pipeline::FaceEstimate& face = record->estimate.faces[0];
  EXPECT_TRUE(face.picture.empty());
  EXPECT_TRUE(face.layers.diffuse.empty());
  EXPECT_FALSE(face.geometry.region.empty());
}

void expect_same(const Image& one, const Image& other) {
  EXPECT_FALSE(one.empty());
  EXPECT_TRUE(std::ranges::equal(one.values(), other.values()));
}

// Things are drawn into the photo as if everything were there still.
TEST_F(StudioTest, WhatThingsAreDrawnByIsKept) {
  const Image one = io::load_photo(sample_photo_file()).linear;
  io::Photo photo;
  photo.linear = Image(2 * one.width(), one.height(), 3);
  for (int y = 0; y < one.height(); ++y) {
    for (int x = 0; x < photo.linear.width(); ++x)
      std::copy_n(one.pixel(x % one.width(), y), 3, photo.linear.pixel(x, y));
  }
  photo.clipped = ByteImage(photo.linear.width(), photo.linear.height(), 1);
  const pipeline::Estimator estimator(options().estimate);
  pipeline::Estimate estimate = estimator.estimate(photo);
  ASSERT_EQ(estimate.faces.size(), 2U);
  const auto scene = [&](const pipeline::InsertionOptions& where) {
    return pipeline::scene_for(photo, estimate, render::shape("cube"), where);
  };
  pipeline::InsertionOptions of_second, joint;
  of_second.face = 1;
  joint.joint_light = true;
  for (const pipeline::InsertionOptions& where : {pipeline::InsertionOptions(), of_second, joint}) {
    const insert::Scene before = scene(where);
    pipeline::Estimate all = estimate;
    forget_layers(estimate);
    const insert::Scene after = scene(where);
    estimate = std::move(all);
    expect_same(after.environment.radiance(), before.environment.radiance());
    expect_same(after.matte.value().cover, before.matte.value().cover);
    expect_same(after.matte.value().depth_m, before.matte.value().depth_m);
    EXPECT_EQ(after.lamps.size(), before.lamps.size());
    EXPECT_EQ(after.up, before.up);
    EXPECT_TRUE(after.model.box().isApprox(before.model.box()));
    EXPECT_GT(*std::ranges::max_element(after.matte->cover.values()), 0) << "the faces stand in front of nothing";
  }
}

}  // namespace
}  // namespace faceprobe::serve::testing
