#include "serve/guard.h"

#include <gtest/gtest.h>

namespace faceprobe::serve {
namespace {

constexpr int kPort = 8765;

TEST(Guard, OwnNamesMayAsk) {
  for (const std::string host : {"127.0.0.1:8765", "localhost:8765", "[::1]:8765"}) {
    EXPECT_EQ(fault_of_caller(host, "", kPort), "") << host;
    EXPECT_EQ(fault_of_caller(host, "http://" + host, kPort), "") << host;
  }
  // A page that was opened by one own name may ask by another.
  EXPECT_EQ(fault_of_caller("127.0.0.1:8765", "http://localhost:8765", kPort), "");
}

TEST(Guard, OtherHostsMayNot) {
  for (const std::string host :
       {"", "127.0.0.1", "localhost", "127.0.0.1:8766", "127.0.0.1:87650", "evil.example", "evil.example:8765",
        "127.0.0.1.evil.example:8765", "evil.example/127.0.0.1:8765", "127.0.0.1:8765.evil.example",
        "user@127.0.0.1:8765", "0.0.0.0:8765", "127.0.0.2:8765", " 127.0.0.1:8765", "127.0.0.1:8765 "}) {
    const std::string fault = fault_of_caller(host, "", kPort);
    EXPECT_NE(fault.find("127.0.0.1:8765"), std::string::npos) << "'" << host << "': " << fault;
    EXPECT_NE(fault.find("'" + host + "'"), std::string::npos) << fault;
  }
}

TEST(Guard, OtherOriginsMayNot) {
  for (const std::string origin : {"null", "http://evil.example", "http://evil.example:8765", "https://127.0.0.1:8765",
                                   "http://127.0.0.1", "http://127.0.0.1:8766", "http://127.0.0.1:8765.evil.example",
                                   "127.0.0.1:8765", "file://", "http://127.0.0.1:8765/", "HTTP://evil.example"}) {
    const std::string fault = fault_of_caller("127.0.0.1:8765", origin, kPort);
    EXPECT_NE(fault.find(origin), std::string::npos) << "'" << origin << "': " << fault;
    EXPECT_NE(fault.find("http://127.0.0.1:8765/"), std::string::npos) << fault;
  }
}

// An own Origin does not make up for a foreign Host: that is how a bent name comes.
TEST(Guard, BothMustBeOwn) {
  EXPECT_NE(fault_of_caller("evil.example:8765", "http://127.0.0.1:8765", kPort), "");
  EXPECT_NE(fault_of_caller("evil.example:8765", "http://evil.example:8765", kPort), "");
}

// Browsers leave the port of http out.
TEST(Guard, Port80IsNotSaid) {
  EXPECT_EQ(fault_of_caller("127.0.0.1", "http://127.0.0.1", 80), "");
  EXPECT_EQ(fault_of_caller("localhost:80", "", 80), "");
  EXPECT_NE(fault_of_caller("evil.example", "", 80), "");
  EXPECT_NE(fault_of_caller("127.0.0.1", "http://evil.example", 80), "");
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
