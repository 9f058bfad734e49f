// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/EdgeMesh.h"

#include <algorithm>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr double kClearly = 1.00001; // so that rounding does not choose between equal diagonals
constexpr std::int32_t kNone = -1;

} // namespace

EdgeMesh::EdgeMesh(
  const std::vector<Triangle>& triangles, const std::vector<std::int32_t>& elements)
  : triangles_(triangles), elements_(elements)
{
  // Edges by their smaller vertex, in chains: few have the same.
  std::int32_t vertices = 0;
  for (const auto& [a, b, c] : triangles)
  {
    vertices = std::max({ vertices, a + 1, b + 1, c + 1 });
  }
  std::vector<std::int32_t> first(std::size_t(vertices), kNone);
  std::vector<std::int32_t> next; // per edge
  const std::size_t expected = triangles.size() + triangles.size() / 2;
  next.reserve(expected);
  edges_.reserve(2 * expected);
  const auto number = [&](std::int32_t a, std::int32_t b, std::int32_t element)
  {
    std::int32_t& chain = first[std::size_t(std::min(a, b))];
    for (std::int32_t edge = chain; edge != kNone; edge = next[std::size_t(edge)])
    {
      const Edge& of = edges_[std::size_t(edge)];
      if (std::max(of.a, of.b) == std::max(a, b))
      {
        return edge;
      }
    }
    next.push_back(std::exchange(chain, std::int32_t(edges_.size())));
    return this->addEdge(a, b, element);
  };
  edgesOf_.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const auto [a, b, c] = triangles[t];
    const std::int32_t ab = number(a, b, elements[t]);
    const std::int32_t bc = number(b, c, elements[t]);
    edgesOf_.push_back({ ab, bc, number(c, a, elements[t]) });
  }
}

std::int32_t EdgeMesh::addEdge(std::int32_t a, std::int32_t b, std::int32_t element)
{
  edges_.push_back({ a, b, element });
  return std::int32_t(edges_.size() - 1);
}

void EdgeMesh::split(std::int32_t edge, std::int32_t vertex)
{
  const Edge whole = edges_[std::size_t(edge)];
  const std::int32_t first = this->addEdge(whole.a, vertex, whole.element);
  const std::int32_t second = this->addEdge(vertex, whole.b, whole.element);
  edges_[std::size_t(edge)].middle = vertex;
  edges_[std::size_t(edge)].halves = { first, second };
}

std::int32_t EdgeMesh::half(std::int32_t edge, std::int32_t corner) const
{
  const Edge& whole = edges_[std::size_t(edge)];
  return whole.halves[whole.a == corner ? 0 : 1];
}

void EdgeMesh::add(const Triangle& triangle, const std::array<std::int32_t, 3>& edges)
{
  triangles_.push_back(triangle);
  edgesOf_.push_back(edges);
}

void EdgeMesh::divide(const std::vector<Vec3>& points)
{
  std::swap(triangles_, wholes_);
  std::swap(elements_, elementsOfWholes_);
  std::swap(edgesOf_, edgesOfWholes_);
  triangles_.clear();
  elements_.clear();
  edgesOf_.clear();
  for (std::size_t t = 0; t < wholes_.size(); ++t)
  {
    this->divide(wholes_[t], edgesOfWholes_[t], elementsOfWholes_[t], points);
    while (elements_.size() < triangles_.size())
    {
      elements_.push_back(elementsOfWholes_[t]);
    }
  }
}

void EdgeMesh::divide(Triangle corners, std::array<std::int32_t, 3> edges, std::int32_t element,
  const std::vector<Vec3>& points)
{
  const auto isSplit = [&](std::int32_t edge)
  { return edges_[std::size_t(edge)].middle != kWhole; };
  const auto count = std::count_if(edges.begin(), edges.end(), isSplit);
  if (count == 0)
  {
    this->add(corners, edges);
    return;
  }
  if (count == 3)
  {
    this->divideInFour(corners, edges, element);
    return;
  }
  // Turned so that the only edge that is split, or the only one that is not, is the first.
  while (isSplit(edges[0]) != (count == 1))
  {
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    std::rotate(edges.begin(), edges.begin() + 1, edges.end());
  }
  if (count == 1)
  {
    this->divideInTwo(corners, edges, element);
  }
  else
  {
    this->divideInThree(corners, edges, element, points);
  }
}

void EdgeMesh::divideInTwo(
  const Triangle& corners, const std::array<std::int32_t, 3>& edges, std::int32_t element)
{
  const auto [a, b, c] = corners;
  const std::int32_t ab = edges_[std::size_t(edges[0])].middle;
  const std::int32_t cut = this->addEdge(ab, c, element);
  this->add({ a, ab, c }, { this->half(edges[0], a), cut, edges[2] });
  this->add({ ab, b, c }, { this->half(edges[0], b), edges[1], cut });
}

void EdgeMesh::divideInThree(const Triangle& corners, const std::array<std::int32_t, 3>& edges,
  std::int32_t element, const std::vector<Vec3>& points)
{
  const auto [a, b, c] = corners;
  const std::int32_t bc = edges_[std::size_t(edges[1])].middle;
  const std::int32_t ca = edges_[std::size_t(edges[2])].middle;
  const std::int32_t across = this->addEdge(bc, ca, element);
  this->add({ bc, c, ca }, { this->half(edges[1], c), this->half(edges[2], c), across });
  const auto length = [&](std::int32_t p, std::int32_t q)
  { return (points[std::size_t(p)] - points[std::size_t(q)]).squaredNorm(); };
  if (kClearly * length(a, bc) < length(b, ca))
  {
    const std::int32_t cut = this->addEdge(a, bc, element);
    this->add({ a, b, bc }, { edges[0], this->half(edges[1], b), cut });
    this->add({ a, bc, ca }, { cut, across, this->half(edges[2], a) });
  }
  else
  {
    const std::int32_t cut = this->addEdge(b, ca, element);
    this->add({ a, b, ca }, { edges[0], cut, this->half(edges[2], a) });
    this->add({ b, bc, ca }, { this->half(edges[1], b), across, cut });
  }
}

void EdgeMesh::divideInFour(
  const Triangle& corners, const std::array<std::int32_t, 3>& edges, std::int32_t element)
{
  Triangle middles;
  for (std::size_t k = 0; k < 3; ++k)
  {
    middles[k] = edges_[std::size_t(edges[k])].middle;
  }
  std::array<std::int32_t, 3> cuts; // opposite of each corner
  for (std::size_t k = 0; k < 3; ++k)
  {
    const std::size_t before = (k + 2) % 3;
    cuts[k] = this->addEdge(middles[k], middles[before], element);
    this->add({ corners[k], middles[k], middles[before] },
      { this->half(edges[k], corners[k]), cuts[k], this->half(edges[before], corners[k]) });
  }
  this->add(middles, { cuts[1], cuts[2], cuts[0] });
}

} // namespace hybridtree
