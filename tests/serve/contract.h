#pragma once
// openapi.json, and whether answers are as it lays down. Of JSON Schema what that file uses: $ref, type, enum, required, properties, items,
// minItems, maxItems, pattern.

#include "serve/failure.h"

#include <string>
#include <vector>

namespace faceprobe::serve::testing {

class Contract {
 public:
  Contract();  // the repository's
  explicit Contract(Json document) : document_(std::move(document)) {}

  struct Operation {
    std::string method;  // "GET"
    std::string path;    // "/estimates/{id}"
  };
  std::vector<Operation> operations() const;

  // Sentences; empty when the answer is as it should be. Everything may be forbidden.
  std::vector<std::string> faults(const Operation& operation, int status, const std::string& media_type,
                                  const std::string& body) const;
  // Of a value against a schema. `at`: what the sentences call it.
  std::vector<std::string> faults_of(const Json& value, const Json& schema, const std::string& at) const;
  const Json& schema(const std::string& name) const { return document_.at("components").at("schemas").at(name); }

 private:
  const Json& resolved(const Json& maybe_reference) const;
  Json document_;
};

}  // namespace faceprobe::serve::testing
