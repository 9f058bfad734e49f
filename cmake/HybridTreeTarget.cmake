# SPDX-License-Identifier: BSD-3-Clause
# What every library, module and program of ours has in common: warnings.
function(hybridtree_target_defaults target)
  # A VTK module is known by its alias, HybridTree::Filters.
  get_target_property(aliased ${target} ALIASED_TARGET)
  if(aliased)
    set(target ${aliased})
  endif()
  target_compile_options(${target} PRIVATE
    $<$<COMPILE_LANGUAGE:CXX>:-Wall;-Wextra;-Wpedantic>
    $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<BOOL:${HYBRIDTREE_WARNINGS_AS_ERRORS}>>:-Werror>)
endfunction()
