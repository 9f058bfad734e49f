// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <memory>
#include <string>

namespace hybridtree::benchmark
{

/// Points and faces of an OFF file, polygons as fans, unchecked; null where it is none.
std::unique_ptr<TriangleMesh> readOff(const std::string& file);

} // namespace hybridtree::benchmark
