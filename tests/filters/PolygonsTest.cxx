// SPDX-License-Identifier: BSD-3-Clause
// Polygons of any outline come in as the triangles inside of it.
#include "tests/filters/Support.h"

#include "vtkCellArray.h"
#include "vtkHybridTreeMeshField.h"
#include "vtkPoints.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree::test
{
namespace
{

/// A block of 4 by 3 by 1 with a shaft of 1 by 1 and one of 1 by 0.5 through it. Top and bottom are
/// one polygon each, as CAD programs write faces with holes: out along a bridge to each hole,
/// around it, and back along the same bridge.
class DrilledBlock
{
public:
  /// \param first corner at which the polygons begin. \param sameIds the bridges' ends are the same
  /// points there and back, not copies of them.
  DrilledBlock(std::size_t first, bool sameIds)
  {
    points_->SetDataTypeToDouble();
    // Turned, so that no coordinate is exact.
    const double corners[12][2] = { { 0, 0 }, { 4, 0 }, { 4, 3 }, { 0, 3 }, // outside
      { 1, 1 }, { 1, 2 }, { 2, 2 }, { 2, 1 },                               // first shaft
      { 2.5, 1 }, { 2.5, 1.5 }, { 3.5, 1.5 }, { 3.5, 1 } };                 // second one
    for (int copy = 0; copy < 2; ++copy)
    {
      for (int z = 0; z < 2; ++z)
      {
        for (const auto& corner : corners)
        {
          const double x = 0.6 * corner[0] - 0.8 * corner[1];
          const double y = 0.8 * corner[0] + 0.6 * corner[1];
          points_->InsertNextPoint(x, 0.28 * y - 0.96 * z, 0.96 * y + 0.28 * z);
        }
      }
    }
    const vtkIdType again = sameIds ? 0 : 24;
    const std::vector<vtkIdType> top = { 0, 4, 5, 6, 7, again + 4, again + 0, 1, 8, 9, 10, 11,
      again + 8, again + 1, 2, 3 };
    std::vector<vtkIdType> up, down;
    for (std::size_t k = 0; k < top.size(); ++k)
    {
      up.push_back(top[(first + k) % top.size()] + 12);
      down.push_back(top[(first + top.size() - k) % top.size()]);
    }
    cells_->InsertNextCell(static_cast<vtkIdType>(up.size()), up.data());
    cells_->InsertNextCell(static_cast<vtkIdType>(down.size()), down.data());
    for (vtkIdType loop = 0; loop < 12; loop += 4)
    {
      for (vtkIdType k = 0; k < 4; ++k)
      {
        const vtkIdType a = loop + k;
        const vtkIdType b = loop + (k + 1) % 4;
        const vtkIdType side[4] = { a, b, b + 12, a + 12 };
        cells_->InsertNextCell(4, side);
      }
    }
    data->SetPoints(points_);
    data->SetPolys(cells_);
  }

  vtkNew<vtkPolyData> data;

private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> cells_;
};

TEST(Polygons, WithHolesAndBridgesToThemAreCutInside)
{
  for (const bool sameIds : { false, true })
  {
    for (std::size_t first = 0; first < 16; ++first)
    {
      SCOPED_TRACE(std::to_string(first) + (sameIds ? ", same points" : ", copies"));
      const DrilledBlock block(first, sameIds);
      vtkNew<vtkHybridTreeMeshField> field;
      const Messages messages(field);
      field->SetInputData(block.data);
      field->Update();
      EXPECT_EQ(messages.errors + messages.warnings, "");
      expectSolid(field->GetOutput());
      EXPECT_NEAR(signedVolume(trianglesOf(field->GetOutput())), 12.0 - 1.0 - 0.5, 1e-12);
    }
  }
}

} // namespace
} // namespace hybridtree::test
