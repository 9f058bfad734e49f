// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <optional>
#include <string>

namespace hybridtree::test
{

/// Closed meshes oriented outward, made from formulas.
///@{
TriangleMesh icosphere(double radius, int subdivisions, const Vec3& center = Vec3::Zero());
TriangleMesh torus(double ringRadius, double tubeRadius, int around, int across);
/// Twelve triangles; all coordinates exact where the arguments are.
TriangleMesh box(const Vec3& lower, const Vec3& upper);
/// A sphere with bumps and dents: concave, with edges of very different sharpness.
TriangleMesh bumpySphere(double radius, int subdivisions);
/// Thin shell: two nested spheres, the inner one turned to bound a cavity.
TriangleMesh hollowSphere(double outer, double inner, int subdivisions);
///@}

/// The mesh with some triangles missing.
TriangleMesh withoutTriangles(TriangleMesh mesh, std::size_t first, std::size_t count);

/// Both meshes, one after the other; nothing is welded.
TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b);

/// A triangle mesh of Debian's libcgal-demo, such as "elephant.off"; empty when the package is not
/// there (the caller then skips, and says so).
std::optional<TriangleMesh> demoMesh(const std::string& name);

} // namespace hybridtree::test
