// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/Assemble.h"

#include "core/base/Parallel.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 16384;

template <typename Body>
void forEach(std::size_t count, Body&& body)
{
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = begin; k < end; ++k)
      {
        body(k);
      }
    });
}

class Assembler
{
public:
  Assembler(
    const std::vector<KeptPart>& parts, const std::vector<CutMesh>& cuts, const Patch& patch)
    : parts_(parts), cuts_(cuts), patch_(patch)
  {
    for (const KeptPart& part : parts)
    {
      hasSourceTriangles_ = hasSourceTriangles_ || !part.mesh->sourceTriangle.empty();
      hasOrigins_ = hasOrigins_ || !part.mesh->vertexOrigin.empty();
    }
  }

  StitchedMesh run()
  {
    std::size_t triangles = 0;
    for (const CutMesh& cut : cuts_)
    {
      triangles += cut.kept.size();
    }
    result_.keptTriangles = triangles;
    TriangleMesh& mesh = result_.mesh;
    mesh.triangles.resize(triangles);
    mesh.sourceLeaf.resize(triangles);
    mesh.sourceTriangle.resize(hasSourceTriangles_ ? triangles : 0);
    this->numberPoints();
    std::size_t first = 0;
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      this->copyPoints(p);
      this->copyTriangles(p, first);
      first += cuts_[p].kept.size();
    }
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      this->addPieces(p);
    }
    this->addPatch();
    return std::move(result_);
  }

