#include "assets/mat_file.h"

#include "assets/array.h"

#include <matio.h>
#include <cstdint>

namespace faceprobe::assets {
namespace {

constexpr std::size_t kMaxValues = 1ULL << 29;

struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

template <class T>
Eigen::MatrixXf as_float(const matvar_t& variable) {
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;  // MATLAB stores by columns, as Eigen does
  return Eigen::Map<const Matrix>(static_cast<const T*>(variable.data), static_cast<Eigen::Index>(variable.dims[0]),
                                  static_cast<Eigen::Index>(variable.dims[1]))
      .template cast<float>();
}

std::string size_text(Eigen::Index rows, Eigen::Index columns) {
  std::string text = rows < 0 ? std::string("any") : std::to_string(rows);
  text += " x ";
  text += columns < 0 ? std::string("any") : std::to_string(columns);
  return text;
}

}  // namespace

MatFile::MatFile(const std::filesystem::path& path)
    : name_(quoted(path)), file_(Mat_Open(path.c_str(), MAT_ACC_RDONLY), [](_mat_t* file) { Mat_Close(file); }) {
  if (!file_) refuse_input(name_ + " cannot be read as a MATLAB file; version 5 and 7.3 are read.");
}

MatFile::~MatFile() = default;

Eigen::MatrixXf MatFile::matrix(const std::string& variable, Eigen::Index rows, Eigen::Index columns) const {
  const std::string what = name_ + ": '" + variable + "'";
  const Variable info(Mat_VarReadInfo(file_.get(), variable.c_str()));
  if (!info) refuse_input(what + " is missing.");
  if (info->rank != 2 || info->isComplex != 0) refuse_input(what + " is not a plain matrix.");
  if (info->dims[0] != 0 && info->dims[1] > kMaxValues / info->dims[0]) refuse_input(what + " is larger than 2 GiB.");
  const Variable read(Mat_VarRead(file_.get(), variable.c_str()));
  if (!read || read->data == nullptr) refuse_input(what + " cannot be read: the file is damaged or empty there.");
  const auto convert = [&]() -> Eigen::MatrixXf {
    switch (read->class_type) {
      case MAT_C_DOUBLE: return as_float<double>(*read);
      case MAT_C_SINGLE: return as_float<float>(*read);
      case MAT_C_INT32: return as_float<std::int32_t>(*read);
      case MAT_C_UINT32: return as_float<std::uint32_t>(*read);
      case MAT_C_INT16: return as_float<std::int16_t>(*read);
      case MAT_C_UINT16: return as_float<std::uint16_t>(*read);
      case MAT_C_INT8: return as_float<std::int8_t>(*read);
      case MAT_C_UINT8: return as_float<std::uint8_t>(*read);
      default: refuse_input(what + " does not hold numbers.");
    }
  };
  Eigen::MatrixXf result = convert();
  if ((rows >= 0 && result.rows() != rows) || (columns >= 0 && result.cols() != columns)) {
    refuse_input(what + " is " + size_text(result.rows(), result.cols()) + "; " + size_text(rows, columns) +
                 " is needed.");
  }
  return result;
}

Eigen::VectorXf MatFile::vector(const std::string& variable, Eigen::Index count) const {
  const Eigen::MatrixXf values = matrix(variable);
  if ((values.rows() != 1 && values.cols() != 1) || (count >= 0 && values.size() != count)) {
    refuse_input(name_ + ": '" + variable + "' is " + size_text(values.rows(), values.cols()) + "; " +
                 (count < 0 ? std::string("a row or column") : std::to_string(count) + " numbers") + " are needed.");
  }
  return values.reshaped();
}

}  // namespace faceprobe::assets
