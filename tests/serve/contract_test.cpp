#include "serve/contract.h"

#include "serve/describe.h"
#include "serve/running_server.h"

#include "faceprobe/render/shapes.h"

namespace faceprobe::serve::testing {
namespace {

using ContractOverHttp = ServerTest;

constexpr const char* kNobodysId = "0123456789abcdef";

std::string filled(std::string path) {
  for (const auto& [part, value] : {std::pair<std::string, std::string>{"{id}", kNobodysId},
                                    {"{name}", path.starts_with("/objects") ? "cube" : "nobody"},
                                    {"{path}", "report.json"}}) {
    if (const std::size_t at = path.find(part); at != std::string::npos) path.replace(at, part.size(), value);
  }
  return path;
}

httplib::Response sent(const RunningServer& server, const Contract::Operation& operation) {
  const std::string address = filled(operation.path);
  if (operation.method == "GET") return server.get(address);
  if (operation.method == "DELETE") return server.remove(address);
  EXPECT_EQ(operation.method, "POST");
  return server.post_json(address,
                          address.ends_with("/insertions") ? Json{{"object", "cube"}} : Json{{"sample", "nobody"}});
}

TEST_F(ContractOverHttp, EveryOperationIsThereAndAnswersAsLaidDown) {
  const Contract contract;
  const RunningServer server;
  const auto operations = contract.operations();
  ASSERT_GE(operations.size(), 15U);
  for (const Contract::Operation& operation : operations) {
    const httplib::Response response = sent(server, operation);
    EXPECT_EQ(response.body.find("There is nothing at"), std::string::npos) << operation.method << operation.path;
    EXPECT_EQ(contract.faults(operation, response.status, response.get_header_value("Content-Type"), response.body),
              std::vector<std::string>())
        << operation.method << ' ' << operation.path;
  }
}

TEST_F(ContractOverHttp, WhatIsNotInItIsNotThere) {
  const RunningServer server;
  expect_failure(server.get("/nothing"), 404, "not_found", "There is nothing at /api/v1/nothing");
  expect_failure(server.remove("/estimates"), 404, "not_found", "There is nothing at");
  expect_failure(server.post_json("/info", Json::object()), 404, "not_found", "There is nothing at");
  expect_failure(server.get("/estimates/0123456789ABCDEF"), 404, "not_found", "There is nothing at");
  expect_failure(server.get("/estimates/0123456789abcdef0"), 404, "not_found", "There is nothing at");
}

TEST_F(ContractOverHttp, EveryObjectIsThere) {
  const Contract contract;
  const RunningServer server;
  const Json info = json_of(server.get("/info"));
  EXPECT_EQ(info["objects"], Json(render::shape_names()));
  for (const std::string name : info["objects"]) {
    const httplib::Response response = server.get("/objects/" + name);
    EXPECT_EQ(response.status, 200) << name;
    EXPECT_TRUE(response.body.starts_with("{\"name\":\"" + name + "\"")) << response.body.substr(0, 80);
    if (name != "cube") continue;  // some have a great many numbers
    EXPECT_EQ(contract.faults({"GET", "/objects/{name}"}, 200, response.get_header_value("Content-Type"), response.body),
              std::vector<std::string>());
  }
}

// A checker that finds nothing is worth nothing: each fault is planted alone.
TEST(ContractChecker, FindsEachFault) {
  const Contract contract;
  const Json material = material_json(render::material_preset("gold"));
  const Json& schema = contract.schema("Material");
  EXPECT_EQ(contract.faults_of(material, schema, "it"), std::vector<std::string>());
  const auto count = [&](const auto& change) {
    Json changed = material;
    change(changed);
    return contract.faults_of(changed, schema, "it").size();
  };
  EXPECT_EQ(count([](Json& json) { json.erase("kind"); }), 1U);
  EXPECT_EQ(count([](Json& json) { json["kind"] = "wood"; }), 1U);
  EXPECT_EQ(count([](Json& json) { json["roughness"] = "rough"; }), 1U);
  EXPECT_EQ(count([](Json& json) { json["colour_rgb"][1] = nullptr; }), 1U);
  EXPECT_EQ(count([](Json& json) { json["colour_rgb"] = 1; }), 1U);
  EXPECT_EQ(count([](Json& json) { json["weight"] = 1; }), 1U);
  EXPECT_EQ(contract.faults_of(3, schema, "it").size(), 1U);
  // Through a reference and through a list.
  const Json summary = {{"id", "x"}, {"name", "y"}, {"job", {{"state", "asleep"}, {"elapsed_seconds", 0}}}};
  EXPECT_EQ(contract.faults_of(summary, contract.schema("EstimateSummary"), "it").size(), 1U);
  EXPECT_EQ(
      contract.faults_of(Json{{1.0, 2.0, 3.0}}, contract.schema("InsertionRequest")["properties"]["at_px"], "it").size(),
      2U);  // a list in a list: how many there are, and what it is
}

TEST(ContractChecker, JudgesStatusAndMedium) {
  const Contract contract;
  const Contract::Operation estimate{"GET", "/estimates/{id}"};
  const std::string refusal = failure_json({FailureKind::kNotFound, "Gone."}).dump();
  const auto count = [&](int status, const std::string& medium, const std::string& body) {
    return contract.faults(estimate, status, medium, body).size();
  };
  EXPECT_EQ(count(404, "application/json", refusal), 0U);
  EXPECT_EQ(count(403, "application/json", refusal), 0U);
  EXPECT_EQ(count(500, "application/json", refusal), 1U);
  EXPECT_EQ(count(404, "text/plain", refusal), 1U);
  EXPECT_EQ(count(404, "application/json", "Gone."), 1U);
  EXPECT_EQ(count(404, "application/json", R"({"error": "Gone."})"), 1U);
}

}  // namespace
}  // namespace faceprobe::serve::testing
