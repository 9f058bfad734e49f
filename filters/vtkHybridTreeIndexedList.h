// SPDX-License-Identifier: BSD-3-Clause
// Private: a list that ParaView fills by number of elements and one element at a time.
#ifndef vtkHybridTreeIndexedList_h
#define vtkHybridTreeIndexedList_h

#include <algorithm>
#include <array>
#include <cstddef>
#include <ostream>
#include <vector>

namespace hybridtree
{

template <typename Scalar, std::size_t N>
using IndexedList = std::vector<std::array<Scalar, N>>;

/// New elements are `filler`. Returns true for a change.
template <typename Scalar, std::size_t N>
bool setCount(IndexedList<Scalar, N>& list, int count, const std::array<Scalar, N>& filler = {})
{
  const auto size = static_cast<std::size_t>(std::max(count, 0));
  const bool change = size != list.size();
  list.resize(size, filler);
  return change;
}

template <typename Scalar, std::size_t N>
bool has(const IndexedList<Scalar, N>& list, int index)
{
  return index >= 0 && static_cast<std::size_t>(index) < list.size();
}

/// \pre has(list, index). Returns true for a change.
template <typename Scalar, std::size_t N>
bool setElement(IndexedList<Scalar, N>& list, int index, const std::array<Scalar, N>& element)
{
  std::array<Scalar, N>& old = list[static_cast<std::size_t>(index)];
  const bool change = old != element;
  old = element;
  return change;
}

template <typename Scalar, std::size_t N>
void print(const IndexedList<Scalar, N>& list, std::ostream& os)
{
  for (const std::array<Scalar, N>& element : list)
  {
    for (std::size_t k = 0; k < N; ++k)
    {
      os << (k == 0 ? " (" : ", ") << element[k];
    }
    os << ")";
  }
}

} // namespace hybridtree

#endif
