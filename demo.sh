#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Sets up what is missing, builds, and runs the examples: a scan is reconstructed, blended, cut and
# bent. Pictures, meshes and ParaView state files go to demo-output/, or to the folder given.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/scripts/setup.sh"

setup
