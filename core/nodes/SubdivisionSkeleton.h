// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/BlendedField.h"
#include "core/nodes/BlendMesh.h"
#include "core/nodes/Node.h"
#include "core/nodes/NodeMaker.h"
#include "core/subdivision/SkeletonPieces.h"
#include "core/subdivision/Subdivide.h"

#include <memory>
#include <mutex>
#include <optional>

namespace hybridtree
{

/// How the radii at the corners of an element spread over it.
enum class SkeletonRadius
{
  Linear,  ///< no jump from element to element
  Constant ///< the mean of the corners, as [SUB] 3.3
};

struct SubdivisionSkeletonOptions
{
  SubdivisionScheme scheme = SubdivisionScheme::Approximating;
  int level = 1; ///< steps of subdivision, 0 to 6
  ConvolutionKernel kernel;
  BlendingControl blending;
  SkeletonRadius radius = SkeletonRadius::Linear;
  /// eta of [SUB] 4.2, (0, 1]: edges of the mesh are split where |f(middle) - T| > eta * T.
  double refinement = 0.1;
  bool negative = false; ///< carves where something blends with it; no surface of its own
};

/// Leaf: a convolution along a subdivision skeleton ([SUB]), seen through a matrix: f(p) =
/// F(M^-1 p), M being the identity for all but images under non-similarities.
///
/// F is the sum over the elements of the refined skeleton of core/convolution's closed forms, or
/// with blending control the mean or the largest of several such sums (BlendedField.h). A long
/// straight curve and a wide flat sheet of one radius have their surface at that radius; ends are
/// shorter and junctions thicker, and an element much shorter than its radius that stands alone has
/// no surface. Splitting an element changes nothing.
class SubdivisionSkeleton final : public Node
{
public:
  /// The skeleton and its field, in the leaf's own space: shared by images under a matrix.
  struct Shape
  {
    SkeletonGraph coarse;
    SubdivisionSkeletonOptions options;
    RefinedSkeleton refined;
    BlendedField field;
    PieceNumbers pieces;
  };
  using ShapePtr = std::shared_ptr<const Shape>;

  /// The refined skeleton and its field. \throws as makeSubdivisionSkeleton().
  static ShapePtr makeShape(const SkeletonGraph& graph, const SubdivisionSkeletonOptions& options);

  /// \pre map is the identity or no similarity (makeSubdivisionSkeleton() sees to it).
  SubdivisionSkeleton(ShapePtr shape, const Affine3& map);
  ~SubdivisionSkeleton() override;

  const ShapePtr& shape() const { return shape_; }
  const SkeletonGraph& coarse() const { return shape_->coarse; }
  const RefinedSkeleton& refined() const { return shape_->refined; }
  const SubdivisionSkeletonOptions& options() const { return shape_->options; }
  /// Of positive sign, whatever the node's.
  const BlendedField& convolution() const { return shape_->field; }
  const PieceNumbers& pieces() const { return shape_->pieces; }
  /// From the space of the skeleton to that of the node; empty for the identity.
  std::optional<Affine3> map() const;

  /// Which elements of refined() may reach a box of the node's space, ascending.
  struct Reaching
  {
    std::vector<std::size_t> segments;
    std::vector<std::size_t> triangles;
  };
  Reaching elementsReaching(const Box3& box) const;

  void field(PointBatch points, double* value) const override;
  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override;
  void addField(PointBatch points, double* sum) const override;
  void addFieldAndGradient(PointBatch points, double* sum, VectorBatch gradientSum) const override;
  Interval range(const Box3& box) const override;
  FieldSourcePtr restrictedTo(const Box3& box) const override;

  /// The side of the field; always -1 where it is negative.
  void membership(PointBatch points, std::int8_t* side) const override;

  /// The nearest piece of the skeleton, as pieces() counts them; -1 where the field is 0.
  void sourceLeaf(PointBatch points, std::int32_t* leaf) const override;
  int leafCount() const override { return this->pieces().count; }

  Box3 influenceBounds() const override;
  /// Within about a hundredth of its size of the tightest box.
  Box3 surfaceBounds() const override;
  bool isNegative() const override { return this->options().negative; }
  std::optional<SurfaceField> surfaceField() const override;
  std::vector<std::string> warnings() const override { return warnings_.all(); }

  const char* kind() const override { return "subdivisionSkeleton"; }
  double sampleCost(double, double) const override { return 0.16; }
  /// "points" (coordinates in a row), "radii", "segments" and "triangles" (indices in a row) of the
  /// coarse graph, the options, and "map" where there is one.
  Parameters parameters() const override;

protected:
  TriangleMesh makeMesh(double edgeLength, const Progress& progress) const override;
  NodePtr makeAffine(const Affine3& map) const override;

private:
  class Restriction;
  struct Placement;

  Box3 toOwnSpace(const Box3& box) const;
  // With the elements of the selection, or all for null.
  void addSelected(const BlendSelection* selection, PointBatch points, double* sum) const;
  void addSelected(
    const BlendSelection* selection, PointBatch points, double* sum, VectorBatch gradientSum) const;
  Interval rangeOf(const BlendSelection& selection, const Box3& box) const;
  double sign() const { return this->isNegative() ? -1.0 : 1.0; }

  ShapePtr shape_;
  std::unique_ptr<const Placement> placement_; // null for the identity
  MeshWarnings warnings_;
  mutable std::once_flag surfaceBoundsOnce_;
  mutable Box3 surfaceBounds_;
};

/// A skeleton leaf, or its image under a map: similarities are absorbed by points and radii, other
/// maps stay in the leaf ([HT] 4.5.3).
/// \throws InvalidGeometry as validate(); TooLarge, InvalidParameter for options out of range or a
/// map that is not finite or not invertible.
NodePtr makeSubdivisionSkeleton(const SkeletonGraph& graph,
  const SubdivisionSkeletonOptions& options = {}, const Affine3& map = Affine3::Identity());

/// NodeMaker: the leaf that SubdivisionSkeleton::parameters() describes.
/// \throws InvalidText, InvalidParameter, InvalidGeometry.
NodePtr subdivisionSkeletonFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup& lookup);

} // namespace hybridtree
