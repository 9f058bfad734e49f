// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/PieceCutter.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

constexpr int kMostParts = 1024; // of a segment
constexpr int kMostSides = 32;   // parts of a triangle's edge
constexpr double kRounding = 1e-9;

int partsOf(double length, double longest, int most)
{
  return static_cast<int>(std::clamp(std::ceil(length / longest - kRounding), 1.0, double(most)));
}

// What the corners of an element have, weighted.
template <std::size_t N>
struct Weighted
{
  std::array<double, N> weights;

  template <typename Values>
  auto operator()(const Values& values) const
  {
    typename Values::value_type sum = weights[0] * values[0];
    for (std::size_t k = 1; k < N; ++k)
    {
      sum += weights[k] * values[k];
    }
    return sum;
  }
};

class Cutter
{
public:
  explicit Cutter(const GroupedElements& elements)
    : elements_(elements), nextPoint_(static_cast<std::int32_t>(elements.points.size()))
  {
  }

  CutPieces cut()
  {
    for (std::size_t k = 0; k < elements_.segments.size();)
    {
      k = this->addSegments(k);
    }
    for (std::size_t k = 0; k < elements_.triangles.size();)
    {
      k = this->addTriangles(k);
    }
    return std::move(pieces_);
  }

private:
  const Vec3& point(std::int32_t k) const { return elements_.points[static_cast<std::size_t>(k)]; }
  double reach(std::int32_t k) const { return elements_.reaches[static_cast<std::size_t>(k)]; }
  double length(std::int32_t a, std::int32_t b) const
  {
    return 2.0 * (point(a) - point(b)).norm() / (reach(a) + reach(b));
  }
  double length(const GroupedElement<2>& segment) const
  {
    return this->length(segment.corners[0], segment.corners[1]);
  }
  template <std::size_t N>
  std::array<Vec3, N> cornersOf(const GroupedElement<N>& element) const
  {
    std::array<Vec3, N> corners;
    for (std::size_t k = 0; k < N; ++k)
    {
      corners[k] = this->point(element.corners[k]);
    }
    return corners;
  }

  std::uint32_t addPiece(const Vec3& center, double reach, bool isTriangle, std::int32_t group)
  {
    pieces_.places.push_back({ center, reach, isTriangle });
    pieces_.groups.push_back(group);
    return static_cast<std::uint32_t>(pieces_.places.size() - 1);
  }
  void touch(std::int32_t at, std::uint32_t piece)
  {
    pieces_.contacts.push_back({ at, piece, this->point(at) });
  }
  // The part from `from` to `to` of the way from a to b.
  void touchEdge(std::int32_t a, std::int32_t b, double from, double to, std::uint32_t piece)
  {
    pieces_.sides.push_back(
      a < b ? PieceSide{ a, b, from, to, piece } : PieceSide{ b, a, 1.0 - to, 1.0 - from, piece });
  }

  // One, cut, or some, together. \return the first behind.
  std::size_t addSegments(std::size_t first)
  {
    const auto& segments = elements_.segments;
    double whole = this->length(segments[first]);
    if (whole > PieceGraph::kPieceLength * (1.0 + kRounding))
    {
      this->cut(segments[first]);
      return first + 1;
    }
    std::size_t end = first + 1;
    while (end < segments.size() && segments[end].group == segments[first].group &&
      segments[end].corners[0] == segments[end - 1].corners[1] &&
      whole + this->length(segments[end]) <= PieceGraph::kPieceLength * (1.0 + kRounding))
    {
      whole += this->length(segments[end]);
      ++end;
    }
    this->join(first, end, whole);
    return end;
  }

