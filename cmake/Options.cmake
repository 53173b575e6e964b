# What every target of this project is compiled with.
if(HEMILUX_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined)
  add_link_options(-fsanitize=address,undefined)
  # stb_image copies nothing from or to nullptr where a chunk is empty.
  set_source_files_properties(src/io/textures/texture_files.cpp PROPERTIES COMPILE_OPTIONS
                              -fno-sanitize=nonnull-attribute)
endif()

# Contraction of a*b+c is off, and elementary functions are the project's own (geometry/elementary.h), so
# that all compilers and machines give the same bytes. g++ 12 finds fault with std::string's own code (GCC
# bug 105651).
add_library(hemilux_options INTERFACE)
target_compile_features(hemilux_options INTERFACE cxx_std_20)
target_compile_options(hemilux_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -ffp-contract=off
  "$<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict;-Wno-array-bounds;-Wno-stringop-overread;-Wno-stringop-overflow>"
  # Position-independent code as fast as other code: no function is replaced when a program is loaded.
  $<$<AND:$<BOOL:${HEMILUX_PYTHON}>,$<CXX_COMPILER_ID:GNU>>:-fno-semantic-interposition>
  # A large unit takes a twentieth less time where g++ looks for memory to free later.
  $<$<AND:$<BOOL:${CMAKE_UNITY_BUILD}>,$<CXX_COMPILER_ID:GNU>>:--param=ggc-min-heapsize=1000000>
  # Files that are compiled together see each other's names.
  $<$<BOOL:${CMAKE_UNITY_BUILD}>:-Wno-shadow;$<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>>
  $<$<BOOL:${HEMILUX_WARNINGS_AS_ERRORS}>:-Werror>)
