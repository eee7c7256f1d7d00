#pragma once
// Expects an Error with its exit code, and that its sentence says what it must.

#include "faceprobe/core/error.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace faceprobe::testing {

// Runs `body`; expects faceprobe::Error with this code whose sentence contains all of `parts`.
template <class Body>
void expect_error(ExitCode code, const std::vector<std::string>& parts, const Body& body) {
  try {
    body();
    ADD_FAILURE() << "no Error was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    for (const std::string& part : parts) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
          << "'" << part << "' is not in: " << error.what();
    }
  }
}

}  // namespace faceprobe::testing