  void join(std::size_t first, std::size_t end, double whole)
  {
    std::size_t at = first;
    double before = 0.0;
    while (at + 1 < end && before + this->length(elements_.segments[at]) < 0.5 * whole)
    {
      before += this->length(elements_.segments[at++]);
    }
    const GroupedElement<2>& middle = elements_.segments[at];
    const double u = std::clamp((0.5 * whole - before) / this->length(middle), 0.0, 1.0);
    const Weighted<2> where{ { 1.0 - u, u } };
    const std::uint32_t piece =
      this->addPiece(where(this->cornersOf(middle)), where(middle.reaches), false, middle.group);
    for (std::size_t k = first; k < end; ++k)
    {
      const GroupedElement<2>& segment = elements_.segments[k];
      const auto [a, b] = segment.corners;
      this->addElement(segment, { { 1.0, 0.0 } }, { { 0.0, 1.0 } }, piece);
      this->touch(a, piece);
      this->touch(b, piece);
      this->touchEdge(a, b, 0.0, 1.0, piece);
    }
  }

  void addElement(const GroupedElement<2>& segment, const Weighted<2>& from, const Weighted<2>& to,
    std::uint32_t piece)
  {
    const std::array<Vec3, 2> ends = this->cornersOf(segment);
    pieces_.segments.push_back(
      makeSegmentElement(from(ends), to(ends), from(segment.reaches), to(segment.reaches)));
    pieces_.segmentPieces.push_back(piece);
  }

  void cut(const GroupedElement<2>& segment)
  {
    pieces_.areWhole = false;
    const int parts = partsOf(this->length(segment), PieceGraph::kPieceLength, kMostParts);
    const std::array<Vec3, 2> ends = this->cornersOf(segment);
    const auto [a, b] = segment.corners;
    const auto at = [&](double u) { return Weighted<2>{ { 1.0 - u, u } }; };
    for (int k = 0; k < parts; ++k)
    {
      const double from = double(k) / parts;
      const double to = double(k + 1) / parts;
      const Weighted<2> middle = at((k + 0.5) / parts);
      const std::uint32_t piece =
        this->addPiece(middle(ends), middle(segment.reaches), false, segment.group);
      this->addElement(segment, at(from), at(to), piece);
      this->touchEdge(a, b, from, to, piece);
      if (k == 0)
      {
        this->touch(a, piece);
      }
      else
      {
        pieces_.contacts.push_back({ nextPoint_ - 1, piece, at(from)(ends) });
      }
      if (k + 1 == parts)
      {
        this->touch(b, piece);
      }
      else
      {
        pieces_.contacts.push_back({ nextPoint_++, piece, at(to)(ends) });
      }
    }
  }

  // Longest way between corners.
  double widthOf(const std::array<std::int32_t, 3>& corners) const
  {
    return std::max({ this->length(corners[0], corners[1]), this->length(corners[1], corners[2]),
      this->length(corners[2], corners[0]) });
  }

  // Of 4^k triangles as subdivision makes them: a quarter each at the corners, the last between.
  std::array<std::int32_t, 3> cornersOf(std::size_t first, std::size_t size) const
  {
    const auto& triangles = elements_.triangles;
    return size == 1
      ? triangles[first].corners
      : std::array<std::int32_t, 3>{ triangles[first].corners[0],
          triangles[first + size / 4].corners[0], triangles[first + size / 2].corners[0] };
  }

  // All of one group: in parts of as many as may be together. \return the first behind.
  std::size_t addTriangles(std::size_t first)
  {
    const auto& triangles = elements_.triangles;
    std::size_t end = first;
    while (end < triangles.size() && triangles[end].group == triangles[first].group)
    {
      ++end;
    }
    std::size_t most = 1;
    while (4 * most <= end - first && (end - first) % (4 * most) == 0 &&
      this->areNarrow(first, end, 4 * most))
    {
      most *= 4;
    }
    for (std::size_t k = first; k < end; k += most)
    {
      if (most > 1)
      {
        this->join(k, most);
      }
      else
      {
        this->cut(triangles[k]);
      }
    }
    return end;
  }

  bool areNarrow(std::size_t first, std::size_t end, std::size_t size) const
  {
    for (std::size_t k = first; k < end; k += size)
    {
      if (this->widthOf(this->cornersOf(k, size)) > PieceGraph::kPieceSide * (1.0 + kRounding))
      {
        return false;
      }
    }
    return true;
  }

