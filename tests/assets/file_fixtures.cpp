#include "file_fixtures.h"

#include <hdf5.h>
#include <matio.h>
#include <zip.h>
#include <fstream>

namespace faceprobe::assets::testing {

void write_text(const std::filesystem::path& path, std::string_view text) {
  std::ofstream file(path, std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  ASSERT_TRUE(file.good()) << path;
}

std::string npy_text(const std::string& descr, const std::vector<std::size_t>& shape, std::span<const std::byte> values,
                     int version, bool fortran) {
  std::string header = "{'descr': '" + descr + "', 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': (";
  for (const std::size_t side : shape) header += std::to_string(side) + ", ";
  header += "), }\n";
  std::string text("\x93NUMPY");
  text += static_cast<char>(version);
  text += '\0';
  for (int i = 0; i < (version == 1 ? 2 : 4); ++i) text += static_cast<char>((header.size() >> (8 * i)) & 0xFFU);
  text += header;
  text.append(reinterpret_cast<const char*>(values.data()), values.size());
  return text;
}

void write_npz(const std::filesystem::path& path, const std::map<std::string, std::string>& entries) {
  int fault = 0;
  zip_t* archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &fault);
  ASSERT_NE(archive, nullptr);
  for (const auto& [name, text] : entries) {
    zip_source_t* source = zip_source_buffer(archive, text.data(), text.size(), 0);
    ASSERT_GE(zip_file_add(archive, (name + ".npy").c_str(), source, 0), 0);
  }
  ASSERT_EQ(zip_close(archive), 0);
}

void write_mat(const std::filesystem::path& path, const std::map<std::string, Eigen::MatrixXd>& variables,
               MatVersion version) {
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, version == MatVersion::k5 ? MAT_FT_MAT5 : MAT_FT_MAT73);
  ASSERT_NE(file, nullptr);
  for (const auto& [name, matrix] : variables) {
    std::size_t sides[2] = {static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())};
    matvar_t* variable =
        Mat_VarCreate(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, sides, const_cast<double*>(matrix.data()), 0);
    EXPECT_EQ(Mat_VarWrite(file, variable, MAT_COMPRESSION_NONE), 0);
    Mat_VarFree(variable);
  }
  Mat_Close(file);
}

void write_h5(const std::filesystem::path& path, const std::map<std::string, H5Data>& datasets) {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  const hid_t parents = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(parents, 1);
  for (const auto& [name, data] : datasets) {
    const bool integers = name.ends_with("cells");
    hid_t type = H5Tcopy(integers ? H5T_STD_I32LE : H5T_IEEE_F32LE);
    hid_t space = -1;
    if (!data.text.empty()) {
      H5Tclose(type);
      type = H5Tcopy(H5T_C_S1);
      H5Tset_size(type, H5T_VARIABLE);
      space = H5Screate(H5S_SCALAR);
    } else {
      const std::vector<hsize_t> sides(data.shape.begin(), data.shape.end());
      space = H5Screate_simple(static_cast<int>(sides.size()), sides.data(), nullptr);
    }
    const hid_t set = H5Dcreate2(file, name.c_str(), type, space, parents, H5P_DEFAULT, H5P_DEFAULT);
    const char* text = data.text.c_str();
    const herr_t fault = data.text.empty()
                             ? H5Dwrite(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.numbers.data())
                             : H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, static_cast<const void*>(&text));
    EXPECT_GE(fault, 0) << name;
    H5Dclose(set);
    H5Sclose(space);
    H5Tclose(type);
  }
  H5Pclose(parents);
  H5Fclose(file);
}

}  // namespace faceprobe::assets::testing
