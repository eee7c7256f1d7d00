# Read by cpack before each kind of package: where they differ.
if(CPACK_GENERATOR STREQUAL "DEB")
  # A package is a component of ours and what Debian wants beside it.
  set(CPACK_COMPONENTS_ALL faceprobe faceprobe-debian libfaceprobe-dev libfaceprobe-dev-debian)
  set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
  set(CPACK_COMPONENT_FACEPROBE_GROUP faceprobe)
  set(CPACK_COMPONENT_FACEPROBE-DEBIAN_GROUP faceprobe)
  set(CPACK_COMPONENT_LIBFACEPROBE-DEV_GROUP libfaceprobe-dev)
  set(CPACK_COMPONENT_LIBFACEPROBE-DEV-DEBIAN_GROUP libfaceprobe-dev)
  # CPack would put it before each package's own.
  unset(CPACK_PACKAGE_DESCRIPTION_SUMMARY)
elseif(CPACK_GENERATOR STREQUAL "TGZ")
  set(CPACK_COMPONENTS_ALL faceprobe notices)
  set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
  set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
  set(CPACK_COMPONENT_INCLUDE_TOPLEVEL_DIRECTORY ON)
endif()
