# hemilux_add_kernels(TARGET): compiles the kernels into the target, once per instruction set. Those of
# rays filter only, and doubles decide (wide_layout.h), so contraction does not show in any result;
# those of samples decide, and nothing is contracted.
include(CheckCXXCompilerFlag)
function(hemilux_add_kernels target)
  check_cxx_compiler_flag("-mavx512f -mavx512dq -mavx512bw -mavx512vl -mavx2 -mfma" HEMILUX_HAS_AVX512)
  set(instruction_sets baseline)
  if(HEMILUX_X86_KERNELS AND HEMILUX_HAS_AVX512)
    list(APPEND instruction_sets avx2 avx512)
    set_source_files_properties(src/parallel/instruction_set.cpp src/bvh/wide/kernel_choice.cpp
                                src/radiosity/engine/sampling/kernel_choice.cpp
                                PROPERTIES COMPILE_DEFINITIONS HEMILUX_X86_KERNELS)
  endif()
  set(flags_of_avx2 -mavx2 -mfma)
  set(flags_of_avx512 -mavx2 -mfma -mavx512f -mavx512dq -mavx512bw -mavx512vl -mprefer-vector-width=512
      -Wno-uninitialized $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>) # GCC bug 105593, in its own header
  foreach(set IN LISTS instruction_sets)
    set(ray_kernels src/bvh/wide/kernels/${set}.cpp)
    set(sampling_kernels src/radiosity/engine/sampling/kernels/${set}.cpp)
    set_source_files_properties(${ray_kernels} PROPERTIES COMPILE_OPTIONS
                                "${flags_of_${set}};-ffp-contract=fast;-fno-math-errno")
    # -O3: without it g++ leaves loops as they are.
    set_source_files_properties(${sampling_kernels} PROPERTIES COMPILE_OPTIONS
                                "${flags_of_${set}};-O3;-fno-math-errno;-fno-trapping-math")
    # They have flags of their own.
    set_source_files_properties(${ray_kernels} ${sampling_kernels} PROPERTIES
                                SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
    target_sources(${target} PRIVATE ${ray_kernels} ${sampling_kernels})
  endforeach()
endfunction()
