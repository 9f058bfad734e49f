// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/FreeForm.h"

#include "core/base/Error.h"
#include "core/nodes/DeformedMeshNode.h"
#include "core/nodes/EnumNames.h"
#include "core/nodes/MeshLimits.h"
#include "core/nodes/WarpedNode.h"

#include <cmath>

namespace hybridtree
{
namespace
{

static_assert(kLargestLattice == BernsteinVolume::kLargestSize);

const EnumNames<FieldFrom, 2> kFieldFrom = { "FieldFrom", "fieldFrom",
  { "deformedMesh", "inverseMap" } };

// Free-form deformation with the exact field f_A o w^-1.
class InverseMapNode final : public WarpedNode
{
public:
  InverseMapNode(NodePtr child, FreeFormSetting setting)
    : WarpedNode(std::move(child), setting.warp), setting_(std::move(setting))
  {
  }

  const FreeFormSetting& setting() const { return setting_; }

  const char* kind() const override { return "freeForm"; }
  Parameters parameters() const override { return setting_.parameters(); }
  std::vector<std::string> warnings() const override
  {
    return setting_.warnings(this->children().front()->influenceBounds());
  }

protected:
  NodePtr makeImage(const Affine3& map) const override
  {
    FreeFormSetting setting = setting_;
    setting.warp = std::make_shared<const FreeFormWarp>(
      setting_.warp->deformation(), map * setting_.warp->frame());
    return std::make_shared<const InverseMapNode>(this->child()->affine(map), std::move(setting));
  }

  NodePtr withChildren(std::vector<NodePtr> children) const override
  {
    return std::make_shared<const InverseMapNode>(std::move(children.front()), setting_);
  }

private:
  FreeFormSetting setting_;
};

void checkDimensions(const std::array<int, 3>& dimensions)
{
  for (const int dimension : dimensions)
  {
    if (dimension < 2 || dimension > kLargestLattice)
    {
      throw InvalidParameter("A lattice dimension", dimension,
        "between 2 and " + std::to_string(kLargestLattice) + " control points along each axis");
    }
  }
}

void checkDisplacements(
  const std::array<int, 3>& dimensions, const std::vector<Vec3>& displacements)
{
  const std::size_t expected =
    std::size_t(dimensions[0]) * std::size_t(dimensions[1]) * std::size_t(dimensions[2]);
  if (displacements.size() != expected)
  {
    throw InvalidParameter("The number of lattice displacements",
      std::to_string(displacements.size()),
      "that of the control points, " + std::to_string(expected));
  }
  for (std::size_t k = 0; k < displacements.size(); ++k)
  {
    if (!displacements[k].allFinite())
    {
      throw InvalidParameter(
        "Lattice displacement " + std::to_string(k), "not finite", "made of finite numbers");
    }
  }
}

// Corner and edges of the lattice box as columns of a matrix.
Affine3 checkedFrame(const Vec3& origin, const Mat3& axes)
{
  if (!origin.allFinite() || !axes.allFinite())
  {
    throw InvalidParameter("The lattice box", "not finite", "made of finite numbers");
  }
  const double volume = std::abs(axes.determinant());
  const double lengths = axes.col(0).norm() * axes.col(1).norm() * axes.col(2).norm();
  if (!(volume > 1e-12 * lengths))
  {
    throw InvalidParameter("The lattice box", "flat",
      "spanned by three axes of length > 0 that do not lie in one plane; a flat shape needs a box "
      "with some height");
  }
  Affine3 frame = Affine3::Identity();
  frame.linear() = axes;
  frame.translation() = origin;
  return frame;
}

std::vector<Vec3> displacementsOf(const FreeFormLattice& lattice)
{
  checkDimensions(lattice.dimensions);
  std::vector<Vec3> displacements = lattice.displacements;
  if (displacements.empty())
  {
    displacements.assign(std::size_t(lattice.dimensions[0]) * std::size_t(lattice.dimensions[1]) *
        std::size_t(lattice.dimensions[2]),
      Vec3::Zero());
  }
  checkDisplacements(lattice.dimensions, displacements);
  return displacements;
}

ControlLattice controlLatticeOf(
  const std::array<int, 3>& n, const Affine3& frame, const std::vector<Vec3>& unitDisplacements)
{
  ControlLattice result;
  result.dimensions = n;
  const std::array<std::int32_t, 3> stride{ 1, n[0], n[0] * n[1] };
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        const std::int32_t at = static_cast<std::int32_t>(result.points.size());
        const Vec3 rest(double(i) / (n[0] - 1), double(j) / (n[1] - 1), double(k) / (n[2] - 1));
        result.points.push_back(frame * Vec3(rest + unitDisplacements[std::size_t(at)]));
        const std::array<int, 3> index{ i, j, k };
        for (int axis = 0; axis < 3; ++axis)
        {
          if (index[axis] + 1 < n[axis])
          {
            result.edges.push_back({ at, at + stride[axis] });
          }
        }
      }
    }
  }
  return result;
}

