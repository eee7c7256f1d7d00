#include "commands.h"

#include "faceprobe/core/error.h"

#include <spdlog/spdlog.h>

#include <exception>
#include <new>

namespace faceprobe::cli {

int run_guarded(const Action& action) {
  try {
    return action();
  } catch (const Error& error) {
    spdlog::error("{}", error.what());
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    spdlog::error("The memory did not suffice; try a smaller photo or --max-pixels.");
    return static_cast<int>(ExitCode::kUnexpected);
  } catch (const std::exception& error) {
    spdlog::error("Unexpected: {}. This is a bug; please report it with the command and the photo.", error.what());
    return static_cast<int>(ExitCode::kUnexpected);
  }
}

}  // namespace faceprobe::cli
