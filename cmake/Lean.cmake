# The rooms of a lean build: what makes synthetic faces and trains on them. Embree, libtorch, TensorFlow Lite and headers, nothing else; in
# particular no decoder of pictures, no OpenCV, no oneDNN.
foreach(_room core io net face lighting synth train pipeline)
  add_subdirectory(src/${_room})
endforeach()
add_subdirectory(apps/cli/lean)

# Which rooms, and what they link, for tests/packages/check_lean.sh.
get_property(_rooms GLOBAL PROPERTY FACEPROBE_ROOMS)
set(_text "")
foreach(_room IN LISTS _rooms ITEMS faceprobe)
  get_target_property(_links ${_room} LINK_LIBRARIES)
  list(JOIN _links " " _links)
  string(APPEND _text "${_room}: ${_links}\n")
endforeach()
file(WRITE ${PROJECT_BINARY_DIR}/lean_links.txt "${_text}")
