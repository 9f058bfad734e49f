// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/SkeletonLocalField.h"

#include "core/nodes/SubdivisionSkeletonMesh.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr std::size_t kMostBytes = std::size_t(64) << 20;

ContentsStore& store()
{
  static auto* const instance = new ContentsStore(kMostBytes); // outlives all statics
  return *instance;
}

Dependency dependencyOn(Contents contents)
{
  return { store().of(std::move(contents)), 0.0, 0 };
}

/// Elements in the order in which they are stored and summed up.
template <class Element>
void makeUnique(std::vector<const Element*>& elements)
{
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
}

struct Corners
{
  const std::int32_t* first;
  std::size_t count;

  const std::int32_t* begin() const { return first; }
  const std::int32_t* end() const { return first + count; }
};

/// Of a coarse element: a segment, or a triangle behind all of those.
Corners cornersOf(const SkeletonGraph& coarse, std::size_t element)
{
  const std::size_t segments = coarse.segments.size();
  return element < segments ? Corners{ coarse.segments[element].data(), 2 }
                            : Corners{ coarse.triangles[element - segments].data(), 3 };
}

} // namespace

bool SkeletonLocalField::isLocal() const
{
  return leaf_.options().kernel.kind == KernelKind::Compact;
}

void SkeletonLocalField::addOptions(Contents& contents) const
{
  const SubdivisionSkeletonOptions& options = leaf_.options();
  contents.add(static_cast<std::int32_t>(options.level));
  contents.add(static_cast<std::int32_t>(options.kernel.kind));
  contents.add(static_cast<std::int32_t>(options.kernel.exponent));
  contents.add(options.kernel.influenceRatio);
  contents.add(static_cast<std::int32_t>(options.blending.kind));
  contents.add(options.blending.distance);
  contents.add(static_cast<std::int32_t>(options.radius));
}

void SkeletonLocalField::addPoint(std::int32_t point, Contents& contents) const
{
  contents.add(point);
  for (const double coordinate : leaf_.refined().points[static_cast<std::size_t>(point)])
  {
    contents.add(coordinate);
  }
  contents.add(leaf_.refined().radii[static_cast<std::size_t>(point)]);
}

void SkeletonLocalField::addElements(const std::vector<Box3>& boxes, Contents& contents) const
{
  const ConvolutionField& sum = leaf_.convolution().sum();
  ElementSelection all;
  ElementSelection reaching;
  for (const Box3& box : boxes)
  {
    sum.select(box, reaching);
    all.segments.insert(all.segments.end(), reaching.segments.begin(), reaching.segments.end());
    all.triangles.insert(all.triangles.end(), reaching.triangles.begin(), reaching.triangles.end());
  }
  makeUnique(all.segments);
  makeUnique(all.triangles);
  const RefinedSkeleton& refined = leaf_.refined();
  const auto add =
    [&](std::int32_t parent, const std::vector<std::int32_t>& pieces, const auto& corners)
  {
    contents.add(parent);
    contents.add(pieces[static_cast<std::size_t>(parent)]);
    for (const std::int32_t corner : corners)
    {
      this->addPoint(corner, contents);
    }
  };
  contents.add(static_cast<std::uint64_t>(all.segments.size()));
  for (const SegmentElement* segment : all.segments)
  {
    const std::size_t k = sum.index(segment);
    add(refined.segmentParents[k], leaf_.pieces().segments, refined.segments[k]);
  }
  for (const TriangleElement* triangle : all.triangles)
  {
    const std::size_t k = sum.index(triangle);
    add(refined.triangleParents[k], leaf_.pieces().triangles, refined.triangles[k]);
  }
  leaf_.convolution().describeBlending(boxes, contents);
}

