# Where CMAKE_UNITY_BUILD is on, the files of a folder are compiled together.
function(hemilux_compile_by_folder target)
  foreach(file IN LISTS ARGN)
    cmake_path(GET file PARENT_PATH folder)
    string(MAKE_C_IDENTIFIER "${folder}" group)
    set_source_files_properties(${file} PROPERTIES UNITY_GROUP ${group})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

# hemilux_storey(NAME BELOW FILE...): the library hemilux_NAME of these files. It stands on the target
# BELOW, or on GLM alone where that is empty.
function(hemilux_storey name below)
  set(target hemilux_${name})
  add_library(${target} ${ARGN})
  add_library(hemilux::${name} ALIAS ${target})
  hemilux_compile_by_folder(${target} ${ARGN})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/hemilux>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:hemilux_options>)
  if(below)
    target_link_libraries(${target} PUBLIC ${below})
  else()
    target_link_libraries(${target} PUBLIC glm::glm)
  endif()
  # Read once for all files, which still include what they use.
  if(NOT PROJECT_IS_TOP_LEVEL)
  elseif(below)
    target_precompile_headers(${target} REUSE_FROM hemilux_paper)
  else()
    target_precompile_headers(${target} PRIVATE <glm/glm.hpp>
      <algorithm> <array> <cmath> <filesystem> <functional> <memory> <optional> <span> <string> <vector>)
  endif()
endfunction()
