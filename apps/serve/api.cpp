#include "serve/api.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/version.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/render/shapes.h"
#include "serve/archive.h"
#include "serve/describe.h"
#include "serve/requests.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

namespace faceprobe::serve {
namespace {

namespace fs = std::filesystem;
using Request = httplib::Request;
using Response = httplib::Response;

constexpr std::int64_t kMostServedBytes = 1LL << 30;
constexpr const char* kRoot = "/api/v1";
constexpr const char* kId = "([0-9a-f]{16})";

// Public-domain portraits that set-up fetches; those that are there are offered.
struct Sample {
  std::string_view name, file, title;
};
constexpr std::array kSamples = {
    Sample{"grace_hopper", "grace_hopper.jpg", "Grace Hopper, US Navy"},
    Sample{"astronaut", "astronaut.png", "Eileen Collins, NASA"},
};

fs::path sample_file(const ServerOptions& options, const std::string& name) {
  const auto* known = std::ranges::find(kSamples, name, &Sample::name);
  if (known != kSamples.end() && !options.samples.empty()) {
    fs::path file = options.samples / known->file;
    if (fs::is_regular_file(file)) return file;
  }
  throw Refusal(FailureKind::kNotFound, "There is no sample photo '" + name + "'.");
}

Json info_json(const ServerOptions& options) {
  Json json = {{"version", kVersion},
               {"max_upload_bytes", options.max_upload_bytes},
               {"history_limit", options.studio.history_limit},
               {"objects", render::shape_names()},
               {"materials", Json::array()},
               {"samples", Json::array()}};
  for (const std::string& name : render::material_preset_names())
    json["materials"].push_back(material_json(render::material_preset(name)));
  for (const Sample& sample : kSamples) {
    if (!options.samples.empty() && fs::is_regular_file(options.samples / sample.file))
      json["samples"].push_back({{"name", sample.name}, {"title", sample.title}});
  }
  return json;
}

void send_file(Response& response, const fs::path& file, const std::string& called) {
  const std::vector<std::byte> bytes = io::read_file(file, kMostServedBytes);
  response.set_content(reinterpret_cast<const char*>(bytes.data()), bytes.size(), media_type(called));
}

// Only what is listed is sent, so that no path leads anywhere else.
void send_listed(Response& response, const fs::path& folder, const std::vector<ServedFile>& files,
                 const std::string& path) {
  if (std::ranges::find(files, path, &ServedFile::path) == files.end())
    throw Refusal(FailureKind::kNotFound, "There is no file '" + path + "'.");
  send_file(response, folder / path, path);
}

void write_upload(const fs::path& file, const httplib::ContentReader& read, const Response& response,
                  std::int64_t most_bytes) {
  std::ofstream out(file, std::ios::binary);
  bool written = true;
  std::size_t bytes = 0;
  const bool received = read([&](const char* data, std::size_t size) {
    bytes += size;
    written = static_cast<bool>(out.write(data, static_cast<std::streamsize>(size)));
    return written;
  });
  out.close();
  if (response.status == 413) throw too_large(most_bytes);  // so said the HTTP library, which has read on to its end
  if (!written || !out)
    throw Error(ExitCode::kOutput, "The photo could not be stored: the disk is full, or not writable.");
  if (!received) throw Refusal(FailureKind::kUsage, "The photo did not arrive whole; send it again.");
  if (bytes == 0) throw Refusal(FailureKind::kUsage, "The request holds no photo; send the bytes of a file.");
}

std::string read_text(const httplib::ContentReader& read, const Response& response) {
  constexpr std::size_t kLongest = 1 << 16;
  std::string text;
  std::size_t bytes = 0;
  const bool received = read([&](const char* data, std::size_t size) {
    bytes += size;
    if (bytes <= kLongest) text.append(data, size);
    return true;
  });
  if (bytes > kLongest || response.status == 413)
    throw Refusal(FailureKind::kTooLarge, "A request in JSON may have 65536 bytes at most.");
  if (!received) throw Refusal(FailureKind::kUsage, "The request did not arrive whole; send it again.");
  return text;
}

void accept(Response& response, const std::string& address, const Json& json) {
  response.set_header("Location", kRoot + address);
  answer(response, json, 202);
}

std::string type_of(const Request& request) {
  std::string type = request.get_header_value("Content-Type");
  type.resize(std::min(type.size(), type.find_first_of("; \t")));
  std::ranges::transform(type, type.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return type;
}

Json json_of(const EstimateRecord& record) { return estimate_json(record); }
Json json_of(const InsertionRecord& record) { return insertion_json(record); }
fs::path folder_of(const EstimateRecord& record) { return record.output(); }
const fs::path& folder_of(const InsertionRecord& record) { return record.home.path(); }

template <class Record>
const Record& done(const Record& record) {
  if (record.job.state().phase == JobPhase::kDone) return record;
  throw Refusal(FailureKind::kNotFound, "There are no files here yet, because the work is not done.");
}

// What estimates and insertions have in common. `record_of`: request to shared pointer; `remove`: by id.
template <class RecordOf, class Remove>
void add_job_routes(httplib::Server& http, const std::string& one, const RecordOf& record_of, const Remove& remove,
                    EventStreams& events) {
  http.Get(one,
           [record_of](const Request& request, Response& response) { answer(response, json_of(*record_of(request))); });
  http.Delete(one, [remove](const Request& request, Response& response) {
    remove(request.matches[1]);
    response.status = 204;
  });
  http.Get(one + "/events", [record_of, &events](const Request& request, Response& response) {
    const auto record = record_of(request);
    events.stream(response, record, record->job);
  });
  http.Get(one + "/files/(.+)", [record_of](const Request& request, Response& response) {
    const auto record = record_of(request);
    send_listed(response, folder_of(done(*record)), record->files, request.matches[2]);
  });
}

void add_estimate_routes(httplib::Server& http, Studio& studio, const ServerOptions& options, EventStreams& events) {
  const std::string all = std::string(kRoot) + "/estimates";
  const std::string one = all + "/" + kId;
  const auto record_of = [&studio](const Request& request) { return studio.records().estimate(request.matches[1]); };
  http.Get(all, [&studio](const Request&, Response& response) {
    Json list = Json::array();
    for (const auto& record : studio.records().estimates()) list.push_back(summary_json(*record));
    answer(response, list);
  });
  http.Post(all, [&studio, &options](const Request& request, Response& response, const httplib::ContentReader& read) {
    std::shared_ptr<EstimateRecord> record;
    const std::string type = type_of(request);
    const std::string name = shown_name(request.get_param_value("name"));
    if (type == "application/json") {
      const std::string sample = read_sample_request(read_text(read, response));
      const fs::path file = sample_file(options, sample);
      record = studio.add_photo(request.has_param("name") ? name : file.filename().string(), [&](const fs::path& photo) {
        std::error_code error;
        if (!fs::copy_file(file, photo, error))
          throw Error(ExitCode::kOutput, "The photo could not be stored: " + error.message() + ".");
      });
    } else if (type == "application/octet-stream" || type.starts_with("image/")) {
      record = studio.add_photo(
          name, [&](const fs::path& photo) { write_upload(photo, read, response, options.max_upload_bytes); });
    } else {
      throw Refusal(FailureKind::kWrongType,
                    "A photo is sent as application/octet-stream, or the name of a sample as "
                    "application/json; found '" +
                        type + "'.");
    }
    accept(response, "/estimates/" + record->id, estimate_json(*record));
  });
  add_job_routes(
      http, one, record_of, [&studio](const std::string& id) { studio.records().remove_estimate(id); }, events);
  http.Get(one + "/photo", [record_of](const Request& request, Response& response) {
    const auto record = record_of(request);
    if (!fs::is_regular_file(record->shown_photo()))
      throw Refusal(FailureKind::kNotFound, "This photo has not been read.");
    send_file(response, record->shown_photo(), ".png");
  });
  http.Get(one + R"(/archive\.zip)", [record_of](const Request& request, Response& response) {
    const auto record = record_of(request);
    response.set_content(zip_of(folder_of(done(*record)), record->files, "faceprobe"), "application/zip");
    response.set_header("Content-Disposition", "attachment");
  });
  http.Post(
      one + "/insertions", [&studio](const Request& request, Response& response, const httplib::ContentReader& read) {
        if (type_of(request) != "application/json")
          throw Refusal(FailureKind::kWrongType, "An insertion is asked for in application/json.");
        const auto record = studio.add_insertion(request.matches[1], read_insertion_request(read_text(read, response)));
        accept(response, "/insertions/" + record->id, insertion_json(*record));
      });
}

void add_insertion_routes(httplib::Server& http, Studio& studio, EventStreams& events) {
  const std::string one = std::string(kRoot) + "/insertions/" + kId;
  const auto record_of = [&studio](const Request& request) { return studio.records().insertion(request.matches[1]); };
  add_job_routes(
      http, one, record_of, [&studio](const std::string& id) { studio.records().remove_insertion(id); }, events);
}

}  // namespace

void answer(Response& response, const Json& json, int status) {
  if (status != 200) response.status = status;  // else 206 where a range was asked for
  response.set_header("Cache-Control", "no-store");
  response.set_content(json.dump(-1, ' ', false, Json::error_handler_t::replace), "application/json");
}

void answer(Response& response, const Failure& failure) {
  answer(response, failure_json(failure), http_status(failure.kind));
}

Refusal too_large(std::int64_t most_bytes) {
  return {FailureKind::kTooLarge,
          "The photo is larger than the " + std::to_string(most_bytes >> 20) + " MB that this server takes."};
}

void add_routes(httplib::Server& http, Studio& studio, const ServerOptions& options, EventStreams& events) {
  const std::string root = kRoot;
  http.Get(root + "/info", [&options](const Request&, Response& response) { answer(response, info_json(options)); });
  http.Get(root + "/samples/([a-z_]+)", [&options](const Request& request, Response& response) {
    const fs::path file = sample_file(options, request.matches[1]);
    send_file(response, file, file.filename());
  });
  http.Get(root + "/objects/([a-z_]+)", [](const Request& request, Response& response) {
    const std::string name = request.matches[1];
    const auto& names = render::shape_names();
    if (std::ranges::find(names, name) == names.end())
      throw Refusal(FailureKind::kNotFound, "There is no object '" + name + "'.");
    answer(response, object_json(name, render::shape(name)));
  });
  add_estimate_routes(http, studio, options, events);
  add_insertion_routes(http, studio, events);
}

}  // namespace faceprobe::serve
