// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <string>

namespace hybridtree
{

///@{
/// The value itself when every number of it is finite. \throws InvalidParameter naming it
/// otherwise.
const Vec3& requireFinite(const std::string& name, const Vec3& value);
double requireFinite(const std::string& name, double value);
///@}

/// \throws InvalidParameter unless value is finite and >= 0.
double requireNotNegative(const std::string& name, double value);

/// The direction of `value`; a vector that is of unit length to rounding comes back bit for bit.
/// \throws InvalidParameter when it is not finite or 0.
Vec3 requireDirection(const std::string& name, const Vec3& value);

/// The matrix, made orthonormal where it is off by more than rounding.
/// \throws InvalidParameter when it is not finite or off by more than 1e-9.
Mat3 requireOrthonormal(const std::string& name, const Mat3& value);

/// Some unit vector across a unit vector; always the same.
Vec3 anyAcross(const Vec3& unit);

} // namespace hybridtree
