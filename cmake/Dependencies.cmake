find_package(Threads REQUIRED)
if(FACEPROBE_CARRIED)
  include(Carried)
else()
  find_package(embree 3.13 REQUIRED)
  find_package(Eigen3 3.4 REQUIRED NO_MODULE)
  find_package(nlohmann_json 3.11 REQUIRED)
  find_package(nanoflann 1.4 REQUIRED)
  find_package(CLI11 2.1 REQUIRED)
  find_package(spdlog 1.10 REQUIRED)
endif()
if(NOT FACEPROBE_LEAN)
  find_package(OpenCV 4.5 REQUIRED COMPONENTS core imgproc calib3d)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(LCMS2 REQUIRED IMPORTED_TARGET lcms2)
  # By pkg-config: Debian's CMake files for OpenImageIO also demand its command-line tools, which nothing here uses.
  pkg_check_modules(OPENIMAGEIO REQUIRED IMPORTED_TARGET OpenImageIO>=2.4)
endif()

# The packages that scripts/setup.sh unpacks: TensorFlow Lite's C library and the face models.
set(FACEPROBE_DEPS_DIR ${PROJECT_SOURCE_DIR}/.deps CACHE PATH "Where scripts/setup.sh unpacked its packages")
if(NOT EXISTS ${FACEPROBE_DEPS_DIR}/tflite/libtensorflowlite_c.so)
  message(FATAL_ERROR "TensorFlow Lite is not in ${FACEPROBE_DEPS_DIR}. Run scripts/setup.sh first.")
endif()
add_library(tensorflowlite_c SHARED IMPORTED)
set_target_properties(tensorflowlite_c PROPERTIES
  IMPORTED_LOCATION ${FACEPROBE_DEPS_DIR}/tflite/libtensorflowlite_c.so
  IMPORTED_NO_SONAME ON
  INTERFACE_INCLUDE_DIRECTORIES ${FACEPROBE_DEPS_DIR}/tflite/include)
