# SPDX-License-Identifier: BSD-3-Clause
# What every library, module and program of ours has in common: warnings.
#
#   hybridtree_target_defaults(<target> [VTK])
#
# VTK: the target includes headers of VTK classes, ours or others'. A VTK module, known by its alias
# HybridTree::Filters, always does.
function(hybridtree_target_defaults target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "VTK" "" "")
  get_target_property(aliased ${target} ALIASED_TARGET)
  if(aliased)
    set(target ${aliased})
  endif()
  # VTK's class macros end in "public:", and the semicolon that all code puts behind them is one too
  # many for -Wpedantic.
  if(NOT aliased AND NOT arg_VTK)
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-Wpedantic>)
  endif()
  target_compile_options(${target} PRIVATE
    $<$<COMPILE_LANGUAGE:CXX>:-Wall;-Wextra>
    $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<BOOL:${HYBRIDTREE_WARNINGS_AS_ERRORS}>>:-Werror>)
endfunction()
