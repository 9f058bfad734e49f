// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/Error.h"

#include <sstream>

namespace hybridtree
{
namespace
{

std::string describe(const std::string& name, const std::string& value, const std::string& allowed)
{
  return name + " is " + value + "; it must be " + allowed + ".";
}

std::string text(double value)
{
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

} // namespace

InvalidParameter::InvalidParameter(
  const std::string& name, double value, const std::string& allowed)
  : Error(describe(name, text(value), allowed))
{
}

InvalidParameter::InvalidParameter(
  const std::string& name, const std::string& value, const std::string& allowed)
  : Error(describe(name, value, allowed))
{
}

Cancelled::Cancelled()
  : Error("Cancelled.")
{
}

} // namespace hybridtree
