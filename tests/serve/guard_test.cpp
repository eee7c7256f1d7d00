#include "serve/guard.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace faceprobe::serve {
namespace {

constexpr int kPort = 8765;

std::string fault_of(const std::string& host, const std::string& origin, int port = kPort) {
  return fault_of_caller({.host = host, .origin = origin}, port);
}

// What a browser sends along with a request that a page of `site` made it send.
Caller sent_by(const std::string& site, const std::string& mode, const std::string& dest, bool gets_front_page) {
  return {.host = "127.0.0.1:8765",
          .fetch_site = site,
          .fetch_mode = mode,
          .fetch_dest = dest,
          .gets_front_page = gets_front_page};
}

TEST(Guard, OwnNamesMayAsk) {
  for (const std::string host : {"127.0.0.1:8765", "localhost:8765", "[::1]:8765"}) {
    EXPECT_EQ(fault_of(host, ""), "") << host;
    EXPECT_EQ(fault_of(host, "http://" + host), "") << host;
  }
  // A page that was opened by one own name may ask by another.
  EXPECT_EQ(fault_of("127.0.0.1:8765", "http://localhost:8765"), "");
}

TEST(Guard, OtherHostsMayNot) {
  for (const std::string host :
       {"", "127.0.0.1", "localhost", "127.0.0.1:8766", "127.0.0.1:87650", "evil.example", "evil.example:8765",
        "127.0.0.1.evil.example:8765", "evil.example/127.0.0.1:8765", "127.0.0.1:8765.evil.example",
        "user@127.0.0.1:8765", "0.0.0.0:8765", "127.0.0.2:8765", " 127.0.0.1:8765", "127.0.0.1:8765 "}) {
    const std::string fault = fault_of(host, "");
    EXPECT_NE(fault.find("127.0.0.1:8765"), std::string::npos) << "'" << host << "': " << fault;
    EXPECT_NE(fault.find("'" + host + "'"), std::string::npos) << fault;
  }
}

TEST(Guard, OtherOriginsMayNot) {
  for (const std::string origin : {"null", "http://evil.example", "http://evil.example:8765", "https://127.0.0.1:8765",
                                   "http://127.0.0.1", "http://127.0.0.1:8766", "http://127.0.0.1:8765.evil.example",
                                   "127.0.0.1:8765", "file://", "http://127.0.0.1:8765/", "HTTP://evil.example"}) {
    const std::string fault = fault_of("127.0.0.1:8765", origin);
    EXPECT_NE(fault.find(origin), std::string::npos) << "'" << origin << "': " << fault;
    EXPECT_NE(fault.find("http://127.0.0.1:8765/"), std::string::npos) << fault;
  }
}

// An own Origin does not make up for a foreign Host: that is how a bent name comes.
TEST(Guard, BothMustBeOwn) {
  EXPECT_NE(fault_of("evil.example:8765", "http://127.0.0.1:8765"), "");
  EXPECT_NE(fault_of("evil.example:8765", "http://evil.example:8765"), "");
}

// Browsers leave the port of http out.
TEST(Guard, Port80IsNotSaid) {
  EXPECT_EQ(fault_of("127.0.0.1", "http://127.0.0.1", 80), "");
  EXPECT_EQ(fault_of("localhost:80", "", 80), "");
  EXPECT_NE(fault_of("evil.example", "", 80), "");
  EXPECT_NE(fault_of("127.0.0.1", "http://evil.example", 80), "");
}

TEST(Guard, WhatOtherPagesAskForIsRefusedWithoutAnOriginToo) {
  for (const std::string site : {"cross-site", "same-site", "something new"}) {
    for (const bool front : {false, true}) {
      for (const auto& [mode, dest] :
           {std::pair("no-cors", "image"), std::pair("no-cors", "script"), std::pair("cors", "empty"),
            std::pair("websocket", "websocket"), std::pair("navigate", "iframe"), std::pair("navigate", "object"),
            std::pair("", "")}) {
        const std::string fault = fault_of_caller(sent_by(site, mode, dest, front), kPort);
        EXPECT_NE(fault.find("http://127.0.0.1:8765/"), std::string::npos) << site << ' ' << mode << ' ' << dest;
      }
    }
  }
}

TEST(Guard, OtherPagesMayLinkToTheFrontPageAlone) {
  for (const std::string site : {"cross-site", "same-site"}) {
    EXPECT_EQ(fault_of_caller(sent_by(site, "navigate", "document", true), kPort), "") << site;
    EXPECT_NE(fault_of_caller(sent_by(site, "navigate", "document", false), kPort), "") << site;
  }
  Caller bent = sent_by("cross-site", "navigate", "document", true);
  bent.host = "evil.example:8765";
  EXPECT_NE(fault_of_caller(bent, kPort), "");
}

TEST(Guard, TheOwnPageAndThePersonAtTheBrowserMayAskForAnything) {
  for (const bool front : {false, true}) {
    EXPECT_EQ(fault_of_caller(sent_by("same-origin", "cors", "empty", front), kPort), "");
    EXPECT_EQ(fault_of_caller(sent_by("same-origin", "no-cors", "image", front), kPort), "");
    EXPECT_EQ(fault_of_caller(sent_by("none", "navigate", "document", front), kPort), "");
  }
}

// Nothing of the page may come from elsewhere or be shown inside another.
TEST(Guard, ThePolicyLetsNothingElseIn) {
  const std::string policy = kContentSecurityPolicy;
  for (const char* part : {"default-src 'self'", "object-src 'none'", "base-uri 'none'", "frame-ancestors 'none'"})
    EXPECT_NE(policy.find(part), std::string::npos) << part;
  for (const char* part : {"unsafe", "http:", "https:", "*"}) EXPECT_EQ(policy.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace faceprobe::serve
