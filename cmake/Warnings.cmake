# One interface target carries what every own target is compiled with.
add_library(faceprobe_flags INTERFACE)
target_compile_options(faceprobe_flags INTERFACE -Wall -Wextra -Wconversion -fno-math-errno)
if(FACEPROBE_NATIVE)
  target_compile_options(faceprobe_flags INTERFACE -march=native)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  # AVX2 and FMA: every x86 desktop processor since 2015.
  target_compile_options(faceprobe_flags INTERFACE -march=x86-64-v3)
  # So that the loader refuses others with a sentence; without it they die of an illegal instruction.
  target_link_options(faceprobe_flags INTERFACE LINKER:-z,x86-64-v3)
endif()
if(FACEPROBE_SANITIZE)
  target_compile_options(faceprobe_flags INTERFACE -fsanitize=${FACEPROBE_SANITIZE} -fno-omit-frame-pointer
                                                   -fno-sanitize-recover=all)
  target_link_options(faceprobe_flags INTERFACE -fsanitize=${FACEPROBE_SANITIZE})
endif()
