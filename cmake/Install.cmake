# cmake --install; component `library` is what find_package(hemilux) needs.
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/hemilux)
# Each storey has an export of its own, so that find_package(hemilux COMPONENTS paper) asks for no more.
set(header_folders_of_paper src/geometry src/bvh src/radiosity/paper)
set(header_folders_of_engine src/bvh/wide src/parallel src/radiosity/engine)
set(header_folders_of_light src/radiosity/light)
set(header_folders_of_answers src/radiosity/answers)
set(header_folders_of_research src/radiosity/research)
set(except_of_paper PATTERN wide EXCLUDE)
foreach(storey IN LISTS storeys)
  install(TARGETS hemilux_${storey} EXPORT hemilux_${storey} COMPONENT library)
  install(EXPORT hemilux_${storey} NAMESPACE hemilux:: DESTINATION ${package_folder} COMPONENT library)
  foreach(folder IN LISTS header_folders_of_${storey})
    cmake_path(GET folder PARENT_PATH parent)
    string(REPLACE "src" "${CMAKE_INSTALL_INCLUDEDIR}/hemilux" destination ${parent})
    install(DIRECTORY ${folder} DESTINATION ${destination} COMPONENT library
            FILES_MATCHING PATTERN "*.h" ${except_of_${storey}})
  endforeach()
endforeach()
if(TARGET hemilux)
  install(TARGETS hemilux EXPORT hemilux_hemilux COMPONENT library)
  install(EXPORT hemilux_hemilux NAMESPACE hemilux:: DESTINATION ${package_folder} COMPONENT library)
endif()
# The readers and writers that need no further package but zlib, as a component of their own.
if(TARGET hemilux_io)
  install(TARGETS hemilux_io EXPORT hemilux_io COMPONENT io)
  install(EXPORT hemilux_io NAMESPACE hemilux:: DESTINATION ${package_folder} COMPONENT io)
  install(DIRECTORY src/io DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hemilux COMPONENT io
          FILES_MATCHING PATTERN "*.h" PATTERN gltf EXCLUDE PATTERN scene_info_json.h EXCLUDE
          PATTERN glb.h EXCLUDE)
endif()
configure_package_config_file(cmake/hemiluxConfig.cmake.in ${PROJECT_BINARY_DIR}/hemiluxConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hemiluxConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hemiluxConfig.cmake ${PROJECT_BINARY_DIR}/hemiluxConfigVersion.cmake
        DESTINATION ${package_folder} COMPONENT library)
file(RELATIVE_PATH up_to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
set(libraries "")
foreach(storey IN LISTS storeys)
  string(PREPEND libraries "-lhemilux_${storey} ")
endforeach()
if(TARGET hemilux)
  string(PREPEND libraries "-lhemilux ")
endif()
configure_file(cmake/hemilux.pc.in hemilux.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/hemilux.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
        COMPONENT library)
if(HEMILUX_PROGRAM)
  install(TARGETS hemilux_program COMPONENT program)
  if(TARGET hemilux_mpi)
    install(TARGETS hemilux_mpi COMPONENT mpi DESTINATION ${CMAKE_INSTALL_LIBDIR}/hemilux)
  endif()
  set(texts ${PROJECT_BINARY_DIR}/texts)
  install(FILES ${texts}/hemilux.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program OPTIONAL)
  install(FILES ${texts}/hemilux.bash RENAME hemilux COMPONENT program OPTIONAL
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${texts}/_hemilux COMPONENT program OPTIONAL
          DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
  install(FILES ${texts}/hemilux.fish COMPONENT program OPTIONAL
          DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
  # The lesson, where scripts/lesson.sh has built it.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/build/lesson/site/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/lesson
          COMPONENT program OPTIONAL)
  # cpack in the build folder: an archive and, where Debian's tools are, a package (scripts/check_packages.sh,
  # scripts/check_deb.sh).
  set(CPACK_GENERATOR TGZ)
  find_program(DPKG_SHLIBDEPS dpkg-shlibdeps)
  mark_as_advanced(DPKG_SHLIBDEPS)
  if(DPKG_SHLIBDEPS)
    list(APPEND CPACK_GENERATOR DEB)
  endif()
  set(CPACK_COMPONENTS_ALL program)
  set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
  set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/PackageOptions.cmake)
  string(TOLOWER "hemilux-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}" CPACK_PACKAGE_FILE_NAME)
  set(CPACK_ARCHIVE_FILE_NAME ${CPACK_PACKAGE_FILE_NAME})
  set(CPACK_ARCHIVE_PROGRAM_FILE_NAME ${CPACK_PACKAGE_FILE_NAME})
  set(CPACK_DEB_COMPONENT_INSTALL ON)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME hemilux)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The hemilux developers")
  set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  set(CPACK_STRIP_FILES ON)
  include(CPack)
endif()
