#include "serve/failure.h"

#include "faceprobe/core/error.h"

#include <new>

namespace faceprobe::serve {
namespace {

FailureKind kind_of(ExitCode code) {
  switch (code) {
    case ExitCode::kUsage: return FailureKind::kUsage;
    case ExitCode::kInput: return FailureKind::kInput;
    case ExitCode::kNoFace: return FailureKind::kNoFace;
    case ExitCode::kModel: return FailureKind::kModel;
    case ExitCode::kOutput: return FailureKind::kOutput;
    case ExitCode::kDevice: return FailureKind::kDevice;
    default: return FailureKind::kUnexpected;
  }
}

}  // namespace

std::string kind_name(FailureKind kind) {
  switch (kind) {
    case FailureKind::kUsage: return "usage";
    case FailureKind::kInput: return "input";
    case FailureKind::kNoFace: return "no_face";
    case FailureKind::kModel: return "model";
    case FailureKind::kOutput: return "output";
    case FailureKind::kDevice: return "device";
    case FailureKind::kNotFound: return "not_found";
    case FailureKind::kTooLarge: return "too_large";
    case FailureKind::kWrongType: return "wrong_type";
    case FailureKind::kNotReady: return "not_ready";
    case FailureKind::kBusy: return "busy";
    case FailureKind::kForbidden: return "forbidden";
    default: return "unexpected";
  }
}

int http_status(FailureKind kind) {
  switch (kind) {
    case FailureKind::kUsage: return 400;
    case FailureKind::kForbidden: return 403;
    case FailureKind::kNotFound: return 404;
    case FailureKind::kNotReady: return 409;
    case FailureKind::kTooLarge: return 413;
    case FailureKind::kWrongType: return 415;
    case FailureKind::kInput:
    case FailureKind::kNoFace: return 422;
    case FailureKind::kBusy: return 503;
    default: return 500;
  }
}

Json failure_json(const Failure& failure) {
  return {{"error", {{"kind", kind_name(failure.kind)}, {"message", failure.sentence}}}};
}

Failure failure_from(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const Refusal& refusal) {
    return refusal.failure();
  } catch (const Error& error) {
    return {kind_of(error.code()), error.what()};
  } catch (const std::bad_alloc&) {
    return {FailureKind::kInput, "The memory did not suffice; try a smaller photo."};
  } catch (const std::exception& error) {
    return {FailureKind::kUnexpected,
            "Unexpected: " + std::string(error.what()) + ". This is a bug; please report it with the photo."};
  } catch (...) {
    return {FailureKind::kUnexpected, "Unexpected: something that says nothing of itself. This is a bug."};
  }
}

}  // namespace faceprobe::serve
