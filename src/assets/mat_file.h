#pragma once
// MATLAB's files, version 5 and 7.3 (matio reads both).

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string>

struct _mat_t;  // NOLINT(bugprone-reserved-identifier): matio's

namespace faceprobe::assets {

class MatFile {
 public:
  // Throws Error(kInput) when it is no MATLAB file.
  explicit MatFile(const std::filesystem::path& path);
  ~MatFile();
  MatFile(const MatFile&) = delete;
  MatFile& operator=(const MatFile&) = delete;

  const std::string& name() const { return name_; }  // quoted, for sentences
  // A real matrix of numbers. Throws Error(kInput): missing, of another kind, over 2 GiB, or of another size than asked for
  // (rows or columns < 0: any).
  Eigen::MatrixXf matrix(const std::string& variable, Eigen::Index rows = -1, Eigen::Index columns = -1) const;
  // A row or a column of numbers.
  Eigen::VectorXf vector(const std::string& variable, Eigen::Index count = -1) const;

 private:
  std::string name_;
  std::unique_ptr<_mat_t, void (*)(_mat_t*)> file_;
};

}  // namespace faceprobe::assets
