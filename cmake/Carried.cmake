# Libraries out of the folder FACEPROBE_CARRIED, as `scripts/train_gpu.sh pack` lays it out, by the names that their own packages give them:
#   include/  Eigen, embree3, nlohmann, CLI, spdlog, fmt, nanoflann.hpp
#   lib/      libembree3.so.3, libtbb.so.12
#   tflite/, data/   as in .deps
if(NOT EXISTS ${FACEPROBE_CARRIED}/lib/libembree3.so.3)
  message(FATAL_ERROR "FACEPROBE_CARRIED is ${FACEPROBE_CARRIED}, which has no lib/libembree3.so.3. Name the folder `carried` of an unpacked pack.")
endif()
set(FACEPROBE_DEPS_DIR ${FACEPROBE_CARRIED} CACHE PATH "" FORCE)

foreach(_name Eigen3::Eigen nlohmann_json::nlohmann_json nanoflann::nanoflann CLI11::CLI11 spdlog::spdlog)
  add_library(${_name} INTERFACE IMPORTED)
  set_target_properties(${_name} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${FACEPROBE_CARRIED}/include)
endforeach()
# All in headers: no libspdlog, no libfmt.
set_target_properties(spdlog::spdlog PROPERTIES
  INTERFACE_COMPILE_DEFINITIONS "SPDLOG_FMT_EXTERNAL;FMT_HEADER_ONLY" INTERFACE_LINK_LIBRARIES Threads::Threads)

add_library(embree SHARED IMPORTED)
set_target_properties(embree PROPERTIES
  IMPORTED_LOCATION ${FACEPROBE_CARRIED}/lib/libembree3.so.3
  INTERFACE_INCLUDE_DIRECTORIES ${FACEPROBE_CARRIED}/include
  # Embree asks for libtbb by name alone.
  INTERFACE_LINK_OPTIONS "LINKER:-rpath-link,${FACEPROBE_CARRIED}/lib")
