// SPDX-License-Identifier: BSD-3-Clause
#ifndef FilterProgress_h
#define FilterProgress_h

#include "core/base/Progress.h"
#include "vtkAlgorithm.h"

// Progress of a filter of this module, reported on the filter's own thread only; any thread may ask
// whether to stop.
class FilterProgress final : public hybridtree::Progress
{
public:
  explicit FilterProgress(vtkAlgorithm* algorithm) : Algorithm(algorithm) {}
  void report(double fraction) const override
  {
    if (fraction >= this->Reported + 0.01)
    {
      this->Reported = fraction;
      this->Algorithm->UpdateProgress(fraction);
    }
  }
  bool cancelled() const override { return this->Algorithm->GetAbortExecute() != 0; }

private:
  vtkAlgorithm* Algorithm;
  mutable double Reported = 0.0;
};

#endif