void SkeletonLocalField::addChildren(std::size_t element, Contents& contents) const
{
  const RefinedSkeleton& refined = leaf_.refined();
  const std::size_t segments = leaf_.coarse().segments.size();
  const auto add = [&](const auto& children, std::size_t parts, std::size_t parent)
  {
    for (std::size_t k = parent * parts; k < (parent + 1) * parts; ++k)
    {
      for (const std::int32_t corner : children[k])
      {
        this->addPoint(corner, contents);
      }
    }
  };
  const int level = leaf_.options().level;
  contents.add(static_cast<std::uint64_t>(element));
  if (element < segments)
  {
    contents.add(leaf_.pieces().segments[element]);
    add(refined.segments, std::size_t(1) << level, element);
  }
  else
  {
    contents.add(leaf_.pieces().triangles[element - segments]);
    add(refined.triangles, std::size_t(1) << (2 * level), element - segments);
  }
}

const Dependency& SkeletonLocalField::whole() const
{
  std::call_once(wholeOnce_,
    [this]
    {
      Contents contents;
      this->addOptions(contents);
      const SkeletonGraph& coarse = leaf_.coarse();
      contents.add(static_cast<std::int32_t>(leaf_.options().scheme));
      for (std::size_t k = 0; k < coarse.points.size(); ++k)
      {
        for (const double coordinate : coarse.points[k])
        {
          contents.add(coordinate);
        }
        contents.add(coarse.radii[k]);
      }
      const auto add = [&](const auto& elements)
      {
        contents.add(static_cast<std::uint64_t>(elements.size()));
        for (const auto& corners : elements)
        {
          std::for_each(
            corners.begin(), corners.end(), [&](std::int32_t corner) { contents.add(corner); });
        }
      };
      add(coarse.segments);
      add(coarse.triangles);
      whole_ = dependencyOn(std::move(contents));
    });
  return *whole_;
}

Dependency SkeletonLocalField::around(const std::vector<Box3>& boxes) const
{
  if (!this->isLocal())
  {
    return this->whole();
  }
  Contents contents;
  this->addOptions(contents);
  this->addElements(boxes, contents);
  return dependencyOn(std::move(contents));
}

Dependency SkeletonLocalField::ownSums(
  const std::vector<std::int32_t>& elements, const std::vector<Box3>& boxes) const
{
  if (leaf_.options().blending.kind != BlendingKind::Paper)
  {
    return this->around(boxes);
  }
  const SkeletonGraph& coarse = leaf_.coarse();
  std::vector<char> isOwn(coarse.points.size(), 0);
  for (const std::int32_t element : elements)
  {
    for (const std::int32_t corner : cornersOf(coarse, static_cast<std::size_t>(element)))
    {
      isOwn[static_cast<std::size_t>(corner)] = 1;
    }
  }
  Contents contents;
  this->addOptions(contents);
  for (std::size_t element = 0; element < coarse.segments.size() + coarse.triangles.size();
       ++element)
  {
    const Corners corners = cornersOf(coarse, element);
    if (std::any_of(corners.begin(), corners.end(),
          [&](std::int32_t corner) { return isOwn[static_cast<std::size_t>(corner)] != 0; }))
    {
      this->addChildren(element, contents);
    }
  }
  return dependencyOn(std::move(contents));
}

IslandField::Near SkeletonLocalField::near(const std::vector<Box3>& boxes) const
{
  const FieldSourcePtr source(FieldSourcePtr(), &leaf_);
  if (leaf_.options().blending.kind == BlendingKind::All)
  {
    return { source, { this->around(boxes) } };
  }
  // Where not all adds up, what lies between points that are asked for together may change the
  // order of sums, though not their value.
  Box3 all;
  std::for_each(boxes.begin(), boxes.end(), [&](const Box3& box) { all.extend(box); });
  return { source, { this->around({ all }) } };
}

void SkeletonLocalField::findSources(TriangleMesh& island, const Progress&) const
{
  island.sourceLeaf = skeletonPieceNumbers(leaf_, island);
}

} // namespace hybridtree
