# The first program has what a picture needs: it reads a scene, solves it by the default method and writes what
# `solve`, `bake` and `info` write. ./demo.sh builds it first and shows the room by it, then builds the rest. Both share
# their objects: those of a library LIBRARY that the first program needs are a library of objects LIBRARY_first.

# These files of src/ it does without. A file that it needs and that is named here is missed when it is linked.
set(HEMILUX_NOT_FIRST
  "radiosity/(answers/(surfaces|run/side_by_side)|research|light/cached_light/page|light/lamps/lamp_powers)"
  "radiosity/paper/(pages/(section_|step)|solving/mean_of_steps)"
  "radiosity/engine/(checks|factors/(points|rows)|heat|progressive)/"
  "radiosity/engine/densities/(cell_directions|subdivision_1997)"
  "radiosity/engine/factors/pairs/(convex|exchange|facing|free_|hidden|line|pair_)"
  "radiosity/engine/form_factors/(closed|factor_options|matrix_quality|sampled)"
  "radiosity/engine/linear/(batch|emitter_losses|gmres|hemicube|radiosity_system)"
  "radiosity/engine/methods/(cosine|hemisphere|matrix|monte_carlo|progressive|stratified)"
  "radiosity/engine/(shooting/(bounces|grouped|shooting|stepwise)|sparse/sparse_matrix)"
  "io/(drawings/(false_colour|hemisphere_svg|plane_svg)|files/stored_zip|meshes/factor_cells|pictures/exr_reader)"
  "io/results/(factor_|view_factor_)"
  "app/command_line/(compare|density|dim|formfactors|viewfactors)"
  "app/commands/(compare|density|dim|divided|formfactors|viewfactors)"
  "app/(factors/|lamps/dimmed|report/comparison|settings/factor_aim|subcommands/all)")

# Where CMAKE_UNITY_BUILD is on, the files of these folders are compiled together: each pattern is a unit of about
# 100 000 letters, so that two cores are done at the same time and headers are read a few times only.
set(HEMILUX_TOGETHER
  "geometry/|bvh/[^/]+$|radiosity/paper/"
  "bvh/wide/|parallel/|radiosity/engine/(rays|sampling|saving|solving|sparse|target)/"
  "radiosity/engine/(densities|form_factors|linear|needs|shooting)/"
  "radiosity/engine/(emitters|methods|stored_transport)/"
  "radiosity/engine/factors/rows/"
  "radiosity/engine/"
  "radiosity/light/(lamps|layers|sides|textures)/"
  "radiosity/light/polygons/"
  "radiosity/light/"
  "radiosity/research/"
  "radiosity/answers/(pictures|images|views)/"
  "radiosity/answers/(gathering|lamps|run|division|surfaces)/"
  "radiosity/answers/"
  "io/(files|pictures|textures)/"
  "io/scene_files/"
  "io/results/"
  "io/gltf/"
  "io/"
  "app/(command_line|settings)/"
  "app/(commands|gathering|lamps|outputs|report)/"
  "app/")

# hemilux_pattern_of(OUTPUT FILE PATTERN...): sets OUTPUT to the number, from 0, of the first pattern that the place of
# the file in src/ begins with; to NONE where it begins with none.
function(hemilux_pattern_of output file)
  cmake_path(RELATIVE_PATH file BASE_DIRECTORY ${PROJECT_SOURCE_DIR}/src)
  set(number 0)
  foreach(pattern IN LISTS ARGN)
    if(file MATCHES "^(${pattern})")
      set(${output} ${number} PARENT_SCOPE)
      return()
    endif()
    math(EXPR number "${number} + 1")
  endforeach()
  set(${output} NONE PARENT_SCOPE)
endfunction()

# hemilux_first_of(OUTPUT FILE...): sets OUTPUT to the files that the first program needs.
function(hemilux_first_of output)
  set(first "")
  foreach(file IN LISTS ARGN)
    hemilux_pattern_of(found ${file} ${HEMILUX_NOT_FIRST})
    if(found STREQUAL "NONE")
      list(APPEND first ${file})
    endif()
  endforeach()
  set(${output} ${first} PARENT_SCOPE)
endfunction()

# hemilux_compile_together(TARGET FILE...): makes these groups of the files of a target. Those of the first program are
# apart, also where there is none, so that a unit has the same files in all builds.
function(hemilux_compile_together target)
  hemilux_first_of(first ${ARGN})
  foreach(file IN LISTS ARGN)
    hemilux_pattern_of(unit ${file} ${HEMILUX_TOGETHER})
    if(file IN_LIST first)
      string(APPEND unit _first)
    endif()
    set_source_files_properties(${file} PROPERTIES UNITY_GROUP ${unit})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

# hemilux_add_library(TARGET FILE...): adds a library, and sets `parts` to the targets that compile its files: itself
# and, where there is a first program, TARGET_first.
function(hemilux_add_library target)
  hemilux_first_of(first ${ARGN})
  set(parts ${target})
  if(HEMILUX_PROGRAM AND PROJECT_IS_TOP_LEVEL AND first)
    list(PREPEND parts ${target}_first)
    list(REMOVE_ITEM ARGN ${first})
    add_library(${target}_first OBJECT ${first})
    # What its files include stands on no other library: these are built later.
    target_include_directories(${target}_first PRIVATE src)
    target_link_libraries(${target}_first PRIVATE glm::glm)
    set_target_properties(${target}_first PROPERTIES POSITION_INDEPENDENT_CODE ${HEMILUX_PYTHON})
    hemilux_compile_together(${target}_first ${first})
    set(objects $<TARGET_OBJECTS:${target}_first>)
  endif()
  add_library(${target} ${ARGN} ${objects})
  set_target_properties(${target} PROPERTIES LINKER_LANGUAGE CXX)
  hemilux_compile_together(${target} ${ARGN})
  # Headers that are read once for all files, which still include what they use.
  if(PROJECT_IS_TOP_LEVEL)
    get_property(of_headers GLOBAL PROPERTY HEMILUX_OF_HEADERS)
    foreach(part IN LISTS parts)
      if(of_headers)
        target_precompile_headers(${part} REUSE_FROM ${of_headers})
      else()
        set(of_headers ${part})
        set_property(GLOBAL PROPERTY HEMILUX_OF_HEADERS ${part})
        target_precompile_headers(${part} PRIVATE <glm/glm.hpp>
          <algorithm> <array> <cmath> <filesystem> <functional> <memory> <optional> <span> <string> <vector>)
      endif()
    endforeach()
  endif()
  set(parts ${parts} PARENT_SCOPE)
endfunction()
