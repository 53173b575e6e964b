# Installs the library from build folder BUILD, then configures, builds and runs the consumer beside
# this file against what was installed, as a user would, by find_package and by pkg-config; then the
# same with the programs that docs/use/library.md prints. Nothing but BUILD/package_test is written.
cmake_minimum_required(VERSION 3.22)
set(work ${BUILD}/package_test)
file(REMOVE_RECURSE ${work})

function(step)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\n${text}")
  endif()
endfunction()

step(${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/installed --component library)
foreach(folder io app)
  if(EXISTS ${work}/installed/include/hemilux/${folder})
    message(FATAL_ERROR "headers of src/${folder} were installed; the library has none of them")
  endif()
endforeach()

function(build_and_run source build program)
  step(${CMAKE_COMMAND} -S ${source} -B ${build} -G ${GENERATOR}
       -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS}
       -DCMAKE_PREFIX_PATH=${work}/installed)
  step(${CMAKE_COMMAND} --build ${build})
  step(${build}/${program} ${ARGN})
endfunction()
set(arguments_of_room ${CMAKE_CURRENT_LIST_DIR}/../../examples/scenes/cornell_box.obj ${work}/room.png)

build_and_run(${CMAKE_CURRENT_LIST_DIR} ${work}/build consumer)

# The same by pkg-config, where that is.
find_program(pkg_config pkg-config)
if(pkg_config)
  file(GLOB_RECURSE description ${work}/installed/hemilux.pc)
  cmake_path(GET description PARENT_PATH folder)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${folder}
    ${pkg_config} --cflags --libs "hemilux >= 0.1" OUTPUT_VARIABLE flags COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags UNIX_COMMAND "${FLAGS} ${CMAKE_CURRENT_LIST_DIR}/consumer.cpp ${flags}")
  step(${COMPILER} ${flags} -o ${work}/by_pkg_config)
  step(${work}/by_pkg_config)
endif()

if(WITH_IO)
  step(${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/installed --component io)
endif()

# Each block of cmake in the page has the program's block of cpp behind it.
file(READ ${CMAKE_CURRENT_LIST_DIR}/../../docs/use/library.md page)
foreach(program first pages strategy room)
  if(program STREQUAL "room" AND NOT WITH_IO)
    break()
  endif()
  foreach(block "cmake;CMakeLists.txt" "cpp;${program}.cpp")
    list(GET block 0 language)
    list(GET block 1 name)
    if(NOT page MATCHES "```${language}\n([^`]+)```(.*)")
      message(FATAL_ERROR "docs/use/library.md has no block of ${language} for ${program}")
    endif()
    file(WRITE ${work}/${program}/${name} "${CMAKE_MATCH_1}")
    set(page "${CMAKE_MATCH_2}")
  endforeach()
  build_and_run(${work}/${program} ${work}/${program}/build ${program} ${arguments_of_${program}})
endforeach()
