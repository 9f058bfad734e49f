// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/AddTriangle.h"
#include "core/skeletons/BoxGrid.h"
#include "core/skeletons/OffsetMesh.h"

#include <array>
#include <cmath>

namespace hybridtree
{
namespace
{

using Index3 = std::array<int, 3>;

class TriangleList
{
public:
  TriangleList(std::vector<Triangle>& triangles, bool mirrored)
    : triangles_(triangles), mirrored_(mirrored)
  {
  }

  void add(int a, int b, int c, bool flip)
  {
    const bool other = flip != mirrored_;
    addTriangle(triangles_, a, other ? c : b, other ? b : c);
  }

  // A cell with corners in this cyclic order, cut from a to c or from b to d.
  void addCell(int a, int b, int c, int d, bool fromA, bool flip)
  {
    if (fromA)
    {
      this->add(a, b, c, flip);
      this->add(a, c, d, flip);
    }
    else
    {
      this->add(a, b, d, flip);
      this->add(b, c, d, flip);
    }
  }

private:
  std::vector<Triangle>& triangles_;
  bool mirrored_;
};

// The six faces as grids of m cells a side, cut towards the middle so that mirror images agree.
// id(axis, positive, u) is the point of the face at grid position u.
template <class Id>
void addFaces(const Index3& m, const Id& id, TriangleList& list)
{
  for (int a = 0; a < 3; ++a)
  {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    for (const bool positive : { false, true })
    {
      const auto at = [&](int ub, int uc)
      {
        Index3 u;
        u[a] = positive ? m[a] : 0;
        u[b] = ub;
        u[c] = uc;
        return id(a, positive, u);
      };
      for (int ub = 0; ub < m[b]; ++ub)
      {
        for (int uc = 0; uc < m[c]; ++uc)
        {
          const bool fromA = (2 * ub + 1 < m[b]) == (2 * uc + 1 < m[c]);
          list.addCell(
            at(ub, uc), at(ub + 1, uc), at(ub + 1, uc + 1), at(ub, uc + 1), fromA, !positive);
        }
      }
    }
  }
}

} // namespace

TriangleMesh meshSharpBox(const BoxShape& box, double edgeLength)
{
  const Vec3 cells = (box.half * (2.0 * std::sqrt(2.0) / edgeLength)).array().ceil();
  requireModestCount(
    4.0 * (cells[0] * cells[1] + cells[1] * cells[2] + cells[2] * cells[0]), edgeLength);
  const Index3 m = { static_cast<int>(cells[0]), static_cast<int>(cells[1]),
    static_cast<int>(cells[2]) };

  // Bottom and top are full grids of points, the layers between them closed loops.
  const int layer = (m[0] + 1) * (m[1] + 1);
  const int loop = 2 * (m[0] + m[1]);
  const auto id = [&](const Index3& u)
  {
    if (u[2] == 0 || u[2] == m[2])
    {
      return (u[2] == 0 ? 0 : layer) + u[1] * (m[0] + 1) + u[0];
    }
    const int along = u[1] == 0 ? u[0]
      : u[0] == m[0]            ? m[0] + u[1]
      : u[1] == m[1]            ? m[0] + m[1] + (m[0] - u[0])
                                : 2 * m[0] + m[1] + (m[1] - u[1]);
    return 2 * layer + (u[2] - 1) * loop + along;
  };

  TriangleMesh mesh;
  const std::size_t count = static_cast<std::size_t>(2 * layer + (m[2] - 1) * loop);
  mesh.points.resize(count);
  mesh.normals.assign(count, Vec3::Zero());
  TriangleList list(mesh.triangles, box.axes.determinant() < 0.0);
  addFaces(
    m,
    [&](int a, bool positive, const Index3& u)
    {
      const int point = id(u);
      const std::size_t k = static_cast<std::size_t>(point);
      Vec3 local;
      for (int b = 0; b < 3; ++b)
      {
        local[b] = gridCoordinate(u[b], m[b], box.half[b]);
      }
      mesh.points[k] = box.center + box.axes * local;
      // Each face once, however many of its cells ask.
      const Vec3 outward = positive ? Vec3(box.axes.col(a)) : Vec3(-box.axes.col(a));
      if (!(mesh.normals[k].dot(outward) > 0.5))
      {
        mesh.normals[k] += outward;
      }
      return point;
    },
    list);
  for (Vec3& normal : mesh.normals)
  {
    normal.normalize();
  }
  return mesh;
}

} // namespace hybridtree
