#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Sets up what is missing, builds, and runs every test. Arguments go to ctest, as in
#   ./test.sh -L core
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/scripts/setup.sh"

setup -DHYBRIDTREE_BUILD_TESTS=ON -DHYBRIDTREE_WARNINGS_AS_ERRORS=ON
say "testing"
ctest --test-dir "$build_dir" --output-on-failure -j "$(nproc)" "$@"
