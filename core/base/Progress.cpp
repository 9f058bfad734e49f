// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/Progress.h"

namespace hybridtree
{

const Progress& Progress::none()
{
  static const Progress silent;
  return silent;
}

} // namespace hybridtree
