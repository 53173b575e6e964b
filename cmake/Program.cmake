# The shell: files in and out, the program, its module for several machines, and the texts it prints.

# Reading and writing files, for the program, the examples and the tests.
file(GLOB_RECURSE io_files CONFIGURE_DEPENDS src/io/*.cpp)
# The program's: they need nlohmann-json.
file(GLOB json_files CONFIGURE_DEPENDS src/io/results/statistics.cpp src/io/results/scene_info_json.cpp
     src/io/meshes/glb.cpp src/io/gltf/*.cpp src/io/gltf/document/*.cpp)
list(REMOVE_ITEM io_files ${json_files})
add_library(hemilux_io ${io_files})
hemilux_compile_by_folder(hemilux_io ${io_files})
target_include_directories(hemilux_io SYSTEM PRIVATE ${STB_INCLUDE_DIR})
# As below: what computes is in the library.
target_compile_options(hemilux_io PRIVATE $<$<CONFIG:Release>:-O2>)
target_link_libraries(hemilux_io PUBLIC hemilux PRIVATE $<BUILD_INTERFACE:hemilux_options>)
set_target_properties(hemilux_io PROPERTIES EXPORT_NAME io)
if(ZLIB_FOUND)
  set_source_files_properties(src/io/pictures/image.cpp PROPERTIES COMPILE_DEFINITIONS HEMILUX_ZLIB)
  target_link_libraries(hemilux_io PRIVATE ZLIB::ZLIB)
endif()
if(HEMILUX_WEBP)
  set_source_files_properties(src/io/textures/webp.cpp PROPERTIES COMPILE_DEFINITIONS HEMILUX_WEBP)
  target_include_directories(hemilux_io SYSTEM PRIVATE ${WEBP_INCLUDE_DIR})
  target_link_libraries(hemilux_io PRIVATE ${WEBP_LIBRARY})
endif()
if(PROJECT_IS_TOP_LEVEL)
  target_precompile_headers(hemilux_io REUSE_FROM hemilux_paper)
endif()

if(HEMILUX_PROGRAM)
  file(GLOB_RECURSE app_files CONFIGURE_DEPENDS src/app/*.cpp)
  list(FILTER app_files EXCLUDE REGEX "main\\.cpp$")
  include(cmake/EmbedReport.cmake)
  hemilux_embed_report(${PROJECT_BINARY_DIR}/report_assets.cpp ${PROJECT_SOURCE_DIR}/src/app/report)
  # Reading arguments need not be fast, and CLI11 takes long to optimise.
  set_source_files_properties(src/app/command_line/arguments.cpp PROPERTIES
                              COMPILE_OPTIONS -O1 SKIP_PRECOMPILE_HEADERS ON)
  add_library(hemilux_app ${app_files} ${json_files} ${PROJECT_BINARY_DIR}/report_assets.cpp)
  hemilux_compile_by_folder(hemilux_app ${app_files} ${json_files})
  # nlohmann-json takes longer to compile than what uses it: once for all.
  set_source_files_properties(
    src/app/report/run_data.cpp src/io/gltf/document/json_value.cpp src/io/meshes/glb.cpp
    src/io/results/scene_info_json.cpp src/io/results/statistics.cpp PROPERTIES UNITY_GROUP json)
  # What computes is in the libraries: to optimise this half as much saves a twentieth of a build.
  target_compile_options(hemilux_app PRIVATE $<$<CONFIG:Release>:-O1>)
  # From the program's folder to that of its module.
  file(RELATIVE_PATH module_folder /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR}/hemilux)
  target_compile_definitions(hemilux_app PUBLIC HEMILUX_VERSION="${PROJECT_VERSION}"
                             PRIVATE HEMILUX_MODULE_FOLDER="${module_folder}")
  target_link_libraries(hemilux_app PUBLIC hemilux_io
                        PRIVATE CLI11::CLI11 nlohmann_json::nlohmann_json hemilux_options
                                ${CMAKE_DL_LIBS})
  if(PROJECT_IS_TOP_LEVEL)
    target_precompile_headers(hemilux_app REUSE_FROM hemilux_paper)
  endif()
  add_executable(hemilux_program src/app/main.cpp)
  set_target_properties(hemilux_program PROPERTIES OUTPUT_NAME hemilux)
  target_link_libraries(hemilux_program PRIVATE hemilux_app hemilux_options)
endif()

# What mpirun's processes solve together with: the program loads it when it is one of several.
if(HEMILUX_PROGRAM AND HEMILUX_MPI)
  find_package(MPI QUIET COMPONENTS CXX)
  if(MPI_CXX_FOUND)
    add_library(hemilux_mpi MODULE src/mpi/memory_of_ranks.cpp src/mpi/ranks_by_mpi.cpp src/parallel/ranks.cpp)
    set_target_properties(hemilux_mpi PROPERTIES PREFIX "")
    target_include_directories(hemilux_mpi PRIVATE src)
    target_compile_definitions(hemilux_mpi PRIVATE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
    target_link_libraries(hemilux_mpi PRIVATE MPI::MPI_CXX hemilux_options)
    add_dependencies(hemilux_program hemilux_mpi)
  endif()
endif()

# The manual page and what shells complete, printed by the program.
if(HEMILUX_PROGRAM AND PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CROSSCOMPILING)
  foreach(text man=hemilux.1 bash=hemilux.bash zsh=_hemilux fish=hemilux.fish)
    string(REGEX MATCH "^([a-z]+)=(.*)$" text ${text})
    set(text_file ${PROJECT_BINARY_DIR}/texts/${CMAKE_MATCH_2})
    add_custom_command(OUTPUT ${text_file} DEPENDS hemilux_program
      COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/texts
      COMMAND hemilux_program --print ${CMAKE_MATCH_1} > ${text_file})
    list(APPEND text_files ${text_file})
  endforeach()
  add_custom_target(hemilux_texts ALL DEPENDS ${text_files})
endif()
