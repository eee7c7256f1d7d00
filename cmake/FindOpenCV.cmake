# OpenCV from its headers and libraries, as targets opencv_NAME. OpenCV's own package file is the first choice; Debian ships
# it only with libopencv-dev, which brings all modules and hundreds of packages, so here the -dev packages of single modules
# are enough.
find_package(OpenCV ${OpenCV_FIND_VERSION} QUIET CONFIG COMPONENTS ${OpenCV_FIND_COMPONENTS})
if(NOT OpenCV_FOUND)
  find_path(OpenCV_INCLUDE_DIR opencv2/core/version.hpp PATH_SUFFIXES opencv4)
  mark_as_advanced(OpenCV_INCLUDE_DIR)
  if(OpenCV_INCLUDE_DIR)
    file(STRINGS ${OpenCV_INCLUDE_DIR}/opencv2/core/version.hpp _opencv_version
         REGEX "^#define CV_VERSION_(MAJOR|MINOR|REVISION) +[0-9]+")
    string(REGEX MATCHALL "[0-9]+" _opencv_version "${_opencv_version}")
    list(JOIN _opencv_version "." OpenCV_VERSION)
  endif()
  set(OpenCV_LIBS "")
  foreach(_module IN LISTS OpenCV_FIND_COMPONENTS)
    find_library(OpenCV_${_module}_LIBRARY opencv_${_module})
    mark_as_advanced(OpenCV_${_module}_LIBRARY)
    if(OpenCV_${_module}_LIBRARY AND EXISTS ${OpenCV_INCLUDE_DIR}/opencv2/${_module}.hpp)
      set(OpenCV_${_module}_FOUND TRUE)
      list(APPEND OpenCV_LIBS opencv_${_module})
    endif()
  endforeach()

  include(FindPackageHandleStandardArgs)
  find_package_handle_standard_args(OpenCV REQUIRED_VARS OpenCV_INCLUDE_DIR VERSION_VAR OpenCV_VERSION HANDLE_COMPONENTS)
  if(OpenCV_FOUND)
    foreach(_module IN LISTS OpenCV_FIND_COMPONENTS)
      if(OpenCV_${_module}_FOUND AND NOT TARGET opencv_${_module})
        add_library(opencv_${_module} UNKNOWN IMPORTED)
        set_target_properties(opencv_${_module} PROPERTIES
          IMPORTED_LOCATION ${OpenCV_${_module}_LIBRARY}
          INTERFACE_INCLUDE_DIRECTORIES ${OpenCV_INCLUDE_DIR})
      endif()
    endforeach()
  endif()
endif()
