// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/PlanarRegion.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

// Parameters in (0, 1) where y stands still, between 0 and 1.
std::vector<double> cutsOf(const CubicSpan& span)
{
  std::vector<double> cuts{ 0.0 };
  const double d0 = span.control[1].at.y() - span.control[0].at.y();
  const double d1 = span.control[2].at.y() - span.control[1].at.y();
  const double d2 = span.control[3].at.y() - span.control[2].at.y();
  const double a = d0 - 2.0 * d1 + d2;
  const double b = d1 - d0; // y' / 3 = a t^2 + 2 b t + d0
  const double discriminant = b * b - a * d0;
  if (discriminant >= 0.0)
  {
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    for (const double root : { q / a, d0 / q })
    {
      if (root > 0.0 && root < 1.0) // false for NaN
      {
        cuts.push_back(root);
      }
    }
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.push_back(1.0);
  return cuts;
}

} // namespace

PlanarRegion::PlanarRegion(const std::vector<CubicSpan>& spans) : spans_(spans)
{
  for (std::size_t k = 0; k < spans.size(); ++k)
  {
    const CubicSpan& span = spans[k];
    const std::vector<double> cuts = cutsOf(span);
    // Ends are the control points themselves, which neighbours share.
    double y = span.control[0].at.y();
    for (std::size_t c = 1; c < cuts.size(); ++c)
    {
      const double next = c + 1 == cuts.size() ? span.control[3].at.y() : span.at(cuts[c]).at.y();
      const Box3 box = span.part(cuts[c - 1], cuts[c]).bounds();
      pieces_.push_back({ cuts[c - 1], cuts[c], y, next, box.min().x(), box.max().x(), k });
      y = next;
    }
  }
}

bool PlanarRegion::contains(double x, double y) const
{
  bool inside = false;
  for (const Piece& piece : pieces_)
  {
    // An end belongs to the part above it: each crossing counts once.
    if ((piece.yFrom <= y) != (piece.yTo <= y) && x < piece.xMax)
    {
      inside ^= x < piece.xMin || this->crossesBeyond(piece, x, y);
    }
  }
  return inside;
}

bool PlanarRegion::crossesBeyond(const Piece& piece, double x, double y) const
{
  const CubicSpan& span = spans_[piece.span];
  double low = piece.from;
  double high = piece.to;
  const bool rising = piece.yFrom < piece.yTo;
  for (int round = 0; round < 52; ++round)
  {
    const double middle = 0.5 * (low + high);
    ((span.at(middle).at.y() < y) == rising ? low : high) = middle;
  }
  return x < span.at(0.5 * (low + high)).at.x();
}

} // namespace hybridtree
