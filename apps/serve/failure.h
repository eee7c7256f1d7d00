#pragma once
// What went wrong, as clients are told: a kind that programs branch on and a sentence for people.

#include <nlohmann/json.hpp>

#include <exception>
#include <string>

namespace faceprobe::serve {

using Json = nlohmann::ordered_json;

enum class FailureKind {
  kUsage,
  kInput,
  kNoFace,
  kModel,
  kOutput,
  kDevice,
  kNotFound,
  kTooLarge,
  kWrongType,
  kNotReady,
  kBusy,
  kForbidden,
  kUnexpected,
};

struct Failure {
  FailureKind kind = FailureKind::kUnexpected;
  std::string sentence;
};

// What a handler throws to be answered with.
class Refusal : public std::exception {
 public:
  Refusal(FailureKind kind, std::string sentence) : failure_{kind, std::move(sentence)} {}
  const Failure& failure() const { return failure_; }
  const char* what() const noexcept override { return failure_.sentence.c_str(); }

 private:
  Failure failure_;
};

// As openapi.json has them, such as "no_face", and the HTTP status that goes with it.
std::string kind_name(FailureKind kind);
int http_status(FailureKind kind);
Json failure_json(const Failure& failure);
// Whatever was thrown; our own errors keep their sentences.
Failure failure_from(const std::exception_ptr& thrown);

}  // namespace faceprobe::serve
