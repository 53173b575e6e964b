# Installs the library from build folder BUILD, then configures, builds and runs the consumer beside
# this file against what was installed, as a user would. Nothing but BUILD/package_test is written.
cmake_minimum_required(VERSION 3.25)
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
step(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${work}/build -G ${GENERATOR}
     -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS}
     -DCMAKE_PREFIX_PATH=${work}/installed)
step(${CMAKE_COMMAND} --build ${work}/build)
step(${work}/build/consumer)
