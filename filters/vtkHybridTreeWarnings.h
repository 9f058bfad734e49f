// SPDX-License-Identifier: BSD-3-Clause
// Private: what a filter warns of, and what it has told already.
#ifndef vtkHybridTreeWarnings_h
#define vtkHybridTreeWarnings_h

#include <string>
#include <vector>

namespace hybridtree
{

class Node;
struct TriangleMesh;

/// Keeps a filter from telling the same again: nothing twice about one node, and not about the
/// next node what it has told about the one before, as in a drag or an animation.
class ToldWarnings
{
public:
  /// The filter has another node now.
  void startNode();

  /// True when the warning has to be told; it counts as told then. Those about the node before are
  /// compared without their numbers, which may change with every step.
  bool isNews(const std::string& warning);

private:
  std::vector<std::string> told_;
  std::vector<std::string> before_;
};

/// What to say, if anything, where a shape that has a surface has come out without triangles.
/// \param edgeLength asked for, 0 for the default.
std::vector<std::string> warningsOfLost(
  const Node& shape, const TriangleMesh& mesh, double edgeLength);

/// What to say of an operand that is smaller than the edges of the triangles it will be made of;
/// nothing of all others. Sources do not know the size of what they are blended with: beside a scan
/// in millimetres a new ball is a dot. Only primitives are looked at, whose bounds cost nothing.
std::string warningOfTiny(const Node& operand, double edgeLength);

} // namespace hybridtree

#endif
