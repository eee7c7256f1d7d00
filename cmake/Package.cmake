# Packages by CPack: for Debian 12 `faceprobe` (the command and what it needs) and `libfaceprobe-dev` (what other projects build with), and a
# tarball of the command that runs from any folder. scripts/package.sh makes them all.
set(FACEPROBE_PACKAGE_CONTACT "Faceprobe maintainers <maintainers@faceprobe.example>" CACHE STRING "Maintainer of the packages: Name <mail@address>")
set(FACEPROBE_PACKAGE_RELEASE 1 CACHE STRING "Debian revision: counts packages made of one version")

get_cmake_property(_components COMPONENTS)
if(Unspecified IN_LIST _components)
  message(FATAL_ERROR "An install() rule names no COMPONENT, so that no package would have its files.")
endif()

# What a Debian package has to hold beside its contents.
set(_debian ${PROJECT_BINARY_DIR}/debian)
string(TIMESTAMP FACEPROBE_PACKAGE_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(${PROJECT_SOURCE_DIR}/packaging/debian/changelog.in ${_debian}/changelog @ONLY)
configure_file(${PROJECT_SOURCE_DIR}/CHANGELOG.md ${_debian}/CHANGELOG.md COPYONLY)
set(_changelogs "")
find_program(GZIP_PROGRAM gzip)
mark_as_advanced(GZIP_PROGRAM)
if(GZIP_PROGRAM)
  execute_process(COMMAND ${GZIP_PROGRAM} -9nc ${_debian}/changelog OUTPUT_FILE ${_debian}/changelog.Debian.gz COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${GZIP_PROGRAM} -9nc ${_debian}/CHANGELOG.md OUTPUT_FILE ${_debian}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
  set(_changelogs ${_debian}/changelog.Debian.gz ${_debian}/changelog.gz)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/packaging/debian/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/faceprobe COMPONENT faceprobe)
# Not in a plain `cmake --install`, nor in the tarball.
install(FILES ${_changelogs} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/faceprobe COMPONENT faceprobe-debian EXCLUDE_FROM_ALL)
install(FILES ${PROJECT_SOURCE_DIR}/packaging/debian/copyright ${_changelogs}
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libfaceprobe-dev COMPONENT libfaceprobe-dev-debian EXCLUDE_FROM_ALL)
foreach(_package faceprobe libfaceprobe-dev)
  install(FILES ${PROJECT_SOURCE_DIR}/packaging/debian/${_package}.lintian-overrides
          DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides RENAME ${_package} COMPONENT ${_package}-debian EXCLUDE_FROM_ALL)
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/docs/install.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT notices)

# Nobody would want these in a package: libtorch, or a sanitizer.
if(FACEPROBE_TRAIN OR FACEPROBE_SANITIZE)
  return()
endif()

if(FACEPROBE_NATIVE)
  set(_processor "
.
It is compiled for the processor of the machine that built it, and may not
start on others.")
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(_processor "
.
It needs a processor with AVX2 and FMA (x86-64-v3).")
endif()

set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/packaging/generators.cmake)
set(CPACK_PACKAGE_NAME faceprobe)
set(CPACK_PACKAGE_VENDOR Faceprobe)
set(CPACK_PACKAGE_CONTACT "${FACEPROBE_PACKAGE_CONTACT}")
string(TOLOWER ${CMAKE_SYSTEM_NAME} _system)
set(CPACK_PACKAGE_FILE_NAME faceprobe-${PROJECT_VERSION}-${_system}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${FACEPROBE_PACKAGE_RELEASE})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SOURCE faceprobe)

set(CPACK_DEBIAN_FACEPROBE_PACKAGE_NAME faceprobe)
set(CPACK_DEBIAN_FACEPROBE_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_FACEPROBE_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${FACEPROBE_DEPS_DIR}/tflite)
set(CPACK_DEBIAN_FACEPROBE_PACKAGE_DEPENDS fonts-dejavu-core)  # captions; opened by path, so that no linker knows
set(CPACK_DEBIAN_FACEPROBE_DESCRIPTION "light that fell on a face, from one photo
Turns a photo of a face into the light that fell on it: an HDR environment
map, its spherical harmonics and its main lights, for putting rendered
objects into the portrait. A command and, where it was built, a local web page.
Everything runs on this computer.${_processor}")

set(CPACK_DEBIAN_LIBFACEPROBE-DEV_PACKAGE_NAME libfaceprobe-dev)
set(CPACK_DEBIAN_LIBFACEPROBE-DEV_PACKAGE_SECTION libdevel)
# As cmake/faceprobeConfig.cmake.in and packaging/faceprobe.pc.in look for them; models and TensorFlow Lite are in `faceprobe`.
set(CPACK_DEBIAN_LIBFACEPROBE-DEV_PACKAGE_DEPENDS
    "faceprobe (= ${PROJECT_VERSION}-${FACEPROBE_PACKAGE_RELEASE}), libeigen3-dev, libopenimageio-dev, libopencv-core-dev, libopencv-imgproc-dev, \
libopencv-calib3d-dev, liblcms2-dev, libdnnl-dev, ocl-icd-opencl-dev, libembree-dev, libassimp-dev, nlohmann-json3-dev, libnanoflann-dev, pkg-config")
set(CPACK_DEBIAN_LIBFACEPROBE-DEV_PACKAGE_RECOMMENDS "libopenblas-dev, libmatio-dev, libhdf5-dev, libtinyobjloader-dev, libzip-dev")
set(CPACK_DEBIAN_LIBFACEPROBE-DEV_DESCRIPTION "light that fell on a face, from one photo - library
Faceprobe turns a photo of a face into the light that fell on it. This package
has its C++20 headers, static libraries, CMake package and pkg-config file. The
recommended packages are needed only for the libraries of synthetic faces.${_processor}")

include(CPack)
