// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeArray
 * @brief   a field-data array that carries a live HybridTree along the pipeline
 *
 * Every HybridTree filter puts one such array, named "HybridTree", on its output. Value 0 is the
 * serialised tree, value 1 the fingerprint of the mesh it was put on (16 hexadecimal digits). In
 * process the array also holds the tree itself, so that the next filter works with the very same
 * nodes; after a trip through a file or to another process it is a plain vtkStringArray, and the
 * text is parsed.
 *
 * Filters that know nothing of trees copy field data onto geometry of their own. So a tree counts
 * only while the fingerprint is that of the mesh beside it: FindTree() sees to it. Arrays, normals
 * and colours may change; points and polygons may not.
 *
 * A mesh leaf's points and triangles are not in the text. They ride beside this array as
 * "HybridTreePoints:<hash>" and "HybridTreeTriangles:<hash>", their arrays as
 * "HybridTreePointData:<hash>:<name>" and "HybridTreeCellData:<hash>:<name>"; all of them share
 * their memory with the tree.
 */

#ifndef vtkHybridTreeArray_h
#define vtkHybridTreeArray_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkStringArray.h"

#include <memory> // for std::shared_ptr
#include <string> // for GetText

class vtkPolyData;

namespace hybridtree
{
class Node;
}

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeArray : public vtkStringArray
{
public:
  static vtkHybridTreeArray* New();
  vtkTypeMacro(vtkHybridTreeArray, vtkStringArray);
  void PrintSelf(ostream& os, vtkIndent indent) override;

#ifndef __VTK_WRAP__
  using NodePtr = std::shared_ptr<const hybridtree::Node>;

  /**
   * Puts `tree` on a mesh that is already complete: this array, and its mesh leaves' arrays.
   * Replaces the tree that may be there; other field data stays.
   */
  static void PutTree(const NodePtr& tree, vtkPolyData* mesh);

  /**
   * The same for a mesh leaf whose points and triangles are those of `mesh`, in that order: the
   * point and cell arrays that `mesh` has by now go on with the tree.
   */
  static void PutLeaf(const NodePtr& leaf, vtkPolyData* mesh);

  /**
   * The tree of a mesh: the live one, else the one its text describes. Null when there is none, or
   * when it belongs to another geometry than the mesh's.
   * \throws hybridtree::InvalidText when the text is damaged.
   */
  static NodePtr FindTree(vtkPolyData* mesh);

  const NodePtr& GetTree() const
  {
    return this->Tree;
  }
#endif

  /**
   * The text of the tree on a mesh; empty when FindTree() would give none. For scripts.
   */
  static std::string GetText(vtkPolyData* mesh);

  /**
   * Copies the live tree too when `source` has one.
   */
  void DeepCopy(vtkAbstractArray* source) override;

protected:
  vtkHybridTreeArray();
  ~vtkHybridTreeArray() override;

private:
  vtkHybridTreeArray(const vtkHybridTreeArray&) = delete;
  void operator=(const vtkHybridTreeArray&) = delete;

#ifndef __VTK_WRAP__
  NodePtr Tree;
#endif
};

#endif
