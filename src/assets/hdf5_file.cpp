#include "assets/hdf5_file.h"

#include <hdf5.h>
#include <memory>

namespace faceprobe::assets {
namespace {

constexpr hsize_t kMaxHdf5Values = 1ULL << 29;
constexpr std::size_t kMaxText = 16U << 20U;

// HDF5 prints what goes wrong unless it is told not to; while one of these lives it keeps still.
class Quiet {
 public:
  Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &handler_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, handler_, data_); }

 private:
  H5E_auto2_t handler_ = nullptr;
  void* data_ = nullptr;
};

class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  hid_t get() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

bool exists(hid_t file, const std::string& dataset) {
  for (std::size_t slash = dataset.find('/'); slash != std::string::npos; slash = dataset.find('/', slash + 1)) {
    if (H5Lexists(file, dataset.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return H5Lexists(file, dataset.c_str(), H5P_DEFAULT) > 0;
}

}  // namespace

Hdf5File::Hdf5File(const std::filesystem::path& path) : name_(quoted(path)) {
  const Quiet quiet;
  file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0) refuse_input(name_ + " cannot be read as an HDF5 file.");
}

Hdf5File::~Hdf5File() {
  const Quiet quiet;
  H5Fclose(file_);
}

bool Hdf5File::has(const std::string& dataset) const {
  const Quiet quiet;
  return exists(file_, dataset);
}

Array Hdf5File::array(const std::string& dataset) const {
  const Quiet quiet;
  const std::string what = name_ + ": '" + dataset + "'";
  if (!exists(file_, dataset)) refuse_input(what + " is missing.");
  const Handle data(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (!data.valid()) refuse_input(what + " is not an array.");
  const Handle type(H5Dget_type(data.get()), H5Tclose);
  const Handle space(H5Dget_space(data.get()), H5Sclose);
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) refuse_input(what + " does not hold numbers.");
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 0 || rank > 8) refuse_input(what + " has more than 8 dimensions.");
  hsize_t sides[8] = {};
  H5Sget_simple_extent_dims(space.get(), sides, nullptr);
  Array array;
  array.is_integer = kind == H5T_INTEGER;
  hsize_t count = 1;
  for (int i = 0; i < rank; ++i) {
    if (sides[i] != 0 && count > kMaxHdf5Values / sides[i]) refuse_input(what + " is larger than 2 GiB.");
    count *= sides[i];
    array.shape.push_back(static_cast<std::size_t>(sides[i]));
  }
  array.values.resize(static_cast<std::size_t>(count));
  if (H5Dread(data.get(), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()) < 0) {
    refuse_input(what + " cannot be read: the file is damaged there.");
  }
  return array;
}

std::string Hdf5File::text(const std::string& dataset) const {
  const Quiet quiet;
  if (!exists(file_, dataset)) return {};
  const Handle data(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (!data.valid()) return {};
  const Handle type(H5Dget_type(data.get()), H5Tclose);
  const Handle space(H5Dget_space(data.get()), H5Sclose);
  if (H5Tget_class(type.get()) != H5T_STRING || H5Sget_simple_extent_npoints(space.get()) != 1) return {};
  if (H5Tis_variable_str(type.get()) > 0) {
    char* written = nullptr;
    const Handle memory_type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(memory_type.get(), H5T_VARIABLE);
    H5Tset_cset(memory_type.get(), H5Tget_cset(type.get()));
    if (H5Dread(data.get(), memory_type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &written) < 0 || written == nullptr)
      return {};
    const std::unique_ptr<char, herr_t (*)(void*)> owner(written, H5free_memory);
    return written;
  }
  const std::size_t size = H5Tget_size(type.get());
  if (size > kMaxText) return {};
  std::string text(size, '\0');
  if (H5Dread(data.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0) return {};
  text.resize(text.find_last_not_of(std::string_view("\0 ", 2)) + 1);
  return text;
}

}  // namespace faceprobe::assets