  void join(std::size_t first, std::size_t size)
  {
    std::size_t middle = first;
    for (std::size_t part = size / 4; part > 0; part /= 4)
    {
      middle += 3 * part;
    }
    const Weighted<3> center{ { 1.0 / 3, 1.0 / 3, 1.0 / 3 } };
    const GroupedElement<3>& of = elements_.triangles[middle];
    const std::uint32_t piece =
      this->addPiece(center(this->cornersOf(of)), center(of.reaches), true, of.group);
    for (std::size_t k = first; k < first + size; ++k)
    {
      const GroupedElement<3>& triangle = elements_.triangles[k];
      pieces_.triangles.push_back(makeTriangleElement(this->cornersOf(triangle), triangle.reaches));
      pieces_.trianglePieces.push_back(piece);
      for (std::size_t corner = 0; corner < 3; ++corner)
      {
        const std::int32_t a = triangle.corners[corner];
        this->touch(a, piece);
        this->touchEdge(a, triangle.corners[(corner + 1) % 3], 0.0, 1.0, piece);
      }
    }
  }

  // Rows of triangles that stand, i along the first edge and j along the last, and hang between.
  void cut(const GroupedElement<3>& triangle)
  {
    const int sides = partsOf(this->widthOf(triangle.corners), PieceGraph::kPieceSide, kMostSides);
    pieces_.areWhole = pieces_.areWhole && sides == 1;
    const std::array<Vec3, 3> corners = this->cornersOf(triangle);
    const auto at = [&](double i, double j) {
      return Weighted<3>{ { 1.0 - (i + j) / sides, i / sides, j / sides } };
    };
    const std::int32_t base = nextPoint_;
    nextPoint_ += sides > 1 ? (sides + 1) * (sides + 1) : 0;
    const auto touchAt = [&](int i, int j, std::uint32_t piece)
    {
      const bool isCorner = (i == 0 || i == sides) && (j == 0 || j == sides);
      pieces_.contacts.push_back({ isCorner ? triangle.corners[i > 0 ? 1
                                                  : j > 0            ? 2
                                                                     : 0]
                                            : base + j * (sides + 1) + i,
        piece, at(i, j)(corners) });
    };
    const auto add = [&](int i, int j, int step)
    {
      const std::array<Weighted<3>, 3> where = { at(i, j), at(i + step, j), at(i, j + step) };
      const Weighted<3> center = at(i + step / 3.0, j + step / 3.0);
      const std::uint32_t piece =
        this->addPiece(center(corners), center(triangle.reaches), true, triangle.group);
      pieces_.triangles.push_back(
        makeTriangleElement({ where[0](corners), where[1](corners), where[2](corners) },
          { where[0](triangle.reaches), where[1](triangle.reaches), where[2](triangle.reaches) }));
      pieces_.trianglePieces.push_back(piece);
      touchAt(i, j, piece);
      touchAt(i + step, j, piece);
      touchAt(i, j + step, piece);
      return piece;
    };
    const auto touchEdge = [&](int corner, int k, std::uint32_t piece)
    {
      this->touchEdge(triangle.corners[std::size_t(corner)],
        triangle.corners[std::size_t(corner + 1) % 3], double(k) / sides, double(k + 1) / sides,
        piece);
    };
    for (int j = 0; j < sides; ++j)
    {
      for (int i = 0; i + j < sides; ++i)
      {
        const std::uint32_t standing = add(i, j, 1);
        if (j == 0)
        {
          touchEdge(0, i, standing);
        }
        if (i + j + 1 == sides)
        {
          touchEdge(1, j, standing);
        }
        if (i == 0)
        {
          touchEdge(2, sides - 1 - j, standing);
        }
        if (i + j + 1 < sides)
        {
          add(i + 1, j + 1, -1);
        }
      }
    }
  }

  const GroupedElements& elements_;
  std::int32_t nextPoint_; // behind the skeleton's points: those where parts of elements meet
  CutPieces pieces_;
};

} // namespace

CutPieces cutIntoPieces(const GroupedElements& elements)
{
  return Cutter(elements).cut();
}

} // namespace hybridtree
