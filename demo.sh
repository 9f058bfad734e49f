#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Sets up what is missing, builds, and runs the examples: a scan is reconstructed, blended, cut and
# bent. Pictures, meshes and ParaView state files go to demo-output/, or to the folder given:
#   ./demo.sh [folder]
set -euo pipefail
if [ $# -gt 1 ] || [[ "${1:-}" == -* ]]; then
  echo "usage: ./demo.sh [folder for the results, default demo-output]" >&2
  exit 2
fi
source "$(dirname "${BASH_SOURCE[0]}")/scripts/setup.sh"

setup
output="$(realpath -m "${1:-$project_dir/demo-output}")"
mkdir -p "$output"
export HYBRIDTREE_PLUGIN="$build_dir/lib/paraview-5.11/plugins/HybridTree/HybridTree.so"
for example in kitten restoration; do
  say "running examples/python/$example.py"
  with_display pvpython "$project_dir/examples/python/$example.py" "$output"
done
say "running examples/cpp/jug.cxx"
mkdir -p "$output/cpp"
"$build_dir/bin/jug" "$output/kitten/kitten.vtp" "$output/kitten/knot2.vtp" "$output/cpp"
say "done, see $output"
