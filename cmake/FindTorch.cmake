# libtorch as the targets in TORCH_LIBRARIES. By its own package file, or, with FACEPROBE_TORCH_DIR, straight from the folder of a Python torch:
# the package file of a CUDA build ends with an error where there is no CUDA toolkit, of which the libraries have no need.
set(FACEPROBE_TORCH_DIR "" CACHE PATH "Folder of a Python torch, with lib/libtorch.so; default: libtorch by its CMake package")
if(NOT FACEPROBE_TORCH_DIR)
  find_package(Torch ${Torch_FIND_VERSION} QUIET CONFIG)
  include(FindPackageHandleStandardArgs)
  find_package_handle_standard_args(Torch CONFIG_MODE)
  return()
endif()

if(NOT EXISTS ${FACEPROBE_TORCH_DIR}/lib/libtorch_cpu.so OR NOT EXISTS ${FACEPROBE_TORCH_DIR}/include/torch/csrc/api/include/torch/torch.h)
  message(FATAL_ERROR "FACEPROBE_TORCH_DIR is ${FACEPROBE_TORCH_DIR}, which has no libtorch. Name the folder that this prints: "
                      "python3 -c 'import os, torch; print(os.path.dirname(torch.__file__))'")
endif()
set(Torch_FOUND TRUE)
set(TORCH_LIBRARIES faceprobe_torch)
if(TARGET faceprobe_torch)
  return()
endif()
# Imported as one: libraries of CUDA, whose symbols nothing names, register themselves when they are loaded, so that the linker must not leave
# them out; what they themselves need lies where they look for it.
add_library(faceprobe_torch INTERFACE IMPORTED GLOBAL)
set(_torch_lib ${FACEPROBE_TORCH_DIR}/lib)
set(_torch_links "")
foreach(_name torch torch_cpu torch_cuda c10 c10_cuda)
  if(EXISTS ${_torch_lib}/lib${_name}.so)
    list(APPEND _torch_links ${_torch_lib}/lib${_name}.so)
  endif()
endforeach()
set_target_properties(faceprobe_torch PROPERTIES
  INTERFACE_INCLUDE_DIRECTORIES "${FACEPROBE_TORCH_DIR}/include;${FACEPROBE_TORCH_DIR}/include/torch/csrc/api/include"
  INTERFACE_LINK_LIBRARIES "${_torch_links}"
  INTERFACE_LINK_OPTIONS "LINKER:--no-as-needed;LINKER:--allow-shlib-undefined;LINKER:-rpath-link,${_torch_lib}")
message(STATUS "libtorch: ${FACEPROBE_TORCH_DIR}")
