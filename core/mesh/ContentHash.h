// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <cstdint>
#include <string>

namespace hybridtree
{

/// 64-bit hash over the points and triangles of a mesh, bit for bit; the optional arrays do not
/// count. The same on every machine of one byte order. Not cryptographic: it tells a changed mesh
/// from an unchanged one, it does not defend against forgery.
std::uint64_t contentHash(const TriangleMesh& mesh);

///@{
/// The hash as 16 lower-case hexadecimal digits; of a shared mesh, which nobody changes, found
/// once.
std::string contentHashText(const TriangleMesh& mesh);
std::string contentHashText(const MeshPtr& mesh);
///@}

} // namespace hybridtree
