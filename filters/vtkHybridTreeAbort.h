// SPDX-License-Identifier: BSD-3-Clause
// Private: the user's wish that a filter stops.
#ifndef vtkHybridTreeAbort_h
#define vtkHybridTreeAbort_h

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkNew.h"

namespace hybridtree
{

/// CheckAbort() exists from VTK 9.3 on, and also tells of aborted filters further up.
template <class Algorithm>
auto checkAbort(Algorithm* algorithm, int) -> decltype(algorithm->CheckAbort())
{
  return algorithm->CheckAbort();
}
template <class Algorithm>
bool checkAbort(Algorithm* algorithm, long)
{
  return algorithm->GetAbortExecute() != 0;
}

inline bool mustStop(vtkAlgorithm* algorithm)
{
  return checkAbort(algorithm, 0);
}

/// Takes the wish to stop back, once.
class TakeAbortBack : public vtkCommand
{
public:
  static TakeAbortBack* New() { return new TakeAbortBack; }
  void Execute(vtkObject* caller, unsigned long, void*) override
  {
    static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(0);
    caller->RemoveObserver(this);
  }
};

/// To be called by a filter that has stopped as it was asked to, while it still runs. VTK marks its
/// outputs as aborted, and so computes them anew at the next update, with all that stands behind;
/// but that update would stop at once again if the wish were still there.
inline void haveStopped(vtkAlgorithm* algorithm)
{
  mustStop(algorithm);
  vtkNew<TakeAbortBack> command;
  algorithm->AddObserver(vtkCommand::EndEvent, command);
}

} // namespace hybridtree

#endif