private:
  /// What is kept keeps its order; points of no triangle go.
  void numberPoints()
  {
    std::size_t count = 0;
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      const TriangleMesh& mesh = *parts_[p].mesh;
      std::vector<std::int32_t> number(mesh.points.size(), -1);
      for (const std::int32_t t : cuts_[p].kept)
      {
        for (const std::int32_t v : mesh.triangles[t])
        {
          number[v] = 0;
        }
      }
      for (const Triangle& piece : cuts_[p].pieces)
      {
        for (const std::int32_t v : piece)
        {
          if (v < static_cast<std::int32_t>(number.size()))
          {
            number[v] = 0;
          }
        }
      }
      for (std::int32_t& n : number)
      {
        n = n == 0 ? static_cast<std::int32_t>(count++) : -1;
      }
      numbers_.push_back(std::move(number));
    }
    keptPoints_ = count;
    result_.keptPoints = count;
    for (const CutMesh& cut : cuts_)
    {
      firstCut_.push_back(static_cast<std::int32_t>(count));
      count += cut.vertices.size();
    }
    TriangleMesh& mesh = result_.mesh;
    firstPatch_ = count;
    count += patch_.points.size();
    mesh.points.resize(count);
    mesh.normals.resize(count, Vec3::Zero());
    mesh.vertexOrigin.resize(hasOrigins_ ? count : 0);
  }

  void copyPoints(std::size_t p)
  {
    const TriangleMesh& from = *parts_[p].mesh;
    const std::vector<std::int32_t>& number = numbers_[p];
    TriangleMesh& to = result_.mesh;
    forEach(number.size(),
      [&](std::size_t v)
      {
        if (number[v] < 0)
        {
          return;
        }
        to.points[number[v]] = from.points[v];
        if (!from.normals.empty())
        {
          to.normals[number[v]] = from.normals[v];
        }
        if (!from.vertexOrigin.empty())
        {
          to.vertexOrigin[number[v]] = this->shifted(p, from.vertexOrigin[v]);
        }
      });
    const CutMesh& cut = cuts_[p];
    for (std::size_t k = 0; k < cut.vertices.size(); ++k)
    {
      const CutVertex& vertex = cut.vertices[k];
      const std::size_t at = firstCut_[p] + k;
      to.points[at] = vertex.point;
      const Triangle& c = from.triangles[vertex.triangle];
      if (!from.normals.empty())
      {
        to.normals[at] = ((1.0 - vertex.u - vertex.v) * from.normals[c[0]] +
          vertex.u * from.normals[c[1]] + vertex.v * from.normals[c[2]])
                           .stableNormalized();
      }
      if (!from.vertexOrigin.empty() && !from.sourceTriangle.empty())
      {
        to.vertexOrigin[at] = this->originOf(p, vertex);
      }
    }
  }

  VertexOrigin shifted(std::size_t p, VertexOrigin origin) const
  {
    origin.leaf += origin.leaf >= 0 ? parts_[p].firstLeaf : 0;
    return origin;
  }

  std::int32_t leafOf(std::size_t p, std::int32_t t) const
  {
    const std::vector<std::int32_t>& leaf = parts_[p].mesh->sourceLeaf;
    return leaf.empty() || leaf[t] < 0 ? -1 : leaf[t] + parts_[p].firstLeaf;
  }

  std::int32_t sourceOf(std::size_t p, std::int32_t t) const
  {
    const std::vector<std::int32_t>& source = parts_[p].mesh->sourceTriangle;
    return source.empty() ? -1 : source[t];
  }

  /// Known where the corners of the triangle have their origins in the same triangle of the leaf.
  VertexOrigin originOf(std::size_t p, const CutVertex& vertex) const
  {
    const TriangleMesh& mesh = *parts_[p].mesh;
    const std::int32_t source = mesh.sourceTriangle[vertex.triangle];
    const std::int32_t leaf = this->leafOf(p, vertex.triangle);
    if (source < 0 || leaf < 0)
    {
      return {};
    }
    if (parts_[p].isLeaf)
    {
      return { leaf, source, vertex.u, vertex.v };
    }
    VertexOrigin result{ leaf, source, 0.0, 0.0 };
    const double weights[3] = { 1.0 - vertex.u - vertex.v, vertex.u, vertex.v };
    for (int k = 0; k < 3; ++k)
    {
      const VertexOrigin& corner = mesh.vertexOrigin[mesh.triangles[vertex.triangle][k]];
      if (corner.triangle != source)
      {
        return {};
      }
      result.u += weights[k] * corner.u;
      result.v += weights[k] * corner.v;
    }
    return result;
  }

  std::int32_t numberOf(std::size_t p, std::int32_t v) const
  {
    const auto points = static_cast<std::int32_t>(numbers_[p].size());
    return v < points ? numbers_[p][v] : firstCut_[p] + (v - points);
  }

  void copyTriangles(std::size_t p, std::size_t first)
  {
    TriangleMesh& to = result_.mesh;
    const std::vector<std::int32_t>& kept = cuts_[p].kept;
    forEach(kept.size(),
      [&](std::size_t k)
      {
        const Triangle& c = parts_[p].mesh->triangles[kept[k]];
        to.triangles[first + k] = { numbers_[p][c[0]], numbers_[p][c[1]], numbers_[p][c[2]] };
        to.sourceLeaf[first + k] = this->leafOf(p, kept[k]);
        if (hasSourceTriangles_)
        {
          to.sourceTriangle[first + k] = this->sourceOf(p, kept[k]);
        }
      });
  }

  void addTriangle(const Triangle& triangle, std::int32_t leaf, std::int32_t source)
  {
    result_.mesh.triangles.push_back(triangle);
    result_.mesh.sourceLeaf.push_back(leaf);
    if (hasSourceTriangles_)
    {
      result_.mesh.sourceTriangle.push_back(source);
    }
  }

  void addPieces(std::size_t p)
  {
    const CutMesh& cut = cuts_[p];
    std::int32_t last = -1;
    for (std::size_t k = 0; k < cut.pieces.size(); ++k)
    {
      const Triangle& c = cut.pieces[k];
      const std::int32_t t = cut.pieceOf[k];
      this->addTriangle(
        { this->numberOf(p, c[0]), this->numberOf(p, c[1]), this->numberOf(p, c[2]) },
        this->leafOf(p, t), this->sourceOf(p, t));
      result_.cutTriangles += t != last ? 1 : 0;
      last = t;
    }
  }

  void addPatch()
  {
    TriangleMesh& mesh = result_.mesh;
    std::copy(patch_.points.begin(), patch_.points.end(),
      mesh.points.begin() + static_cast<std::ptrdiff_t>(firstPatch_));
    std::copy(patch_.normals.begin(), patch_.normals.end(),
      mesh.normals.begin() + static_cast<std::ptrdiff_t>(firstPatch_));
    for (const Triangle& c : patch_.triangles)
    {
      const auto shift = static_cast<std::int32_t>(keptPoints_);
      this->addTriangle({ c[0] + shift, c[1] + shift, c[2] + shift }, -1, -1);
    }
    result_.samplePoints = patch_.points.size();
  }

  const std::vector<KeptPart>& parts_;
  const std::vector<CutMesh>& cuts_;
  const Patch& patch_;
  bool hasSourceTriangles_ = false;
  bool hasOrigins_ = false;
  std::vector<std::vector<std::int32_t>> numbers_; ///< per part and point: of the result, or -1
  std::vector<std::int32_t> firstCut_;
  std::size_t keptPoints_ = 0;
  std::size_t firstPatch_ = 0;
  StitchedMesh result_;
};

} // namespace

JointBorder jointBorder(const std::vector<KeptPart>& parts, const std::vector<CutMesh>& cuts)
{
  JointBorder joint;
  for (std::size_t p = 0; p < cuts.size(); ++p)
  {
    const auto shift = static_cast<std::int32_t>(joint.points.size()) -
      static_cast<std::int32_t>(parts[p].mesh->points.size());
    for (BorderSegment segment : cuts[p].segments)
    {
      segment.from += shift;
      segment.to += shift;
      joint.border.segments.push_back(segment);
    }
    for (BorderCrossing crossing : cuts[p].crossings)
    {
      crossing.vertex += shift;
      joint.border.crossings.push_back(crossing);
    }
    for (const CutVertex& vertex : cuts[p].vertices)
    {
      joint.points.push_back(vertex.point);
    }
  }
  joint.border.vertexCount = static_cast<std::int32_t>(joint.points.size());
  joint.border.points = joint.points.data();
  return joint;
}

StitchedMesh assemble(
  const std::vector<KeptPart>& parts, const std::vector<CutMesh>& cuts, const Patch& patch)
{
  return Assembler(parts, cuts, patch).run();
}

} // namespace hybridtree
