// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Error.h"
#include "core/base/Parameters.h"

#include <algorithm>
#include <array>
#include <string>

namespace hybridtree
{

/// The values of an enumeration, 0 to N - 1, by the names they have in texts.
template <typename Enum, std::size_t N>
struct EnumNames
{
  const char* property;  ///< as the user knows it
  const char* parameter; ///< as it is called in Parameters
  std::array<const char*, N> names;

  /// \throws InvalidParameter for a number that is none of the values.
  void check(Enum value) const
  {
    const auto number = static_cast<std::int64_t>(value);
    if (number < 0 || number >= static_cast<std::int64_t>(N))
    {
      throw InvalidParameter(property, static_cast<double>(number), "one of " + this->list(true));
    }
  }

  /// \pre check(value).
  void describe(Enum value, Parameters& parameters) const
  {
    parameters.set(parameter, names[static_cast<std::size_t>(value)]);
  }

  /// \throws InvalidText for a text that is none of the names.
  Enum from(const Parameters& parameters) const
  {
    const std::string text = parameters.getString(parameter);
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end())
    {
      throw InvalidText("Parameter \"" + std::string(parameter) + "\" is \"" + text +
        "\"; it must be one of: " + this->list(false) + ".");
    }
    return static_cast<Enum>(found - names.begin());
  }

private:
  std::string list(bool withNumbers) const
  {
    std::string text;
    for (std::size_t k = 0; k < N; ++k)
    {
      text += (k == 0 ? "" : ", ") +
        (withNumbers ? std::to_string(k) + " (" + names[k] + ")" : std::string(names[k]));
    }
    return text;
  }
};

} // namespace hybridtree
