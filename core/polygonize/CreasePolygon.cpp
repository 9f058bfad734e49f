// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/CreasePolygon.h"

namespace hybridtree
{
namespace
{

// All in cells.
constexpr double kBeyondSide = 0.1;   // that the crease may pass a wall beside the cell
constexpr double kInWall = 1e-6;      // of the ends of a side
constexpr double kLeastHeight = 0.02; // of the triangles around the point
constexpr double kFarthest = 1.2;     // that the point may be moved

} // namespace

CreasePolygon::CreasePolygon(
  const TriangleMesh& mesh, const Lattice& lattice, const CreaseLoop& loop, double leastCosine)
  : mesh_(mesh), loop_(loop), leastCosine_(leastCosine), size_(lattice.cellSize)
{
  const Vec3 low = lattice.point(loop.cell);
  cell_ = Box3(low, Vec3(low + Vec3::Constant(size_)));
}

Vec3 CreasePolygon::middle() const
{
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < this->size(); ++k)
  {
    sum += this->corner(k);
  }
  return sum / static_cast<double>(this->size());
}

bool CreasePolygon::isAcross(std::size_t k) const
{
  return normals_[k].dot(normals_[(k + 1) % normals_.size()]) < leastCosine_;
}

/// Where the edge of the planes at the ends of a side passes the wall with the side.
std::optional<Vec3> CreasePolygon::passageAt(std::size_t k, const TouchingPlanes& planes) const
{
  if (!this->isAcross(k))
  {
    return std::nullopt;
  }
  const Vec3& from = this->corner(k);
  const Vec3& to = this->corner(k + 1);
  const TouchingPlane& a = planes[k];
  const TouchingPlane& b = planes[(k + 1) % planes.size()];
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double wall : { cell_.min()[axis], cell_.max()[axis] })
    {
      if (std::max(std::abs(from[axis] - wall), std::abs(to[axis] - wall)) <= kInWall * size_)
      {
        Mat3 matrix;
        matrix << a.normal.transpose(), b.normal.transpose(), Vec3::Unit(axis).transpose();
        const Vec3 passage =
          matrix.inverse() * Vec3(a.normal.dot(a.at) + a.ahead, b.normal.dot(b.at) + b.ahead, wall);
        const bool near = this->beyondCell(passage) <= kBeyondSide * size_;
        return near ? std::optional<Vec3>(passage) : std::nullopt;
      }
    }
  }
  return std::nullopt;
}

std::optional<Vec3> CreasePolygon::halfWay(const TouchingPlanes& planes) const
{
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (std::size_t k = 0; k < this->size(); ++k)
  {
    if (const std::optional<Vec3> passage = this->passageAt(k, planes))
    {
      sum += *passage;
      ++count;
    }
  }
  return count == 2 ? std::optional<Vec3>(0.5 * sum) : std::nullopt;
}

double CreasePolygon::toMiddle(const Meeting& meeting) const
{
  LinePart within;
  for (int axis = 0; axis < 3; ++axis)
  {
    within.clip(meeting.point[axis] - cell_.min()[axis], meeting.edge[axis]);
    within.clip(cell_.max()[axis] - meeting.point[axis], -meeting.edge[axis]);
  }
  return within.empty() ? 0.0 : within.middle();
}

double CreasePolygon::toUpright(const Meeting& meeting) const
{
  for (const bool all : { true, false })
  {
    const LinePart upright = this->partUpright(meeting, all);
    if (!upright.empty())
    {
      return upright.nearest(0.0);
    }
  }
  return 0.0;
}

LinePart CreasePolygon::partUpright(const Meeting& meeting, bool all) const
{
  LinePart part{ -kFarthest * size_, kFarthest * size_ };
  for (std::size_t k = 0; k < this->size(); ++k)
  {
    if (all || !this->isAcross(k))
    {
      const Vec3 up = normals_[k] + normals_[(k + 1) % normals_.size()];
      const Vec3 inward = up.cross(this->corner(k + 1) - this->corner(k)).normalized();
      part.clip(inward.dot(meeting.point - this->corner(k)) - kLeastHeight * size_,
        inward.dot(meeting.edge));
    }
  }
  return part;
}

} // namespace hybridtree
