// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/CompactResult.h"

#include <array>
#include <utility>

namespace hybridtree
{
namespace
{

class Compactor
{
public:
  Compactor(MeshBooleanResult& result, const std::vector<std::int32_t>& becomes)
    : result_(result), mesh_(result.mesh), becomes_(becomes), place_(result.mesh.points.size(), -1)
  {
  }

  void run()
  {
    this->compactTriangles();
    this->compactPoints();
    for (Triangle& corner : mesh_.triangles)
    {
      for (std::int32_t& point : corner)
      {
        point = place_[std::size_t(point)];
      }
    }
    this->compactCurves();
  }

private:
  void compactTriangles()
  {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      const Triangle corner = mesh_.triangles[t];
      if (corner[0] < 0)
      {
        continue;
      }
      for (const std::int32_t point : corner)
      {
        place_[std::size_t(point)] = 0;
      }
      mesh_.triangles[kept] = corner;
      result_.sourceOperand[kept] = result_.sourceOperand[t];
      result_.sourceTriangle[kept++] = result_.sourceTriangle[t];
    }
    mesh_.triangles.resize(kept);
    result_.sourceOperand.resize(kept);
    result_.sourceTriangle.resize(kept);
  }

  void compactPoints()
  {
    std::array<std::size_t, 3> count{};
    const std::size_t firstOfB = result_.firstOfB;
    const std::size_t firstCut = result_.firstCut;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < place_.size(); ++k)
    {
      if (place_[k] < 0)
      {
        continue;
      }
      const std::size_t kind = k < firstOfB ? 0 : k < firstCut ? 1 : 2;
      if (kind < 2)
      {
        result_.sourcePoint[kept] = result_.sourcePoint[k];
      }
      else
      {
        result_.cutPoints[count[2]] = result_.cutPoints[k - firstCut];
      }
      ++count[kind];
      mesh_.points[kept] = mesh_.points[k];
      place_[k] = std::int32_t(kept++);
    }
    mesh_.points.resize(kept);
    result_.firstOfB = count[0];
    result_.firstCut = count[0] + count[1];
    result_.sourcePoint.resize(result_.firstCut);
    result_.cutPoints.resize(count[2]);
  }

  std::int32_t lastOf(std::int32_t point) const
  {
    while (becomes_[std::size_t(point)] != point)
    {
      point = becomes_[std::size_t(point)];
    }
    return point;
  }

  void compactCurves()
  {
    std::vector<std::vector<std::int32_t>> curves;
    for (const std::vector<std::int32_t>& curve : result_.curves)
    {
      std::vector<std::int32_t> now;
      for (const std::int32_t old : curve)
      {
        const std::int32_t point = place_[std::size_t(this->lastOf(old))];
        if (point >= 0 && (now.empty() || now.back() != point))
        {
          now.push_back(point);
        }
      }
      if (now.size() > 1)
      {
        curves.push_back(std::move(now));
      }
    }
    result_.curves = std::move(curves);
  }

  MeshBooleanResult& result_;
  TriangleMesh& mesh_;
  const std::vector<std::int32_t>& becomes_;
  std::vector<std::int32_t> place_; // per point: its new number, -1 for one that goes
};

} // namespace

void compactResult(MeshBooleanResult& result, const std::vector<std::int32_t>& becomes)
{
  Compactor(result, becomes).run();
}

} // namespace hybridtree
