// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/TriangleSides.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

/// Both ends as one number; -1 comes first.
std::uint64_t keyOf(const TriangleSide& side)
{
  return std::uint64_t(std::uint32_t(side.from) + 1u) << 32 | (std::uint32_t(side.to) + 1u);
}

bool isBefore(const TriangleSide& a, const TriangleSide& b)
{
  return keyOf(a) < keyOf(b);
}

} // namespace

void TriangleSides::add(const TriangleMesh& mesh, std::size_t triangle)
{
  const Triangle& c = mesh.triangles[triangle];
  for (int k = 0; k < 3; ++k)
  {
    sides_.push_back({ c[k], c[(k + 1) % 3], triangle });
  }
}

void TriangleSides::sort()
{
  // Inlined, as a pointer to the function would not be.
  std::sort(sides_.begin(), sides_.end(),
    [](const TriangleSide& a, const TriangleSide& b) { return isBefore(a, b); });
}

const TriangleSide* TriangleSides::find(std::int32_t from, std::int32_t to) const
{
  const auto found = std::lower_bound(sides_.begin(), sides_.end(), TriangleSide{ from, to, 0 },
    [](const TriangleSide& a, const TriangleSide& b) { return isBefore(a, b); });
  return found != sides_.end() && found->from == from && found->to == to ? &*found : nullptr;
}

bool TriangleSides::isOpenAt(std::int32_t point) const
{
  auto side =
    std::lower_bound(sides_.begin(), sides_.end(), TriangleSide{ point, -1, 0 }, isBefore);
  while (side != sides_.end() && side->from == point && this->twinOf(*side))
  {
    ++side;
  }
  return side != sides_.end() && side->from == point;
}

std::int32_t cornerOpposite(const TriangleMesh& mesh, const TriangleSide& side)
{
  const Triangle& c = mesh.triangles[side.triangle];
  return *std::find_if(
    c.begin(), c.end(), [&](std::int32_t v) { return v != side.from && v != side.to; });
}

void dropTriangles(TriangleMesh& mesh, const std::vector<bool>& removed)
{
  const std::size_t count = mesh.triangles.size();
  const auto isGone = [&](std::size_t t) { return t < removed.size() && removed[t]; };
  std::size_t kept = 0;
  for (std::size_t t = 0; t < count; ++t)
  {
    if (!isGone(t))
    {
      mesh.triangles[kept++] = mesh.triangles[t];
    }
  }
  mesh.triangles.resize(kept);
  for (std::vector<std::int32_t>* array : { &mesh.sourceLeaf, &mesh.sourceTriangle })
  {
    if (!array->empty())
    {
      array->resize(count, -1);
      std::size_t next = 0;
      for (std::size_t t = 0; t < count; ++t)
      {
        if (!isGone(t))
        {
          (*array)[next++] = (*array)[t];
        }
      }
      array->resize(kept);
    }
  }
}

} // namespace hybridtree
