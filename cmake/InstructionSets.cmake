# Which instruction sets are compiled for (docs/decisions/instruction-sets.md).
#
#   sessile_isas            those the program is built for, the best first; the last one is the baseline
#   sessile_baseline        the one that every processor of the kind has; empty where only "native" is known
#   SESSILE_ARCH            the one of the library target, and of tests and benchmarks, which link it
#   sessile_compile_for()   compiles a target for one of them

set(sessile_isas x86-64-v4 x86-64-v3 x86-64)
set(sessile_baseline x86-64)
if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$" OR CMAKE_SIZEOF_VOID_P EQUAL 4)
  set(sessile_isas)
  set(sessile_baseline)
  set(SESSILE_VARIANTS OFF)
  if(SESSILE_ARCH MATCHES "^x86-64") # of a preset
    set(SESSILE_ARCH native)
  endif()
endif()

# The best of them that the machine at hand has, by what the compiler defines for it.
function(sessile_best_isa result)
  set(${result} native PARENT_SCOPE)
  if(NOT sessile_isas)
    return()
  endif()
  set(${result} ${sessile_baseline} PARENT_SCOPE)
  if(CMAKE_CROSSCOMPILING)
    return()
  endif()
  separate_arguments(command UNIX_COMMAND "${CMAKE_CXX_COMPILER} -march=native -dM -E -x c++ /dev/null")
  execute_process(COMMAND ${command} OUTPUT_VARIABLE macros ERROR_QUIET)
  foreach(feature AVX AVX2 FMA BMI BMI2 F16C LZCNT MOVBE)
    if(NOT macros MATCHES "#define __${feature}__ 1")
      return()
    endif()
  endforeach()
  set(${result} x86-64-v3 PARENT_SCOPE)
  foreach(feature AVX512F AVX512BW AVX512CD AVX512DQ AVX512VL)
    if(NOT macros MATCHES "#define __${feature}__ 1")
      return()
    endif()
  endforeach()
  set(${result} x86-64-v4 PARENT_SCOPE)
endfunction()

if(NOT DEFINED CACHE{SESSILE_ARCH})
  sessile_best_isa(best)
  set(SESSILE_ARCH ${best} CACHE STRING "Instruction set of the library, as -march names it: x86-64-v4, x86-64-v3, x86-64, native ...")
endif()
if(NOT SESSILE_ARCH)
  message(FATAL_ERROR "SESSILE_ARCH is empty: name an instruction set as -march does, or leave it out")
endif()

function(sessile_compile_for isa target)
  if(isa)
    target_compile_options(${target} PRIVATE -march=${isa})
  endif()
endfunction()
