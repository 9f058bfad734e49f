# SPDX-License-Identifier: BSD-3-Clause
# What every library and program of ours has in common: warnings, and the source tree as include root
# so that headers are named by their full path ("core/nodes/Blend.h").
function(hybridtree_target_defaults target)
  target_compile_options(${target} PRIVATE
    $<$<COMPILE_LANGUAGE:CXX>:-Wall;-Wextra;-Wpedantic>
    $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<BOOL:${HYBRIDTREE_WARNINGS_AS_ERRORS}>>:-Werror>)
endfunction()
