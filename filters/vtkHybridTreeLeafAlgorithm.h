// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeLeafAlgorithm
 * @brief   base of the leaves of a tree: the parameters of their fields
 *
 * The field falls from its maximum I to 0 at InfluenceRadius, the faster the larger the Exponent
 * ([HT] 4.1). I follows from where the surface shall lie, or is given itself.
 */

#ifndef vtkHybridTreeLeafAlgorithm_h
#define vtkHybridTreeLeafAlgorithm_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeLeafAlgorithm : public vtkHybridTreeAlgorithm
{
public:
  vtkTypeMacro(vtkHybridTreeLeafAlgorithm, vtkHybridTreeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum FieldModeType
  {
    AUTOMATIC = 0,
    MAXIMUM_FIELD = 1
  };

  ///@{
  /**
   * How the strength of the field is given: 0 (default) by where the surface lies, 1 by
   * MaximumField.
   */
  vtkSetMacro(FieldMode, int);
  vtkGetMacro(FieldMode, int);
  ///@}

  ///@{
  /**
   * Greatest value of the field, no unit, > 0, default 1; there is a surface from 0.5 on. Used when
   * FieldMode is 1.
   */
  vtkSetMacro(MaximumField, double);
  vtkGetMacro(MaximumField, double);
  ///@}

  ///@{
  /**
   * Distance at which the field ends, world units: how far the leaf blends.
   */
  vtkSetMacro(InfluenceRadius, double);
  vtkGetMacro(InfluenceRadius, double);
  ///@}

  ///@{
  /**
   * Exponent n of the field, 2 to 64, default 2. A larger one makes the field fall faster and
   * blends tighter.
   */
  vtkSetMacro(Exponent, int);
  vtkGetMacro(Exponent, int);
  ///@}

  ///@{
  /**
   * Carve instead of add: the field is negative. Such a leaf has no surface of its own, and an
   * empty output; it shows where something blends with it. Default off.
   */
  vtkSetMacro(Negative, bool);
  vtkGetMacro(Negative, bool);
  vtkBooleanMacro(Negative, bool);
  ///@}

protected:
  vtkHybridTreeLeafAlgorithm();
  ~vtkHybridTreeLeafAlgorithm() override;

  /**
   * Whether FieldMode says MAXIMUM_FIELD. \throws hybridtree::InvalidParameter where it says
   * neither.
   */
  bool UsesMaximumField() const;

  /**
   * MaximumField, negative for a leaf that carves. \throws hybridtree::InvalidParameter
   */
  double GetSignedMaximum() const;

  int FieldMode = AUTOMATIC;
  double MaximumField = 1.0;
  double InfluenceRadius = 1.0;
  int Exponent = 2;
  bool Negative = false;

private:
  vtkHybridTreeLeafAlgorithm(const vtkHybridTreeLeafAlgorithm&) = delete;
  void operator=(const vtkHybridTreeLeafAlgorithm&) = delete;
};

#endif
