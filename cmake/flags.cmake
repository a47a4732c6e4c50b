# Flags that hang on targets. graspd_options: what every target of ours is compiled with;
# graspd_warnings: strict warnings for our own sources only, never for generated ones.
# graspd_machine_options: graspd_options without sanitizers, for sources that are another library's
# templates (what the sanitizers' presets have of these is the same, and compiled once by ccache).
add_library(graspd_machine_options INTERFACE)
target_compile_options(graspd_machine_options INTERFACE -ffp-contract=off)
if(NOT GRASPD_PORTABLE AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|amd64|AMD64")
  target_compile_options(graspd_machine_options INTERFACE -march=x86-64-v2)
endif()
add_library(graspd_options INTERFACE)
target_link_libraries(graspd_options INTERFACE graspd_machine_options)
# What a sanitizer finds ends the program: else no test would fail by it. Null pointers end a program
# by themselves; the checks for them (and for alignment, object sizes and virtual tables) double and
# treble the time that a file full of templates takes to compile.
if(GRASPD_SANITIZE)
  target_compile_options(graspd_options INTERFACE
    -fsanitize=${GRASPD_SANITIZE} -fno-sanitize=null,alignment,object-size,vptr
    -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(graspd_options INTERFACE -fsanitize=${GRASPD_SANITIZE})
endif()
# What libFuzzer watches to see where an input leads; everything of ours, not other libraries.
if(GRASPD_BUILD_FUZZ)
  target_compile_options(graspd_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# -Wno-restrict: g++ 12 sees an overlap in `"text" + std::string()` that is not there.
add_library(graspd_warnings INTERFACE)
target_compile_options(graspd_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
  -Wold-style-cast -Wcast-align -Woverloaded-virtual -Wdouble-promotion -Wimplicit-fallthrough
  -Wno-restrict $<$<CXX_COMPILER_ID:Clang>:-Wno-unknown-warning-option>)
# Instrumented code of the standard library looks uninitialised to g++ 12.
if(GRASPD_SANITIZE)
  target_compile_options(graspd_warnings INTERFACE -Wno-maybe-uninitialized)
endif()
# Sources compiled as one: a class of a .cpp file may have members of its anonymous namespace.
if(CMAKE_UNITY_BUILD)
  target_compile_options(graspd_warnings INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
if(GRASPD_WERROR)
  target_compile_options(graspd_warnings INTERFACE -Werror)
endif()
