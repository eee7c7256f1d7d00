# `cmake --install`: the rooms as static libraries with their public headers, the command, TensorFlow Lite's library, the
# face models, and a CMake package, so that another project writes
#   find_package(faceprobe CONFIG REQUIRED)
#   target_link_libraries(mine PRIVATE faceprobe::core)
# The installed folder can be moved: nothing in it names the source or the build folder.
include(CMakePackageConfigHelpers)

get_property(FACEPROBE_ROOMS GLOBAL PROPERTY FACEPROBE_ROOMS)
set(FACEPROBE_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/faceprobe)

# Eigen's alignment follows the instruction set, and a matrix allocated under one alignment and freed under another is a
# crash. Users need not compile with our -march, but have to align as we do.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(FACEPROBE_EIGEN_ALIGNMENT 32)
  if(FACEPROBE_NATIVE)
    include(CheckCXXSourceCompiles)
    set(CMAKE_REQUIRED_FLAGS -march=native)
    check_cxx_source_compiles("#ifndef __AVX512F__\n#error\n#endif\nint main() {}" FACEPROBE_NATIVE_IS_AVX512)
    check_cxx_source_compiles("#ifndef __AVX__\n#error\n#endif\nint main() {}" FACEPROBE_NATIVE_IS_AVX)
    unset(CMAKE_REQUIRED_FLAGS)
    if(FACEPROBE_NATIVE_IS_AVX512)
      set(FACEPROBE_EIGEN_ALIGNMENT 64)
    elseif(NOT FACEPROBE_NATIVE_IS_AVX)
      set(FACEPROBE_EIGEN_ALIGNMENT 16)
    endif()
  endif()
  target_compile_definitions(faceprobe_core INTERFACE EIGEN_MAX_ALIGN_BYTES=${FACEPROBE_EIGEN_ALIGNMENT})
endif()

file(RELATIVE_PATH _lib_from_bin ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
set_target_properties(faceprobe PROPERTIES INSTALL_RPATH "$ORIGIN/${_lib_from_bin}")

install(TARGETS ${FACEPROBE_ROOMS} EXPORT faceprobeTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS faceprobe RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/faceprobe DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h")
install(PROGRAMS ${FACEPROBE_DEPS_DIR}/tflite/libtensorflowlite_c.so DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES
  ${FACEPROBE_DEPS_DIR}/data/face_landmark.tflite
  ${FACEPROBE_DEPS_DIR}/data/face_detection_short_range.tflite
  ${FACEPROBE_DEPS_DIR}/data/face_detection_full_range.tflite
  ${FACEPROBE_DEPS_DIR}/data/canonical-face-model.obj
  DESTINATION ${CMAKE_INSTALL_DATADIR}/faceprobe)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/models/ DESTINATION ${CMAKE_INSTALL_DATADIR}/faceprobe FILES_MATCHING PATTERN "*.safetensors")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/THIRD_PARTY.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT faceprobeTargets NAMESPACE faceprobe:: DESTINATION ${FACEPROBE_PACKAGE_DIR})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/faceprobeConfig.cmake.in
  ${PROJECT_BINARY_DIR}/cmake/faceprobeConfig.cmake
  INSTALL_DESTINATION ${FACEPROBE_PACKAGE_DIR}
  PATH_VARS CMAKE_INSTALL_LIBDIR CMAKE_INSTALL_DATADIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cmake/faceprobeConfigVersion.cmake
  COMPATIBILITY SameMajorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/cmake/faceprobeConfig.cmake
  ${PROJECT_BINARY_DIR}/cmake/faceprobeConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/FindOpenCV.cmake
  DESTINATION ${FACEPROBE_PACKAGE_DIR})
