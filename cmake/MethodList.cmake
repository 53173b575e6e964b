# hemilux_list_methods(OUTPUT FILE...): writes the source file that lists what the files define, each
# named as its file: those of a folder guides/ a Guide, of aimers/ a MakeAimer, all others a Method.
set(HEMILUX_METHOD_LIST_TEMPLATE ${CMAKE_CURRENT_LIST_DIR}/methods.cpp.in)
function(hemilux_list_methods output)
  set(declarations "")
  foreach(kind method guide aimer)
    set(${kind}_addresses "")
  endforeach()
  foreach(file IN LISTS ARGN)
    cmake_path(GET file STEM stem)
    if(file MATCHES "/guides/[^/]+$")
      string(APPEND declarations "extern const Guide ${stem}_guide;\n")
      string(APPEND guide_addresses "&${stem}_guide, ")
    elseif(file MATCHES "/aimers/[^/]+$")
      string(APPEND declarations "extern const MakeAimer ${stem}_aimer;\n")
      string(APPEND aimer_addresses "&${stem}_aimer, ")
    else()
      string(APPEND declarations "extern const Method ${stem}_method;\n")
      string(APPEND method_addresses "&${stem}_method, ")
    endif()
  endforeach()
  configure_file(${HEMILUX_METHOD_LIST_TEMPLATE} ${output} @ONLY)
endfunction()

# Every file of these folders defines one Method, or one addition to the engine's
# (radiosity/engine/shooting/additions.h): adding the file is all. Those of other folders are named by
# HEMILUX_EXTRA_METHODS.
set(method_files ${engine_files} ${research_files})
list(FILTER method_files INCLUDE REGEX "/(methods|guides|aimers)/[^/]+\\.cpp$")
set_source_files_properties(${method_files} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
list(APPEND method_files ${HEMILUX_EXTRA_METHODS})
hemilux_list_methods(${PROJECT_BINARY_DIR}/methods.cpp ${method_files})

list(TRANSFORM storeys PREPEND hemilux_ OUTPUT_VARIABLE storey_targets)
add_library(hemilux ${PROJECT_BINARY_DIR}/methods.cpp ${HEMILUX_EXTRA_METHODS})
add_library(hemilux::hemilux ALIAS hemilux)
target_link_libraries(hemilux PUBLIC ${storey_targets} PRIVATE $<BUILD_INTERFACE:hemilux_options>)
