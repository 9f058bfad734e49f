// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeAffineTransform.h"

#include "core/base/Error.h"
#include "core/nodes/Node.h"
#include "vtkHybridTreeRotation.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeAffineTransform);

//------------------------------------------------------------------------------
vtkHybridTreeAffineTransform::vtkHybridTreeAffineTransform() = default;
vtkHybridTreeAffineTransform::~vtkHybridTreeAffineTransform() = default;

//------------------------------------------------------------------------------
vtkHybridTreeAffineTransform::NodePtr vtkHybridTreeAffineTransform::MakeNode(
  const Operands& operands)
{
  for (double scale : this->Scale)
  {
    if (scale == 0.0)
    {
      throw hybridtree::InvalidParameter(
        "Scale", scale, "other than 0 in every direction, or the shape has no volume");
    }
  }
  const hybridtree::Vec3 center(this->Center);
  hybridtree::Affine3 map = hybridtree::Affine3::Identity();
  map.translate(hybridtree::Vec3(this->Translate) + center);
  map.rotate(hybridtree::rotationOf(this->Rotate));
  map.scale(hybridtree::Vec3(this->Scale));
  map.translate(-center);
  return operands[0].front()->affine(map);
}

//------------------------------------------------------------------------------
void vtkHybridTreeAffineTransform::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Translate: (" << this->Translate[0] << ", " << this->Translate[1] << ", "
     << this->Translate[2] << ")\n";
  os << indent << "Rotate: (" << this->Rotate[0] << ", " << this->Rotate[1] << ", "
     << this->Rotate[2] << ")\n";
  os << indent << "Scale: (" << this->Scale[0] << ", " << this->Scale[1] << ", " << this->Scale[2]
     << ")\n";
  os << indent << "Center: (" << this->Center[0] << ", " << this->Center[1] << ", "
     << this->Center[2] << ")\n";
}
