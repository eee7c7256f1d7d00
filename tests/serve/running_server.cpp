#include "serve/running_server.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/io/picture_file.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace faceprobe::serve::testing {
namespace {

constexpr const char* kRootAddress = "/api/v1";

httplib::Response checked(const httplib::Result& result, const std::string& address) {
  if (result) return *result;
  ADD_FAILURE() << address << ": " << httplib::to_string(result.error());
  return {};
}

}  // namespace

ServerOptions quick_options(const std::filesystem::path& folder) {
  ServerOptions options;
  options.port = 0;
  options.studio.folder = folder;
  options.studio.estimate.classical = highlight::Separator::kYang;  // the network is most of an estimate's time
  options.studio.estimate.layer_px = 64;
  options.studio.estimate.max_patches = 50;
  options.studio.estimate.map_width = 16;
  options.studio.estimate.solve.nside = 4;
  options.studio.estimate.solve.iterations = 1;
  return options;
}

RunningServer::RunningServer(const std::function<void(ServerOptions&)>& change) {
  ServerOptions options = quick_options(folder_.path());
  if (change) change(options);
  server_ = std::make_unique<Server>(std::move(options));
  thread_ = std::thread([this] { server_->run(); });
}

RunningServer::~RunningServer() { stop(); }

void RunningServer::stop() {
  if (!thread_.joinable()) return;
  server_->stop();
  thread_.join();
}

std::size_t RunningServer::folder_entries() const {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder()), std::filesystem::directory_iterator()));
}

httplib::Client RunningServer::client() const {
  httplib::Client client("127.0.0.1", port());
  client.set_read_timeout(std::chrono::seconds(30));
  return client;
}

httplib::Response RunningServer::get(const std::string& address) const {
  return checked(client().Get(kRootAddress + address), address);
}

httplib::Response RunningServer::remove(const std::string& address) const {
  return checked(client().Delete(kRootAddress + address), address);
}

httplib::Response RunningServer::post_json(const std::string& address, const Json& body) const {
  return checked(client().Post(kRootAddress + address, body.dump(), "application/json"), address);
}

httplib::Response RunningServer::post_photo(const std::string& bytes, const std::string& name) const {
  const std::string address = "/estimates" + (name.empty() ? "" : "?name=" + httplib::detail::encode_query_param(name));
  return checked(client().Post(kRootAddress + address, bytes, "application/octet-stream"), address);
}

std::vector<Json> RunningServer::events(const std::string& address) const {
  std::vector<Json> states;
  // A stream may end before the job does; browsers ask again then, too.
  do {
    const std::size_t before = states.size();
    listen(address, states);
    if (states.size() == before) return states;
  } while (states.back()["state"] != "done" && states.back()["state"] != "failed");
  return states;
}

void RunningServer::listen(const std::string& address, std::vector<Json>& states) const {
  std::string line;
  const auto take_line = [&] {
    constexpr std::string_view kData = "data: ";
    if (line.starts_with(kData)) states.push_back(Json::parse(line.substr(kData.size())));
    line.clear();
  };
  const auto result = client().Get(kRootAddress + address + "/events", [&](const char* data, std::size_t size) {
    for (const char c : std::string_view(data, size)) {
      if (c == '\n') {
        take_line();
      } else {
        line += c;
      }
    }
    return true;
  });
  EXPECT_EQ(checked(result, address).get_header_value("Content-Type"), "text/event-stream");
}

std::filesystem::path samples_folder() { return sample_photo_file().parent_path(); }
std::filesystem::path sample_photo_file() { return io::data_file("samples/grace_hopper.jpg"); }

std::string bytes_of(const std::filesystem::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

std::string blank_picture(int width, int height) {
  const TempFolder folder;
  io::write_picture(folder / "blank.png", Image(width, height, 3, 0.4F));
  return bytes_of(folder / "blank.png");
}

std::string address_in(const httplib::Response& response) {
  const std::string location = response.get_header_value("Location");
  EXPECT_TRUE(location.starts_with(kRootAddress)) << "Location is '" << location << "': " << response.body;
  return location.substr(std::min(location.size(), std::string(kRootAddress).size()));
}

Json json_of(const httplib::Response& response) {
  EXPECT_EQ(response.get_header_value("Content-Type"), "application/json") << response.body;
  Json json = Json::parse(response.body, nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << response.body;
  return json;
}

void expect_failure(const httplib::Response& response, int status, const std::string& kind, const std::string& part) {
  EXPECT_EQ(response.status, status) << response.body;
  const Json json = json_of(response);
  ASSERT_TRUE(json.is_object() && json.contains("error")) << response.body;
  EXPECT_EQ(json["error"]["kind"], kind);
  const std::string sentence = json["error"]["message"];
  EXPECT_NE(sentence.find(part), std::string::npos) << "no '" << part << "' in: " << sentence;
  EXPECT_TRUE(sentence.ends_with('.')) << sentence;
}

void ServerTest::SetUp() {
  try {
    io::data_file("face_landmark.tflite");
    sample_photo_file();
  } catch (const Error& error) {
    GTEST_SKIP() << error.what();
  }
}

}  // namespace faceprobe::serve::testing