ControlLattice controlLatticeOf(const FreeFormWarp& warp, const Affine3& map)
{
  const BernsteinVolume& volume = warp.deformation()->displacement();
  return controlLatticeOf(volume.sizes(), map * warp.frame(), volume.coefficients());
}

NodePtr make(NodePtr child, const FreeFormSetting& setting, const Affine3& map)
{
  kFieldFrom.check(setting.fieldFrom);
  requireEdgeLength(setting.edgeLength);
  if (setting.fieldFrom == FieldFrom::InverseMap &&
    setting.warp->deformation()->folding() == BernsteinDeformation::Folding::None)
  {
    NodePtr node = std::make_shared<const InverseMapNode>(std::move(child), setting);
    return node->affine(map);
  }
  return std::make_shared<const DeformedMeshNode>(
    std::make_shared<const DeformedMesh>(std::move(child), setting), map);
}

FreeFormSetting settingOf(const std::array<int, 3>& dimensions, const Affine3& frame,
  std::vector<Vec3> unitDisplacements, FieldFrom fieldFrom, double edgeLength)
{
  auto deformation =
    std::make_shared<const BernsteinDeformation>(dimensions, std::move(unitDisplacements));
  return { std::make_shared<const FreeFormWarp>(std::move(deformation), frame), fieldFrom,
    edgeLength };
}

} // namespace

Parameters FreeFormSetting::parameters() const
{
  const BernsteinVolume& volume = warp->deformation()->displacement();
  std::vector<double> numbers;
  numbers.reserve(3 * volume.coefficients().size());
  for (const Vec3& displacement : volume.coefficients())
  {
    numbers.insert(numbers.end(), displacement.begin(), displacement.end());
  }
  Parameters parameters;
  parameters.set(
    "dimensions", std::vector<std::int64_t>(volume.sizes().begin(), volume.sizes().end()));
  parameters.set("frame", warp->frame());
  parameters.set("displacements", std::move(numbers));
  kFieldFrom.describe(fieldFrom, parameters);
  parameters.set("edgeLength", edgeLength);
  return parameters;
}

namespace
{

/// Whether the lattice box, the unit cube in `frame`, holds all of a box.
bool encloses(const Affine3& frame, const Box3& box)
{
  const Box3 inside = transformed(box, frame.inverse());
  return inside.isEmpty() ||
    (inside.min().minCoeff() >= -1e-9 && inside.max().maxCoeff() <= 1.0 + 1e-9);
}

} // namespace

