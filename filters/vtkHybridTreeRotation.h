// SPDX-License-Identifier: BSD-3-Clause
// Private: rotations as ParaView's panels give them.
#ifndef vtkHybridTreeRotation_h
#define vtkHybridTreeRotation_h

#include "core/base/Types.h"
#include "vtkMath.h"

namespace hybridtree
{

/// Degrees about x, y and z in the order of vtkTransform and ParaView: about z, then about the x
/// axis it has turned, then about the y axis; as a matrix Z X Y.
inline Mat3 rotationOf(const double degrees[3])
{
  const auto about = [degrees](int axis)
  { return Eigen::AngleAxisd(vtkMath::RadiansFromDegrees(degrees[axis]), Vec3::Unit(axis)); };
  return (about(2) * about(0) * about(1)).toRotationMatrix();
}

} // namespace hybridtree

#endif
