// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace hybridtree
{

/// Root of everything the core throws. what() says what is wrong, where, and how to mend it.
class Error : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// A parameter outside its allowed range.
class InvalidParameter : public Error
{
public:
  /// \param name as the user knows it, \param value as given, \param allowed the range, and how to
  /// mend it, as a phrase that follows "it must be".
  InvalidParameter(const std::string& name, double value, const std::string& allowed);
  InvalidParameter(const std::string& name, const std::string& value, const std::string& allowed);
};

/// Geometry that no stated repair can use: names the element.
class InvalidGeometry : public Error
{
public:
  using Error::Error;
};

/// Text that is not a tree: names the place.
class InvalidText : public Error
{
public:
  using Error::Error;
};

/// The request needs more memory than allowed: names the estimate and the limit.
class TooLarge : public Error
{
public:
  using Error::Error;
};

/// The user asked to stop. Not a failure.
class Cancelled : public Error
{
public:
  Cancelled();
};

} // namespace hybridtree
