# hemilux_list_methods(OUTPUT FILE...): writes the source file that lists the methods which the files
# define, each named as its file.
set(HEMILUX_METHOD_LIST_TEMPLATE ${CMAKE_CURRENT_LIST_DIR}/methods.cpp.in)
function(hemilux_list_methods output)
  set(method_declarations "")
  set(method_addresses "")
  foreach(file IN LISTS ARGN)
    cmake_path(GET file STEM stem)
    string(APPEND method_declarations "extern const Method ${stem}_method;\n")
    string(APPEND method_addresses "&${stem}_method, ")
  endforeach()
  configure_file(${HEMILUX_METHOD_LIST_TEMPLATE} ${output} @ONLY)
endfunction()

# Every file of a folder methods/ defines one Method, named as its file: adding the file is all. Those of
# other folders are named by HEMILUX_EXTRA_METHODS.
set(method_files ${engine_files} ${research_files})
list(FILTER method_files INCLUDE REGEX "/methods/[^/]+\\.cpp$")
set_source_files_properties(${method_files} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
list(APPEND method_files ${HEMILUX_EXTRA_METHODS})
hemilux_list_methods(${PROJECT_BINARY_DIR}/methods.cpp ${method_files})

list(TRANSFORM storeys PREPEND hemilux_ OUTPUT_VARIABLE storey_targets)
add_library(hemilux ${PROJECT_BINARY_DIR}/methods.cpp ${HEMILUX_EXTRA_METHODS})
add_library(hemilux::hemilux ALIAS hemilux)
target_link_libraries(hemilux PUBLIC ${storey_targets} PRIVATE $<BUILD_INTERFACE:hemilux_options>)
