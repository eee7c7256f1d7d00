// From a photo to a picture with something in it, over HTTP.

#include "faceprobe/core/resample.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/io/picture_file.h"
#include "serve/contract.h"
#include "serve/running_server.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::serve::testing {
namespace {

using WholeWayTest = ServerTest;

const std::vector<std::string> kNoFaults;

void with_samples(ServerOptions& options) { options.samples = samples_folder(); }

// The sample portrait at another height, as PNG.
std::string portrait_bytes(int height) {
  const Image portrait = io::load_photo(sample_photo_file()).linear;
  const double scale = static_cast<double>(height) / portrait.height();
  const Window window{.scale = scale, .width = static_cast<int>(scale * portrait.width()), .height = height};
  const TempFolder folder;
  io::write_picture(folder / "portrait.png", resampled(portrait, window, Outside::kEdge));
  return bytes_of(folder / "portrait.png");
}

// Of a PNG, as its header has it.
std::pair<int, int> png_size(const std::string& bytes) {
  const TempFolder folder;
  std::ofstream(folder / "it.png", std::ios::binary) << bytes;
  const io::Photo photo = io::load_photo(folder / "it.png");
  EXPECT_EQ(photo.format, "png");
  return {photo.linear.width(), photo.linear.height()};
}

// A job's states, from the first to the last: they begin anywhere, never go back, and the last one alone is an end.
void expect_in_order(const std::vector<Json>& states) {
  const Contract contract;
  ASSERT_FALSE(states.empty());
  const auto rank = [](const Json& state) {
    return state["state"] == "waiting" ? 0 : state["state"] == "running" ? 1 : 2;
  };
  for (std::size_t i = 0; i < states.size(); ++i) {
    EXPECT_EQ(contract.faults_of(states[i], contract.schema("JobState"), "state"), kNoFaults);
    EXPECT_EQ(rank(states[i]) == 2, i + 1 == states.size()) << states[i];
    if (i == 0) continue;
    EXPECT_GE(rank(states[i]), rank(states[i - 1]));
    EXPECT_GE(states[i]["share"], states[i - 1]["share"]);
    EXPECT_GE(states[i]["elapsed_seconds"], states[i - 1]["elapsed_seconds"]);
  }
}

// The job at this address has come to a good end; what it tells is as laid down.
Json done(const RunningServer& server, const std::string& address, const std::string& path) {
  expect_in_order(server.events(address));
  const httplib::Response response = server.get(address);
  EXPECT_EQ(Contract().faults({"GET", path}, response.status, response.get_header_value("Content-Type"), response.body),
            kNoFaults);
  Json json = json_of(response);
  EXPECT_EQ(json["job"]["state"], "done") << json["job"];
  return json;
}

std::string sample_estimate(const RunningServer& server) {
  return address_in(server.post_json("/estimates", {{"sample", "grace_hopper"}}));
}

// Every file that is listed is there, with its size and type.
void expect_files(const RunningServer& server, const std::string& address, const Json& files) {
  for (const Json& file : files) {
    const httplib::Response response = server.get(address + "/files/" + file["path"].get<std::string>());
    EXPECT_EQ(response.status, 200) << file;
    EXPECT_EQ(response.body.size(), file["bytes"].get<std::size_t>()) << file;
    EXPECT_EQ(response.get_header_value("Content-Type"), file["media_type"]) << file;
  }
}

void expect_face_in_photo(const Json& estimate) {
  ASSERT_EQ(estimate["faces"].size(), 1U);
  const Json& face = estimate["faces"][0];
  const auto box = face["box_px"].get<std::vector<double>>();
  const auto mesh = face["mesh_px"].get<std::vector<double>>();
  ASSERT_EQ(box.size(), 4U);
  ASSERT_EQ(mesh.size(), 936U);
  for (std::size_t i = 0; i < mesh.size(); i += 2) {
    ASSERT_GE(mesh[i], box[0] - 1e-3);  // floats of some hundred pixels
    ASSERT_LE(mesh[i], box[0] + box[2] + 1e-3);
    ASSERT_GE(mesh[i + 1], box[1] - 1e-3);
    ASSERT_LE(mesh[i + 1], box[1] + box[3] + 1e-3);
  }
  EXPECT_GT(box[2], 0.1 * estimate["photo"]["width_px"].get<double>());
  EXPECT_LE(box[0] + box[2], estimate["photo"]["width_px"].get<double>());
  EXPECT_LE(box[1] + box[3], estimate["photo"]["height_px"].get<double>());
}

TEST_F(WholeWayTest, PhotoToLightToPictureAndAway) {
  const RunningServer server;
  const httplib::Response accepted = server.post_photo(portrait_bytes(720), "portrait.png");
  EXPECT_EQ(accepted.status, 202);
  EXPECT_EQ(Contract().faults({"POST", "/estimates"}, 202, "application/json", accepted.body), kNoFaults);
  const std::string address = address_in(accepted);
  const Json estimate = done(server, address, "/estimates/{id}");
  EXPECT_EQ(estimate["name"], "portrait.png");
  EXPECT_EQ(estimate["photo"], (Json{{"width_px", 614}, {"height_px", 720}}));
  EXPECT_EQ(estimate["report"]["photo"]["source"], "portrait.png");
  expect_face_in_photo(estimate);
  expect_files(server, address, estimate["files"]);
  EXPECT_EQ(png_size(server.get(address + "/photo").body), std::pair(614, 720));
  const Json list = json_of(server.get("/estimates"));
  EXPECT_EQ(Contract().faults({"GET", "/estimates"}, 200, "application/json", list.dump()), kNoFaults);
  EXPECT_EQ(list[0]["faces"], 1);

  const httplib::Response archive = server.get(address + "/archive.zip");
  EXPECT_EQ(archive.get_header_value("Content-Type"), "application/zip");
  EXPECT_EQ(archive.get_header_value("Content-Disposition"), "attachment");  // the page names it after the photo
  for (const Json& file : estimate["files"])
    EXPECT_NE(archive.body.find("faceprobe/" + file["path"].get<std::string>()), std::string::npos) << file;
  for (const std::string path : {"nothing", "../photo", "%2e%2e/photo", "..%2fshown.png", "/etc/passwd", "report.json/",
                                 "./report.json", "report.json%00"}) {
    const httplib::Response response = server.get(address + "/files/" + path);
    EXPECT_EQ(response.status, 404) << path;
    EXPECT_EQ(response.get_header_value("Content-Type"), "application/json") << path;
  }

  const httplib::Response asked =
      server.post_json(address + "/insertions", {{"object", "cube"}, {"material", "gold"}, {"quality", "preview"}});
  EXPECT_EQ(Contract().faults({"POST", "/estimates/{id}/insertions"}, asked.status, "application/json", asked.body),
            kNoFaults);
  const std::string drawn = address_in(asked);
  const Json insertion = done(server, drawn, "/insertions/{id}");
  EXPECT_EQ("/estimates/" + insertion["estimate"].get<std::string>(), address);
  std::set<std::string> names;
  for (const Json& file : insertion["files"]) names.insert(file["path"]);
  EXPECT_EQ(names, (std::set<std::string>{"composite.exr", "composite.png", "depth.exr", "insert.json", "normal.exr",
                                          "object.exr", "object.png", "shadow.exr"}));
  expect_files(server, drawn, insertion["files"]);
  // A preview's longer side has 640 px.
  EXPECT_EQ(png_size(server.get(drawn + "/files/composite.png").body), std::pair(546, 640));
  expect_failure(server.get(drawn + "/files/../report.json"), 404, "not_found", "report.json");

  EXPECT_EQ(server.remove(drawn).status, 204);
  expect_failure(server.get(drawn), 404, "not_found", "removed");
  EXPECT_EQ(server.get(address).status, 200);
  EXPECT_EQ(server.remove(address).status, 204);
  for (const std::string below : {"", "/events", "/photo", "/files/report.json", "/archive.zip"})
    expect_failure(server.get(address + below), 404, "not_found", "There is no estimate");
  expect_failure(server.remove(address), 404, "not_found", "There is no estimate");
  expect_failure(server.post_json(address + "/insertions", {{"object", "cube"}}), 404, "not_found",
                 "There is no estimate");
}

TEST_F(WholeWayTest, EstimatesRunOneAfterAnotherAndNothingIsDrawnBefore) {
  const RunningServer server(with_samples);
  const std::string first = sample_estimate(server);
  const std::string second = sample_estimate(server);
  expect_failure(server.post_json(second + "/insertions", {{"object", "cube"}}), 409, "not_ready", "not known yet");
  const std::vector<Json> states = server.events(second);
  expect_in_order(states);
  EXPECT_EQ(states.back()["state"], "done");
  EXPECT_EQ(json_of(server.get(first))["job"]["state"], "done") << "the second ended before the first";
  const Json list = json_of(server.get("/estimates"));
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ("/estimates/" + list[0]["id"].get<std::string>(), second);  // newest first
}

// The sample portrait beside itself.
std::string two_portraits() {
  const Image one = io::load_photo(sample_photo_file()).linear;
  Image both(2 * one.width(), one.height(), one.channels());
  for (int y = 0; y < both.height(); ++y) {
    for (int x = 0; x < both.width(); ++x) std::copy_n(one.pixel(x % one.width(), y), one.channels(), both.pixel(x, y));
  }
  const TempFolder folder;
  io::write_picture(folder / "both.png", both);
  return bytes_of(folder / "both.png");
}

TEST_F(WholeWayTest, SeveralFacesAreOneWayAndEachLightDrawsOn) {
  const RunningServer server;
  const std::string address = address_in(server.post_photo(two_portraits()));
  const Json estimate = done(server, address, "/estimates/{id}");  // its states never go back
  ASSERT_EQ(estimate["faces"].size(), 2U);
  for (const Json& light : {Json{{"face", 1}}, Json{{"joint_light", true}}}) {
    Json body = {{"object", "cube"}, {"quality", "preview"}};
    body.update(light);
    const std::string drawn = address_in(server.post_json(address + "/insertions", body));
    EXPECT_EQ(server.events(drawn).back()["state"], "done") << light;
  }
}

// Until the server holds no more than so many folders; the worker lets go of what it did shortly after.
void expect_folders(const RunningServer& server, std::size_t wanted) {
  for (int i = 0; i < 2000 && server.folder_entries() > wanted; ++i) server.get("/info");
  EXPECT_EQ(server.folder_entries(), wanted);
}

TEST_F(WholeWayTest, RemovingADrawingStopsIt) {
  const RunningServer server(with_samples);
  const std::string address = sample_estimate(server);
  ASSERT_EQ(server.events(address).back()["state"], "done");
  // A glass that fills the picture takes far longer than a test may.
  const httplib::Response asked = server.post_json(
      address + "/insertions", {{"object", "spheres"}, {"material", "glass"}, {"at_px", {256, 590}}, {"height_m", 0.5}});
  const std::string drawn = address_in(asked);
  std::chrono::steady_clock::time_point removed;
  std::string text;
  const auto result = server.client().Get("/api/v1" + drawn + "/events", [&](const char* data, std::size_t size) {
    text.append(data, size);
    if (removed == std::chrono::steady_clock::time_point() && text.find("\"Drawing\"") != std::string::npos) {
      EXPECT_EQ(server.remove(drawn).status, 204);
      removed = std::chrono::steady_clock::now();
    }
    return true;
  });
  ASSERT_TRUE(result);
  ASSERT_NE(removed, std::chrono::steady_clock::time_point()) << "it was never drawn: " << text;
  EXPECT_LT(std::chrono::steady_clock::now() - removed, std::chrono::seconds(5));
  const Json last = Json::parse(text.substr(text.rfind("data: ") + 6), nullptr, false);
  EXPECT_EQ(last["state"], "failed") << text;
  EXPECT_LT(last["share"].get<double>(), 0.9) << "it was drawn to its end";
  expect_failure(server.get(drawn), 404, "not_found", "There is no insertion");
  // Those who did not ask for it are served on.
  EXPECT_EQ(server.remove(address).status, 204);
  expect_folders(server, 0);
}

TEST_F(WholeWayTest, RemovingAnEstimateStopsIt) {
  const RunningServer server([](ServerOptions& options) {
    with_samples(options);
    options.studio.estimate.map_width = 4096;  // takes long, so that it cannot be over before it is removed
  });
  const std::string address = sample_estimate(server);
  std::string text;
  bool removed = false;
  const auto result = server.client().Get("/api/v1" + address + "/events", [&](const char* data, std::size_t size) {
    text.append(data, size);
    if (!removed && text.find("\"running\"") != std::string::npos) {
      EXPECT_EQ(server.remove(address).status, 204);
      removed = true;
    }
    return true;
  });
  ASSERT_TRUE(result);
  ASSERT_TRUE(removed) << text;
  const Json last = Json::parse(text.substr(text.rfind("data: ") + 6), nullptr, false);
  EXPECT_EQ(last["state"], "failed") << text;
  EXPECT_EQ(text.find("Writing files"), std::string::npos) << "its stages went on to the last: " << text;
  expect_failure(server.get(address), 404, "not_found", "There is no estimate");
  expect_folders(server, 0);
}

TEST_F(WholeWayTest, WhatCannotBeDrawnIsRefusedAtOnceOrFailsInWords) {
  const RunningServer server(with_samples);
  const std::string address = sample_estimate(server);
  ASSERT_EQ(server.events(address).back()["state"], "done");
  const auto asked = [&](const Json& more) {
    Json body = {{"object", "cube"}, {"quality", "preview"}};
    body.update(more);
    return server.post_json(address + "/insertions", body);
  };
  expect_failure(asked({{"height_m", 0}}), 400, "usage", "height");
  expect_failure(asked({{"distance_m", -1}}), 400, "usage", "distance");
  expect_failure(asked({{"distance_m", 1e300}}), 400, "usage", "distance");
  expect_failure(asked({{"object", "../x.obj"}}), 400, "usage", "sphere, cube");
  expect_failure(asked({{"material", "wood"}}), 400, "usage", "gold");
  EXPECT_EQ(json_of(server.get(address))["job"]["state"], "done");
  // Beside the picture, and in the light of a face that is not there: only the job tells.
  for (const Json& more : {Json{{"at_px", {-5000, 300}}}, Json{{"face", 5}}}) {
    const std::string failed = address_in(asked(more));
    const Json last = server.events(failed).back();
    EXPECT_EQ(last["state"], "failed") << more;
    EXPECT_EQ(last["error"]["kind"], "usage") << more;
    EXPECT_EQ(last["error"]["message"].get<std::string>().back(), '.') << more;
    expect_failure(server.get(failed + "/files/composite.png"), 404, "not_found", "not done");
  }
}

}  // namespace
}  // namespace faceprobe::serve::testing
