#include "face/tflite_model.h"

#include "faceprobe/core/error.h"

#include <tensorflow/lite/c/c_api.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <string>

namespace faceprobe::face {
namespace {

struct Delete {
  void operator()(TfLiteModel* model) const { TfLiteModelDelete(model); }
  void operator()(TfLiteInterpreterOptions* options) const { TfLiteInterpreterOptionsDelete(options); }
  void operator()(TfLiteInterpreter* interpreter) const { TfLiteInterpreterDelete(interpreter); }
};

std::vector<char> file_bytes(const std::filesystem::path& path) {
  constexpr std::uintmax_t kMaxBytes = 256U << 20U;
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(path, failure);
  if (failure || size > kMaxBytes) return {};
  std::vector<char> bytes(static_cast<std::size_t>(size));
  std::ifstream file(path, std::ios::binary);
  if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) return {};
  return bytes;
}

// The library would print a sentence of its own to stderr; ours travels in the exception.
void swallow(void*, const char*, va_list) {}

std::string shape_text(const std::vector<int>& shape) {
  std::string text;
  for (const int size : shape) {
    if (!text.empty()) text.push_back('x');
    text.append(std::to_string(size));
  }
  return text;
}

}  // namespace

struct TfliteModel::Impl {
  std::string name;
  std::vector<char> bytes;  // the network's weights stay in here
  std::unique_ptr<TfLiteModel, Delete> model;
  std::unique_ptr<TfLiteInterpreter, Delete> interpreter;

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ExitCode::kModel, "The model file '" + name + "' " + what + "; run scripts/setup.sh to fetch it again.");
  }
};

TfliteModel::TfliteModel(const std::filesystem::path& path, const std::vector<int>& input_shape)
    : impl_(std::make_unique<Impl>()) {
  impl_->name = path.string();
  impl_->bytes = file_bytes(path);
  if (impl_->bytes.empty()) impl_->fail("cannot be read");
  // A flatbuffer's file identifier follows its root offset.
  if (impl_->bytes.size() < 8 || std::memcmp(impl_->bytes.data() + 4, "TFL3", 4) != 0) {
    impl_->fail("is not a TensorFlow Lite network");
  }
  impl_->model.reset(TfLiteModelCreate(impl_->bytes.data(), impl_->bytes.size()));
  if (!impl_->model) impl_->fail("is damaged");
  const std::unique_ptr<TfLiteInterpreterOptions, Delete> options(TfLiteInterpreterOptionsCreate());
  TfLiteInterpreterOptionsSetNumThreads(options.get(), 1);
  TfLiteInterpreterOptionsSetErrorReporter(options.get(), swallow, nullptr);
  impl_->interpreter.reset(TfLiteInterpreterCreate(impl_->model.get(), options.get()));
  if (!impl_->interpreter || TfLiteInterpreterAllocateTensors(impl_->interpreter.get()) != kTfLiteOk) {
    impl_->fail("needs operations that this program lacks");
  }
  if (TfLiteInterpreterGetInputTensorCount(impl_->interpreter.get()) != 1) impl_->fail("has more than one input");
  const TfLiteTensor* tensor = TfLiteInterpreterGetInputTensor(impl_->interpreter.get(), 0);
  std::vector<int> shape(static_cast<std::size_t>(std::max(0, TfLiteTensorNumDims(tensor))));
  for (std::size_t i = 0; i < shape.size(); ++i) shape[i] = TfLiteTensorDim(tensor, static_cast<int>(i));
  if (TfLiteTensorType(tensor) != kTfLiteFloat32 || shape != input_shape) {
    impl_->fail("takes a tensor of " + shape_text(shape) + " instead of float " + shape_text(input_shape));
  }
}

TfliteModel::~TfliteModel() = default;
TfliteModel::TfliteModel(TfliteModel&&) noexcept = default;
TfliteModel& TfliteModel::operator=(TfliteModel&&) noexcept = default;

std::span<float> TfliteModel::input() {
  TfLiteTensor* tensor = TfLiteInterpreterGetInputTensor(impl_->interpreter.get(), 0);
  return {static_cast<float*>(TfLiteTensorData(tensor)), TfLiteTensorByteSize(tensor) / sizeof(float)};
}

void TfliteModel::run() {
  if (TfLiteInterpreterInvoke(impl_->interpreter.get()) != kTfLiteOk) impl_->fail("did not run");
}

std::span<const float> TfliteModel::output(std::size_t values) const {
  const TfLiteInterpreter* interpreter = impl_->interpreter.get();
  for (int i = 0; i < TfLiteInterpreterGetOutputTensorCount(interpreter); ++i) {
    const TfLiteTensor* tensor = TfLiteInterpreterGetOutputTensor(interpreter, i);
    if (TfLiteTensorType(tensor) == kTfLiteFloat32 && TfLiteTensorByteSize(tensor) == values * sizeof(float)) {
      return {static_cast<const float*>(TfLiteTensorData(tensor)), values};
    }
  }
  impl_->fail("has no output of " + std::to_string(values) + " values");
}

}  // namespace faceprobe::face
