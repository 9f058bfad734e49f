// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace hybridtree
{

/// Named values that describe one node or skeleton completely, whatever text they end up in.
/// Order is that of insertion. Names are lowerCamel.
class Parameters
{
public:
  using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<double>,
    std::vector<std::int64_t>>;

  void set(const std::string& name, Value value);
  ///@{
  /// Each type has its own form: left to conversions, a real would become an integer.
  void set(const std::string& name, const char* value) { set(name, Value(std::string(value))); }
  void set(const std::string& name, bool value) { set(name, Value(value)); }
  void set(const std::string& name, int value) { set(name, Value(std::int64_t(value))); }
  void set(const std::string& name, std::int64_t value) { set(name, Value(value)); }
  void set(const std::string& name, double value) { set(name, Value(value)); }
  ///@}
  void set(const std::string& name, const Vec3& value);
  /// The 3 x 4 matrix, row by row.
  void set(const std::string& name, const Affine3& value);

  bool has(const std::string& name) const;

  ///@{
  /// \throws InvalidText when the name is absent, or its value of another type or length. An
  /// integer serves where a real is asked for.
  bool getBool(const std::string& name) const;
  int getInt(const std::string& name) const;
  double getDouble(const std::string& name) const;
  std::string getString(const std::string& name) const;
  Vec3 getVec3(const std::string& name) const;
  Affine3 getAffine(const std::string& name) const;
  std::vector<double> getDoubles(const std::string& name) const;
  std::vector<std::int64_t> getInts(const std::string& name) const;
  ///@}

  const std::vector<std::pair<std::string, Value>>& entries() const { return entries_; }

private:
  const Value& at(const std::string& name) const;

  std::vector<std::pair<std::string, Value>> entries_;
};

} // namespace hybridtree
