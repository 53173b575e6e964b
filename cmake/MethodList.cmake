# hemilux_list_methods(OUTPUT FILE...): writes the source file that lists the methods which the files
# define, each named as its file.
set(HEMILUX_METHOD_LIST_TEMPLATE ${CMAKE_CURRENT_LIST_DIR}/../src/radiosity/engine/solving/methods.cpp.in)
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
