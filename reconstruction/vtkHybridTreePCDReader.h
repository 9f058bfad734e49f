// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreePCDReader
 * @brief   reader of PCL's point cloud files (.pcd)
 *
 * ASCII, binary and compressed binary files of versions 0.5 to 0.7, with any fields. The fields x,
 * y and z become the points, float if all three are, else double, and each gets a vertex cell.
 * Further fields become point arrays of their own type:
 * - rgb and rgba (packed, as float or integer): RGB or RGBA, unsigned char, the active scalars;
 * - normal_x, normal_y and normal_z together: Normals, the active normals;
 * - all others by their name, with as many components as the field's count.
 * Field data: Viewpoint (translation and quaternion w x y z) and, for an organised cloud whose
 * points are all kept, Dimensions (width, height).
 *
 * Points with a coordinate that is not finite are left out, unless KeepInvalidPoints is on.
 * Pieces: the first piece is everything, all other pieces are empty.
 */

#ifndef vtkHybridTreePCDReader_h
#define vtkHybridTreePCDReader_h

#include "HybridTreeReconstructionModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"

class HYBRIDTREERECONSTRUCTION_EXPORT vtkHybridTreePCDReader : public vtkPolyDataAlgorithm
{
public:
  static vtkHybridTreePCDReader* New();
  vtkTypeMacro(vtkHybridTreePCDReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Name of the file to read.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Keep points that have no place, so that point i of an organised cloud is in column i % width
   * and row i / width. They get no vertex cell. Default off.
   */
  vtkSetMacro(KeepInvalidPoints, bool);
  vtkGetMacro(KeepInvalidPoints, bool);
  vtkBooleanMacro(KeepInvalidPoints, bool);
  ///@}

  /**
   * 1 if the file's beginning looks like PCD, else 0.
   */
  static int CanReadFile(VTK_FILEPATH const char* fileName);

protected:
  vtkHybridTreePCDReader();
  ~vtkHybridTreePCDReader() override;

  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  char* FileName = nullptr;
  bool KeepInvalidPoints = false;

private:
  vtkHybridTreePCDReader(const vtkHybridTreePCDReader&) = delete;
  void operator=(const vtkHybridTreePCDReader&) = delete;

  void Read(vtkPolyData* output);
};

#endif
