// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/SkeletonPieces.h"

namespace hybridtree
{
namespace
{

class Finder
{
public:
  Finder(const SkeletonGraph& graph, const SkeletonTopology& topology)
    : graph_(graph)
    , topology_(topology)
    , segmentDone_(graph.segments.size(), false)
    , triangleDone_(graph.triangles.size(), false)
  {
  }

  SkeletonPieces find()
  {
    SkeletonPieces pieces;
    // The numbers of pieces are those of their first segments, but a curve begins at an end of it.
    for (std::size_t s = 0; s < graph_.segments.size(); ++s)
    {
      if (!segmentDone_[s])
      {
        pieces.curves.push_back(curveThrough(std::int32_t(s)));
      }
    }
    for (std::size_t t = 0; t < graph_.triangles.size(); ++t)
    {
      if (!triangleDone_[t])
      {
        pieces.surfaces.push_back(surfaceFrom(std::int32_t(t)));
      }
    }
    return pieces;
  }

private:
  // The segment behind `point`, coming from `before`; -1 at the end of the curve.
  std::int32_t segmentBeyond(std::int32_t before, std::int32_t point) const
  {
    const std::int32_t next = topology_.vertices()[point].beyond(before);
    for (auto [e, end] = topology_.edgesAt(point); e != end; ++e)
    {
      const SkeletonEdge& edge = topology_.edges()[*e];
      if (edge.otherEnd(point) == next)
      {
        return edge.segment;
      }
    }
    return -1;
  }

  // Goes on from `point`, until the curve ends or comes back to segment `first`.
  void follow(std::int32_t before, std::int32_t point, std::int32_t first, CurvePiece& curve) const
  {
    for (std::int32_t s = segmentBeyond(before, point); s >= 0; s = segmentBeyond(before, point))
    {
      if (s == first)
      {
        curve.closed = true;
        return;
      }
      before = point;
      point = graph_.segments[s][graph_.segments[s][0] == point ? 1 : 0];
      curve.segments.push_back(s);
      curve.points.push_back(point);
    }
  }

  CurvePiece curveThrough(std::int32_t first)
  {
    const auto [a, b] = graph_.segments[first];
    CurvePiece curve{ { first }, { a, b } };
    follow(a, b, first, curve);
    if (!curve.closed)
    {
      // Anew from the other end, which makes the order independent of where one began.
      const std::size_t last = curve.points.size() - 1;
      CurvePiece whole{ { curve.segments.back() }, { curve.points[last], curve.points[last - 1] } };
      follow(curve.points[last], curve.points[last - 1], curve.segments.back(), whole);
      curve = std::move(whole);
    }
    for (const std::int32_t s : curve.segments)
    {
      segmentDone_[s] = true;
    }
    return curve;
  }

  SurfacePiece surfaceFrom(std::int32_t first)
  {
    SurfacePiece surface{ { first } };
    triangleDone_[first] = true;
    for (std::size_t k = 0; k < surface.triangles.size(); ++k)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        const std::int32_t e = topology_.triangleEdge(surface.triangles[k], corner);
        for (const std::int32_t t : topology_.edges()[e].triangles)
        {
          if (t >= 0 && !triangleDone_[t])
          {
            triangleDone_[t] = true;
            surface.triangles.push_back(t);
          }
        }
      }
    }
    return surface;
  }

  const SkeletonGraph& graph_;
  const SkeletonTopology& topology_;
  std::vector<bool> segmentDone_;
  std::vector<bool> triangleDone_;
};

} // namespace

SkeletonPieces findPieces(const SkeletonGraph& graph, const SkeletonTopology& topology)
{
  return Finder(graph, topology).find();
}

PieceNumbers numberPieces(const SkeletonGraph& graph)
{
  const SkeletonPieces pieces = findPieces(graph, SkeletonTopology(graph));
  PieceNumbers numbers;
  numbers.segments.resize(graph.segments.size());
  numbers.triangles.resize(graph.triangles.size());
  for (const CurvePiece& curve : pieces.curves)
  {
    for (const std::int32_t s : curve.segments)
    {
      numbers.segments[std::size_t(s)] = numbers.count;
    }
    ++numbers.count;
  }
  for (const SurfacePiece& surface : pieces.surfaces)
  {
    for (const std::int32_t t : surface.triangles)
    {
      numbers.triangles[std::size_t(t)] = numbers.count;
    }
    ++numbers.count;
  }
  return numbers;
}

} // namespace hybridtree