std::vector<std::string> FreeFormSetting::warnings(const Box3& reach) const
{
  const BernsteinDeformation& deformation = *warp->deformation();
  std::vector<std::string> texts;
  if (!deformation.hasRestingFaces() && !encloses(warp->frame(), reach))
  {
    texts.push_back("Control points on the faces of the lattice box are displaced, so the "
                    "deformation is not continuous there: a shape that reaches through these faces "
                    "is torn. Enclose the shape in the lattice, or keep its outer points at rest.");
  }
  const BernsteinDeformation::Folding folding = deformation.folding();
  if (folding != BernsteinDeformation::Folding::None)
  {
    std::string text = folding == BernsteinDeformation::Folding::Certain
      ? "The lattice folds space over (its Jacobian determinant falls to 0 or below), so the shape "
        "may intersect itself. Displace its control points less."
      : "The lattice may fold space over: its Jacobian determinant could not be proved positive.";
    if (fieldFrom == FieldFrom::InverseMap)
    {
      text +=
        " The inverse map does not exist there: the field comes from the deformed mesh instead.";
    }
    texts.push_back(std::move(text));
  }
  return texts;
}

NodePtr makeFreeForm(
  NodePtr child, const FreeFormLattice& lattice, FieldFrom fieldFrom, double edgeLength)
{
  std::vector<Vec3> displacements = displacementsOf(lattice);
  const Affine3 frame = checkedFrame(lattice.origin, lattice.axes);
  const Mat3 toUnit = lattice.axes.inverse();
  for (Vec3& displacement : displacements)
  {
    displacement = toUnit * displacement;
  }
  return make(std::move(child),
    settingOf(lattice.dimensions, frame, std::move(displacements), fieldFrom, edgeLength),
    Affine3::Identity());
}

NodePtr freeFormFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup&)
{
  requireChildren("freeForm", children, 1);
  const std::vector<std::int64_t> sizes = parameters.getInts("dimensions");
  const std::vector<double> numbers = parameters.getDoubles("displacements");
  if (sizes.size() != 3 || numbers.size() % 3 != 0)
  {
    throw InvalidText(
      "A node of kind \"freeForm\" needs 3 \"dimensions\", and \"displacements\" of "
      "3 numbers each.");
  }
  std::array<int, 3> dimensions;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t size = std::min<std::int64_t>(sizes[std::size_t(axis)], kLargestLattice + 1);
    dimensions[std::size_t(axis)] = static_cast<int>(std::max<std::int64_t>(size, 0));
  }
  checkDimensions(dimensions);
  std::vector<Vec3> displacements;
  for (std::size_t k = 0; k < numbers.size(); k += 3)
  {
    displacements.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
  }
  checkDisplacements(dimensions, displacements);
  const Affine3 frame = parameters.getAffine("frame");
  checkedFrame(frame.translation(), frame.linear());
  const Affine3 map = parameters.has("map") ? parameters.getAffine("map") : Affine3::Identity();
  if (!map.matrix().allFinite() || map.linear().determinant() == 0.0)
  {
    throw InvalidParameter("The map of a free-form deformation", "not invertible",
      "finite, with a determinant other than 0");
  }
  return make(children.front(),
    settingOf(dimensions, frame, std::move(displacements), kFieldFrom.from(parameters),
      parameters.getDouble("edgeLength")),
    map);
}

ControlLattice controlLattice(const FreeFormLattice& lattice)
{
  std::vector<Vec3> displacements = displacementsOf(lattice);
  const Affine3 frame = checkedFrame(lattice.origin, lattice.axes);
  const Mat3 toUnit = lattice.axes.inverse();
  for (Vec3& displacement : displacements)
  {
    displacement = toUnit * displacement;
  }
  return controlLatticeOf(lattice.dimensions, frame, displacements);
}

std::optional<ControlLattice> controlLattice(const Node& node)
{
  if (const auto* exact = dynamic_cast<const InverseMapNode*>(&node))
  {
    return controlLatticeOf(*exact->setting().warp, Affine3::Identity());
  }
  if (const auto* meshed = dynamic_cast<const DeformedMeshNode*>(&node))
  {
    return controlLatticeOf(*meshed->shape().setting().warp, meshed->map());
  }
  return std::nullopt;
}

} // namespace hybridtree
