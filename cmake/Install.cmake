# `cmake --install`: the rooms as static libraries with their public headers, the command, TensorFlow Lite's library, the
# face models, and a CMake package, so that another project writes
#   find_package(faceprobe CONFIG REQUIRED)
#   target_link_libraries(mine PRIVATE faceprobe::core)
# The installed folder can be moved: nothing in it names the source or the build folder. Every rule belongs to a component, which Package.cmake
# makes into packages: `faceprobe` is what the command needs to run, `libfaceprobe-dev` what other projects build with, `notices` the texts that
# Debian has in a file of its own.
include(CMakePackageConfigHelpers)

get_property(FACEPROBE_ROOMS GLOBAL PROPERTY FACEPROBE_ROOMS)
set(FACEPROBE_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/faceprobe)
# Not the system's library folder: TensorFlow Lite's library is ours alone, and must not be found by other programs.
set(FACEPROBE_PRIVATE_LIBDIR ${CMAKE_INSTALL_LIBDIR}/faceprobe)

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
  # Both: without AVX, Eigen lowers what it aligns inside of other objects although the other macro is set, and structs have another layout.
  target_compile_definitions(faceprobe_core INTERFACE
    EIGEN_MAX_ALIGN_BYTES=${FACEPROBE_EIGEN_ALIGNMENT} EIGEN_MAX_STATIC_ALIGN_BYTES=${FACEPROBE_EIGEN_ALIGNMENT})
endif()

# What runs finds the private library from where it lies itself.
file(RELATIVE_PATH _private_from_bin ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR}/faceprobe)
set_target_properties(faceprobe PROPERTIES INSTALL_RPATH "$ORIGIN/${_private_from_bin}")
if(TARGET _faceprobe AND NOT SKBUILD)
  file(RELATIVE_PATH _private_from_module /prefix/${FACEPROBE_PYTHON_DIR}/faceprobe /prefix/${FACEPROBE_PRIVATE_LIBDIR})
  set_target_properties(_faceprobe PROPERTIES INSTALL_RPATH "$ORIGIN/${_private_from_module}")
endif()

install(TARGETS faceprobe RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT faceprobe)
if(TARGET faceprobe_torch_side)
  install(TARGETS faceprobe_torch_side LIBRARY DESTINATION ${FACEPROBE_PRIVATE_LIBDIR} COMPONENT faceprobe)
endif()
install(FILES ${FACEPROBE_DEPS_DIR}/tflite/libtensorflowlite_c.so DESTINATION ${FACEPROBE_PRIVATE_LIBDIR} COMPONENT faceprobe)
install(FILES
  ${FACEPROBE_DEPS_DIR}/data/face_landmark.tflite
  ${FACEPROBE_DEPS_DIR}/data/face_detection_short_range.tflite
  ${FACEPROBE_DEPS_DIR}/data/face_detection_full_range.tflite
  ${FACEPROBE_DEPS_DIR}/data/canonical-face-model.obj
  DESTINATION ${CMAKE_INSTALL_DATADIR}/faceprobe COMPONENT faceprobe)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/models/ DESTINATION ${CMAKE_INSTALL_DATADIR}/faceprobe COMPONENT faceprobe
        FILES_MATCHING PATTERN "*.safetensors")
# What the page offers to whoever has no photo at hand; set-up may not have had them.
foreach(_sample grace_hopper.jpg astronaut.png)
  install(FILES ${FACEPROBE_DEPS_DIR}/data/samples/${_sample} DESTINATION ${CMAKE_INSTALL_DATADIR}/faceprobe/samples COMPONENT faceprobe OPTIONAL)
endforeach()
# The page of `faceprobe serve`, where it is built.
if(FACEPROBE_WEB_DIR)
  install(DIRECTORY ${FACEPROBE_WEB_DIR}/ DESTINATION ${CMAKE_INSTALL_DATADIR}/faceprobe/web COMPONENT faceprobe)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/THIRD_PARTY.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT notices)

install(TARGETS ${FACEPROBE_ROOMS} EXPORT faceprobeTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libfaceprobe-dev)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/faceprobe DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT libfaceprobe-dev
        FILES_MATCHING PATTERN "*.h")
install(EXPORT faceprobeTargets NAMESPACE faceprobe:: DESTINATION ${FACEPROBE_PACKAGE_DIR} COMPONENT libfaceprobe-dev)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/faceprobeConfig.cmake.in
  ${PROJECT_BINARY_DIR}/cmake/faceprobeConfig.cmake
  INSTALL_DESTINATION ${FACEPROBE_PACKAGE_DIR}
  PATH_VARS FACEPROBE_PRIVATE_LIBDIR CMAKE_INSTALL_DATADIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cmake/faceprobeConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/cmake/faceprobeConfig.cmake
  ${PROJECT_BINARY_DIR}/cmake/faceprobeConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/FindOpenCV.cmake
  DESTINATION ${FACEPROBE_PACKAGE_DIR} COMPONENT libfaceprobe-dev)
include(${PROJECT_SOURCE_DIR}/packaging/pkg_config.cmake)

if(PROJECT_IS_TOP_LEVEL)
  include(Package)
endif()
