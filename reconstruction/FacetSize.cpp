// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/FacetSize.h"

#include "core/base/Parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 4096;

constexpr int kMost = 6;

struct Neighbors
{
  std::array<std::int32_t, kMost> vertices;
  int count = 0;
  const std::int32_t* begin() const { return vertices.data(); }
  const std::int32_t* end() const { return vertices.data() + count; }
};

// The nearest Delaunay neighbours of a point, nearest first.
class Nearest
{
public:
  void find(const Tetrahedralization& tetrahedra, std::int32_t vertex)
  {
    found_.count = 0;
    recent_.fill(-1);
    const auto& points = tetrahedra.points();
    for (const std::int32_t cell : tetrahedra.star(vertex))
    {
      for (const std::int32_t other : tetrahedra.cell(cell))
      {
        std::int32_t& recent = recent_[static_cast<std::uint32_t>(other) % kRecent];
        if (other != vertex && other != recent && other != Tetrahedralization::kInfinite)
        {
          recent = other;
          this->offer((points[other] - points[vertex]).squaredNorm(), other);
        }
      }
    }
  }

  bool empty() const { return found_.count == 0; }
  double farthest() const { return std::sqrt(squared_[found_.count - 1]); }
  const Neighbors& found() const { return found_; }

private:
  // Some are offered more than once.
  void offer(double squared, std::int32_t vertex)
  {
    if (found_.count == kMost && squared >= squared_[kMost - 1])
    {
      return;
    }
    if (std::find(found_.begin(), found_.end(), vertex) != found_.end())
    {
      return;
    }
    int at = found_.count < kMost ? found_.count++ : kMost - 1;
    for (; at > 0 && squared_[at - 1] > squared; --at)
    {
      squared_[at] = squared_[at - 1];
      found_.vertices[at] = found_.vertices[at - 1];
    }
    squared_[at] = squared;
    found_.vertices[at] = vertex;
  }

  // A neighbour is met once for each cell that it shares, five times on average.
  static constexpr std::size_t kRecent = 64;
  std::array<std::int32_t, kRecent> recent_; // met, by their last bits
  std::array<double, kMost> squared_;
  Neighbors found_;
};

double squaredEdge(const std::vector<Vec3>& points, std::int32_t a, std::int32_t b)
{
  return (points[a] - points[b]).squaredNorm();
}

} // namespace

FacetSize::FacetSize(const Tetrahedralization& tetrahedra, const Progress& progress)
  : tetrahedra_(tetrahedra)
{
  this->findSpacing(progress);
  this->measureCells(progress);
}

void FacetSize::findSpacing(const Progress& progress)
{
  const std::size_t count = tetrahedra_.points().size();
  std::vector<double> sixth(count, std::numeric_limits<double>::infinity());
  std::vector<Neighbors> nearest(count);
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      Nearest around;
      for (std::size_t vertex = begin; vertex < end; ++vertex)
      {
        around.find(tetrahedra_, static_cast<std::int32_t>(vertex));
        nearest[vertex] = around.found();
        if (!around.empty())
        {
          sixth[vertex] = around.farthest();
        }
      }
    });
  spacing_ = sixth;
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      for (std::size_t vertex = begin; vertex < end; ++vertex)
      {
        const Neighbors& around = nearest[vertex];
        double sum = sixth[vertex];
        for (const std::int32_t other : around)
        {
          sum += sixth[other];
        }
        spacing_[vertex] = sum / static_cast<double>(around.end() - around.begin() + 1);
      }
    });
}

void FacetSize::measureCells(const Progress& progress)
{
  const auto count = static_cast<std::size_t>(tetrahedra_.finiteCellCount());
  facets_.resize(count);
  lengths_.resize(count);
  std::vector<double> density(spacing_.size()); // one over the square of the spacing
  std::transform(spacing_.begin(), spacing_.end(), density.begin(),
    [](double spacing) { return 1.0 / (spacing * spacing); });
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      for (std::size_t cell = begin; cell < end; ++cell)
      {
        const auto& v = tetrahedra_.cell(static_cast<std::int32_t>(cell));
        double length = 0.0;
        std::array<double, 4> size{};
        for (int i = 0; i < 4; ++i)
        {
          for (int j = 0; j < i; ++j)
          {
            const double squared = squaredEdge(tetrahedra_.points(), v[i], v[j]);
            const double relative = squared * std::max(density[v[i]], density[v[j]]);
            length = std::max(length, squared);
            for (int facet = 0; facet < 4; ++facet)
            {
              size[facet] =
                facet != i && facet != j ? std::max(size[facet], relative) : size[facet];
            }
          }
        }
        lengths_[cell] = static_cast<float>(std::sqrt(length));
        for (int facet = 0; facet < 4; ++facet)
        {
          facets_[cell][facet] = static_cast<float>(std::sqrt(size[facet]));
        }
      }
    });
}

double FacetSize::certainOfFacet(std::int32_t cell, int facet) const
{
  const auto v = tetrahedra_.facet(cell, facet);
  return this->lengthOfFacet(cell, facet) /
    std::max({ spacing_[v[0]], spacing_[v[1]], spacing_[v[2]] });
}

double FacetSize::lengthOfFacet(std::int32_t cell, int facet) const
{
  const auto& p = tetrahedra_.points();
  const auto v = tetrahedra_.facet(cell, facet);
  return std::sqrt(std::max(
    { squaredEdge(p, v[0], v[1]), squaredEdge(p, v[1], v[2]), squaredEdge(p, v[2], v[0]) }));
}

} // namespace hybridtree
