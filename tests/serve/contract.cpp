#include "serve/contract.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <regex>

namespace faceprobe::serve::testing {
namespace {

using Faults = std::vector<std::string>;

constexpr std::size_t kEnough = 20;  // faults of one list

bool is_of_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  if (type == "boolean") return value.is_boolean();
  return type == "null" && value.is_null();
}

bool is_of_types(const Json& value, const Json& types) {
  if (types.is_string()) return is_of_type(value, types.get_ref<const std::string&>());
  return std::ranges::any_of(types,
                             [&](const Json& type) { return is_of_type(value, type.get_ref<const std::string&>()); });
}

std::string shown_value(const Json& value) { return value.dump().substr(0, 60); }

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

void append(Faults& faults, const Faults& more) { faults.insert(faults.end(), more.begin(), more.end()); }

}  // namespace

Contract::Contract() : document_(Json::parse(std::ifstream(FACEPROBE_OPENAPI_FILE))) {}

std::vector<Contract::Operation> Contract::operations() const {
  std::vector<Operation> all;
  for (const auto& [path, methods] : document_.at("paths").items()) {
    for (const auto& [method, operation] : methods.items()) {
      std::string name = method;
      std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
      all.push_back({name, path});
    }
  }
  return all;
}

const Json& Contract::resolved(const Json& maybe_reference) const {
  const auto reference = maybe_reference.find("$ref");
  if (reference == maybe_reference.end()) return maybe_reference;
  return document_.at(Json::json_pointer(reference->get<std::string>().substr(1)));  // "#/components/..."
}

Faults Contract::faults(const Operation& operation, int status, const std::string& media_type,
                        const std::string& body) const {
  const Json& responses = document_.at("paths").at(operation.path).at(lower(operation.method)).at("responses");
  const std::string what = operation.method + " " + operation.path + " " + std::to_string(status);
  const auto listed = responses.find(std::to_string(status));
  if (listed == responses.end() && status != 403) return {what + " is not listed: " + body.substr(0, 200)};
  const Json& response =
      listed == responses.end() ? document_.at("components").at("responses").at("Failure") : resolved(*listed);
  const auto content = response.find("content");
  if (content == response.end()) return {};
  const auto medium = content->find(media_type);
  if (medium == content->end()) return {what + " came as '" + media_type + "'"};
  const Json value = Json::parse(body, nullptr, false);
  if (value.is_discarded()) return {what + " is no JSON: " + body.substr(0, 60)};
  return faults_of(value, medium->at("schema"), what);
}

Faults Contract::faults_of(const Json& value, const Json& maybe_reference, const std::string& at) const {
  const Json& schema = resolved(maybe_reference);
  Faults faults;
  if (const auto types = schema.find("type"); types != schema.end() && !is_of_types(value, *types))
    return {at + " is " + shown_value(value) + " instead of " + types->dump()};
  if (const auto allowed = schema.find("enum");
      allowed != schema.end() && std::ranges::find(*allowed, value) == allowed->end())
    faults.push_back(at + " is " + shown_value(value) + ", which is none of " + allowed->dump());
  if (const auto pattern = schema.find("pattern");
      pattern != schema.end() && !std::regex_search(value.get<std::string>(), std::regex(pattern->get<std::string>())))
    faults.push_back(at + " is " + shown_value(value) + ", which is not like " + pattern->dump());
  if (value.size() < schema.value("minItems", std::size_t{0}) || value.size() > schema.value("maxItems", value.size()))
    faults.push_back(at + " has " + std::to_string(value.size()) + " items");
  if (const auto required = schema.find("required"); required != schema.end()) {
    for (const Json& key : *required) {
      if (!value.contains(key.get<std::string>())) faults.push_back(at + " lacks " + key.dump());
    }
  }
  if (const auto properties = schema.find("properties"); properties != schema.end()) {
    for (const auto& [key, of_key] : value.items()) {
      if (const auto property = properties->find(key); property != properties->end()) {
        append(faults, faults_of(of_key, *property, at + "." + key));
      } else {  // what is answered is laid down, all of it
        faults.push_back(at + " has '" + key + "', of which nothing is said");
      }
    }
  }
  if (const auto items = schema.find("items"); items != schema.end()) {
    const std::string item = at + "[]";
    const bool plain = items->size() == 1 && items->contains("type");  // lists of numbers are long
    for (std::size_t i = 0; i < value.size() && faults.size() < kEnough; ++i) {
      if (!plain || !is_of_types(value[i], items->front())) append(faults, faults_of(value[i], *items, item));
    }
  }
  return faults;
}

}  // namespace faceprobe::serve::testing
