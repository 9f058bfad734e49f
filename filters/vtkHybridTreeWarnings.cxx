// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeWarnings.h"

#include "core/nodes/Node.h"

#include <algorithm>
#include <cstring>
#include <sstream>

namespace hybridtree
{
namespace
{

std::string withoutNumbers(const std::string& text)
{
  std::istringstream words(text);
  std::string plain;
  for (std::string word; words >> word;)
  {
    plain += word.find_first_of("0123456789") == std::string::npos ? word + ' ' : "# ";
  }
  return plain;
}

/// Other trees may well be empty, such as intersections.
bool isOneLeaf(const Node& tree)
{
  const std::vector<NodePtr> children = tree.children();
  return children.empty() || (children.size() == 1 && isOneLeaf(*children.front()));
}

} // namespace

void ToldWarnings::startNode()
{
  before_.swap(told_);
  told_.clear();
}

bool ToldWarnings::isNews(const std::string& warning)
{
  if (std::find(told_.begin(), told_.end(), warning) != told_.end())
  {
    return false;
  }
  told_.push_back(warning);
  return std::none_of(before_.begin(), before_.end(),
    [plain = withoutNumbers(warning)](const std::string& told)
    { return withoutNumbers(told) == plain; });
}

std::vector<std::string> warningsOfLost(
  const Node& shape, const TriangleMesh& mesh, double edgeLength)
{
  // Asked last: bounds can take longer than the mesh.
  if (!mesh.triangles.empty() || shape.isNegative() || shape.surfaceBounds().isEmpty())
  {
    return {};
  }
  const double diagonal = shape.surfaceBounds().diagonal().norm();
  std::ostringstream text;
  if (2.0 * edgeLength > diagonal)
  {
    text << "The shape has no triangles, as EdgeLength is too long for it: its bounds have a "
            "diagonal of "
         << diagonal << ". Use a smaller one, or 0.";
  }
  else if (isOneLeaf(shape) && shape.warnings().empty())
  {
    text << "The shape has no triangles: it is thinner than their edges, which are to be "
         << (edgeLength > 0.0 ? edgeLength : shape.defaultEdgeLength())
         << " long. Use a smaller EdgeLength, or a larger SurfaceRadius.";
  }
  else
  {
    return {};
  }
  return { text.str() };
}

std::string warningOfTiny(const Node& operand, double edgeLength)
{
  if (std::strcmp(operand.kind(), "primitive") != 0 || operand.isNegative())
  {
    return {};
  }
  const Box3 box = operand.surfaceBounds();
  if (box.isEmpty() || box.sizes().maxCoeff() >= edgeLength)
  {
    return {};
  }
  std::ostringstream text;
  text << "It is " << box.sizes().maxCoeff()
       << " across, and the triangles of this node are to have edges of " << edgeLength
       << ": it may come out coarse or be lost. Use larger radii or a smaller EdgeLength.";
  return text.str();
}

} // namespace hybridtree
