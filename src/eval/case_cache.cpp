#include "eval/case_cache.h"

#include "eval/nan.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/data_files.h"

#include <nlohmann/json.hpp>
#include <system_error>

namespace faceprobe::eval {
namespace {

constexpr std::size_t kKeyDigits = 32;  // of the hash's 64: names stay short, and no two runs share one
constexpr std::int64_t kMostRunBytes = 64 << 10;

using Json = nlohmann::ordered_json;

// Names of cases are any bytes, so none of them is in the path.
std::string key_of_run(const std::string& case_hash, const std::string& identity) {
  return io::sha256_hex("faceprobe-case-run/1\n" + case_hash + '\n' + identity).substr(0, kKeyDigits);
}

// Empty where there is no such file, or no JSON in it.
Json json_of(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return Json::object();
  const std::vector<std::byte> bytes = io::read_file(path, kMostRunBytes);
  const char* text = reinterpret_cast<const char*>(bytes.data());
  Json json = Json::parse(text, text + bytes.size(), nullptr, false);
  return json.is_object() ? json : Json::object();
}

void write_json(const std::filesystem::path& path, const Json& json) {
  io::write_file_atomically(path, json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n');
}

// What is not finite is null in JSON.
std::map<std::string, double> numbers_of_json(const Json& json) {
  std::map<std::string, double> numbers;
  for (const auto& [name, value] : json.items()) numbers[name] = value.is_number() ? value.get<double>() : kNaN;
  return numbers;
}

}  // namespace

CaseEntry::CaseEntry(const std::filesystem::path& work, const std::string& case_hash, const std::string& identity)
    : folder_(std::filesystem::absolute(work / key_of_run(case_hash, identity)).lexically_normal()) {}

std::optional<double> CaseEntry::finished_seconds() const {
  const Json json = json_of(folder_ / "run.json");
  if (!json.contains("seconds") || !json["seconds"].is_number()) return std::nullopt;
  return json["seconds"].get<double>();
}

void CaseEntry::begin() const {
  std::error_code error;
  std::filesystem::remove_all(folder_, error);
  if (error) throw Error(ExitCode::kOutput, folder_.string() + " cannot be emptied: " + error.message() + ".");
  io::create_folder(out());
}

void CaseEntry::finish(const std::string& method, const std::string& sample, double seconds) const {
  write_json(folder_ / "run.json", {{"method", method}, {"case", sample}, {"seconds", seconds}});
}

std::optional<CaseFigures> CaseEntry::figures(const std::string& scoring) const {
  if (scoring.empty() || !finished_seconds()) return std::nullopt;
  const Json json = json_of(folder_ / "figures.json");
  if (json.value("scoring", "") != io::sha256_hex(scoring)) return std::nullopt;
  return CaseFigures{json.value("has_light", false), json.value("has_highlight", false),
                     numbers_of_json(json.value("light", Json::object())),
                     numbers_of_json(json.value("highlight", Json::object()))};
}

void CaseEntry::keep(const CaseFigures& figures, const std::string& scoring) const {
  if (scoring.empty()) return;
  write_json(folder_ / "figures.json", {{"scoring", io::sha256_hex(scoring)},
                                        {"has_light", figures.has_light},
                                        {"has_highlight", figures.has_highlight},
                                        {"light", Json(figures.light)},
                                        {"highlight", Json(figures.highlight)}});
}

}  // namespace faceprobe::eval
