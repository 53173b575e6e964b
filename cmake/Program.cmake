# The shell: files in and out, the program, its module for several machines, and the texts it prints.

# Reading and writing files, for the program, the examples and the tests.
file(GLOB_RECURSE io_files CONFIGURE_DEPENDS src/io/*.cpp)
if(NOT nlohmann_json_FOUND) # which these need
  file(GLOB json_files CONFIGURE_DEPENDS src/io/results/statistics.cpp src/io/results/scene_info_json.cpp
       src/io/meshes/glb.cpp src/io/gltf/*.cpp src/io/gltf/document/*.cpp)
  list(REMOVE_ITEM io_files ${json_files})
endif()
hemilux_add_library(hemilux_io ${io_files})
foreach(part IN LISTS parts)
  target_include_directories(${part} SYSTEM PRIVATE ${STB_INCLUDE_DIR} $<$<BOOL:${HEMILUX_WEBP}>:${WEBP_INCLUDE_DIR}>)
  # As below: what computes is in the library.
  target_compile_options(${part} PRIVATE $<$<CONFIG:Release>:-O2>)
  target_link_libraries(${part} PRIVATE $<BUILD_INTERFACE:hemilux_options>
                        $<$<BOOL:${nlohmann_json_FOUND}>:$<BUILD_INTERFACE:nlohmann_json::nlohmann_json>>)
endforeach()
target_link_libraries(hemilux_io PUBLIC hemilux)
# nlohmann-json takes longer to compile than what uses it: once for all.
set_source_files_properties(
  src/io/gltf/document/json_value.cpp src/io/gltf/lit_file.cpp src/io/gltf/lit_materials.cpp
  src/io/gltf/open_document.cpp src/io/meshes/glb.cpp src/io/results/scene_info_json.cpp
  src/io/results/statistics.cpp PROPERTIES UNITY_GROUP json)
set_target_properties(hemilux_io PROPERTIES EXPORT_NAME io)
if(ZLIB_FOUND)
  set_source_files_properties(src/io/pictures/picture_files.cpp PROPERTIES COMPILE_DEFINITIONS HEMILUX_ZLIB)
  target_link_libraries(hemilux_io PRIVATE ZLIB::ZLIB)
endif()
if(HEMILUX_WEBP)
  set_source_files_properties(src/io/textures/webp.cpp PROPERTIES COMPILE_DEFINITIONS HEMILUX_WEBP)
  target_link_libraries(hemilux_io PRIVATE ${WEBP_LIBRARY})
endif()

if(HEMILUX_PROGRAM)
  file(GLOB_RECURSE app_files CONFIGURE_DEPENDS src/app/*.cpp)
  list(FILTER app_files EXCLUDE REGEX "/(main|subcommands/first)\\.cpp$")
  include(cmake/EmbedReport.cmake)
  hemilux_embed_report(${PROJECT_BINARY_DIR}/report_assets.cpp ${PROJECT_SOURCE_DIR}/src/app/report)
  # Reading arguments need not be fast, and CLI11 takes long to optimise.
  set_source_files_properties(src/app/command_line/arguments.cpp PROPERTIES
                              COMPILE_OPTIONS -O0 SKIP_PRECOMPILE_HEADERS ON)
  hemilux_add_library(hemilux_app ${app_files} ${PROJECT_BINARY_DIR}/report_assets.cpp)
  # From the program's folder to that of its module.
  file(RELATIVE_PATH module_folder /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR}/hemilux)
  foreach(part IN LISTS parts)
    # What computes is in the libraries: to optimise this half as much saves a twentieth of a build.
    target_compile_options(${part} PRIVATE $<$<CONFIG:Release>:-O1>)
    target_compile_definitions(${part} PUBLIC HEMILUX_VERSION="${PROJECT_VERSION}"
                               PRIVATE HEMILUX_MODULE_FOLDER="${module_folder}")
    target_link_libraries(${part} PRIVATE CLI11::CLI11 nlohmann_json::nlohmann_json hemilux_options)
  endforeach()
  target_link_libraries(hemilux_app PUBLIC hemilux_io PRIVATE ${CMAKE_DL_LIBS})
  add_library(hemilux_main OBJECT src/app/main.cpp)
  target_include_directories(hemilux_main PRIVATE src)
  target_link_libraries(hemilux_main PRIVATE glm::glm hemilux_options)
  target_compile_definitions(hemilux_main PRIVATE HEMILUX_VERSION="${PROJECT_VERSION}")
  add_executable(hemilux_program $<TARGET_OBJECTS:hemilux_main>)
  set_target_properties(hemilux_program PROPERTIES OUTPUT_NAME hemilux LINKER_LANGUAGE CXX)
  target_link_libraries(hemilux_program PRIVATE hemilux_app hemilux_options)
endif()

# The same with fewer subcommands and methods (FirstProgram.cmake).
if(HEMILUX_PROGRAM AND PROJECT_IS_TOP_LEVEL)
  hemilux_first_of(first_methods ${method_files})
  hemilux_list_methods(${PROJECT_BINARY_DIR}/first/methods.cpp ${first_methods})
  add_executable(hemilux_first src/app/subcommands/first.cpp ${PROJECT_BINARY_DIR}/first/methods.cpp)
  foreach(part main paper_first engine_first light_first answers_first io_first app_first)
    target_sources(hemilux_first PRIVATE $<TARGET_OBJECTS:hemilux_${part}>)
  endforeach()
  set_target_properties(hemilux_first PROPERTIES OUTPUT_NAME hemilux
                        RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/first)
  target_include_directories(hemilux_first PRIVATE src)
  target_link_libraries(hemilux_first PRIVATE glm::glm Threads::Threads hemilux_options ${CMAKE_DL_LIBS})
  if(ZLIB_FOUND)
    target_link_libraries(hemilux_first PRIVATE ZLIB::ZLIB)
  endif()
  if(HEMILUX_WEBP)
    target_link_libraries(hemilux_first PRIVATE ${WEBP_LIBRARY})
  endif()
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
