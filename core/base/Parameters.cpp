// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/Parameters.h"

#include "core/base/Error.h"

#include <algorithm>
#include <limits>

namespace hybridtree
{
namespace
{

[[noreturn]] void throwWrongType(const std::string& name, const char* wanted)
{
  throw InvalidText("Parameter \"" + name + "\" is not " + wanted + ".");
}

} // namespace

void Parameters::set(const std::string& name, Value value)
{
  const auto entry = std::find_if(entries_.begin(), entries_.end(),
    [&](const auto& candidate) { return candidate.first == name; });
  if (entry != entries_.end())
  {
    entry->second = std::move(value);
    return;
  }
  entries_.emplace_back(name, std::move(value));
}

void Parameters::set(const std::string& name, const Vec3& value)
{
  set(name, Value(std::vector<double>{ value.x(), value.y(), value.z() }));
}

void Parameters::set(const std::string& name, const Affine3& value)
{
  std::vector<double> rows;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      rows.push_back(value(row, column));
    }
  }
  set(name, Value(std::move(rows)));
}

bool Parameters::has(const std::string& name) const
{
  return std::any_of(entries_.begin(), entries_.end(),
    [&](const auto& candidate) { return candidate.first == name; });
}

const Parameters::Value& Parameters::at(const std::string& name) const
{
  for (const auto& [candidate, value] : entries_)
  {
    if (candidate == name)
    {
      return value;
    }
  }
  throw InvalidText("Parameter \"" + name + "\" is missing.");
}

bool Parameters::getBool(const std::string& name) const
{
  if (const bool* value = std::get_if<bool>(&at(name)))
  {
    return *value;
  }
  throwWrongType(name, "true or false");
}

int Parameters::getInt(const std::string& name) const
{
  const std::int64_t* value = std::get_if<std::int64_t>(&at(name));
  if (value && *value >= std::numeric_limits<int>::min() &&
    *value <= std::numeric_limits<int>::max())
  {
    return static_cast<int>(*value);
  }
  throwWrongType(name, "an integer");
}

double Parameters::getDouble(const std::string& name) const
{
  const Value& value = at(name);
  if (const double* real = std::get_if<double>(&value))
  {
    return *real;
  }
  if (const std::int64_t* integer = std::get_if<std::int64_t>(&value))
  {
    return static_cast<double>(*integer);
  }
  throwWrongType(name, "a number");
}

std::string Parameters::getString(const std::string& name) const
{
  if (const std::string* value = std::get_if<std::string>(&at(name)))
  {
    return *value;
  }
  throwWrongType(name, "a string");
}

std::vector<double> Parameters::getDoubles(const std::string& name) const
{
  const Value& value = at(name);
  if (const auto* reals = std::get_if<std::vector<double>>(&value))
  {
    return *reals;
  }
  if (const auto* integers = std::get_if<std::vector<std::int64_t>>(&value))
  {
    return { integers->begin(), integers->end() };
  }
  throwWrongType(name, "a list of numbers");
}

std::vector<std::int64_t> Parameters::getInts(const std::string& name) const
{
  const Value& value = at(name);
  if (const auto* integers = std::get_if<std::vector<std::int64_t>>(&value))
  {
    return *integers;
  }
  const auto* reals = std::get_if<std::vector<double>>(&value);
  if (reals && reals->empty())
  {
    return {};
  }
  throwWrongType(name, "a list of integers");
}

Vec3 Parameters::getVec3(const std::string& name) const
{
  const std::vector<double> values = getDoubles(name);
  if (values.size() != 3)
  {
    throwWrongType(name, "a list of 3 numbers");
  }
  return { values[0], values[1], values[2] };
}

Affine3 Parameters::getAffine(const std::string& name) const
{
  const std::vector<double> values = getDoubles(name);
  if (values.size() != 12)
  {
    throwWrongType(name, "a list of 12 numbers");
  }
  Affine3 map = Affine3::Identity();
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      map(row, column) = values[static_cast<std::size_t>(row * 4 + column)];
    }
  }
  return map;
}

} // namespace hybridtree
