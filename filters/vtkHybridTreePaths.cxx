// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreePaths.h"

#include "core/base/Error.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <string>
#include <unordered_map>

namespace hybridtree
{
namespace
{

using Ids = std::vector<vtkIdType>;

std::vector<Ids> cellsOf(vtkCellArray* cells)
{
  std::vector<Ids> result;
  const auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType size;
    const vtkIdType* ids;
    iterator->GetCurrentCell(size, ids);
    result.emplace_back(ids, ids + size);
  }
  return result;
}

// Lines that wait to be joined.
class Pieces
{
public:
  explicit Pieces(std::vector<Ids> lines) : lines_(std::move(lines)), used_(lines_.size(), 0)
  {
    for (std::size_t k = 0; k < lines_.size(); ++k)
    {
      if (lines_[k].size() < 2)
      {
        used_[k] = 1; // a point
        continue;
      }
      at_.emplace(lines_[k].front(), k);
      at_.emplace(lines_[k].back(), k);
    }
  }

  std::vector<Path> join()
  {
    std::vector<Path> paths;
    for (std::size_t first = 0; first < lines_.size(); ++first)
    {
      if (!used_[first])
      {
        used_[first] = 1;
        paths.push_back(this->pathFrom(lines_[first]));
      }
    }
    return paths;
  }

private:
  Path pathFrom(Ids ids)
  {
    this->extend(ids);
    std::reverse(ids.begin(), ids.end());
    this->extend(ids);
    std::reverse(ids.begin(), ids.end());
    Path path{ std::move(ids), false };
    if (path.points.size() > 3 && path.points.front() == path.points.back())
    {
      path.points.pop_back();
      path.closed = true;
    }
    return path;
  }

  // Goes on at the last point, up to where it meets the first.
  void extend(Ids& path)
  {
    while (path.back() != path.front())
    {
      const auto [begin, end] = at_.equal_range(path.back());
      const auto next =
        std::find_if(begin, end, [this](const auto& entry) { return !used_[entry.second]; });
      if (next == end)
      {
        return;
      }
      used_[next->second] = 1;
      const Ids& line = lines_[next->second];
      if (line.front() == path.back())
      {
        path.insert(path.end(), line.begin() + 1, line.end());
      }
      else
      {
        path.insert(path.end(), line.rbegin() + 1, line.rend());
      }
    }
  }

  std::vector<Ids> lines_;
  std::vector<char> used_;
  std::unordered_multimap<vtkIdType, std::size_t> at_; // lines by both their ends
};

} // namespace

std::vector<Path> pathsOf(vtkPolyData* input)
{
  return Pieces(cellsOf(input->GetLines())).join();
}

std::vector<Path> polygonsOf(vtkPolyData* input)
{
  std::vector<Path> paths;
  for (Ids& polygon : cellsOf(input->GetPolys()))
  {
    paths.push_back({ std::move(polygon), true });
  }
  return paths;
}

std::vector<Vec3> placesOf(const Path& path, vtkPolyData* input)
{
  std::vector<Vec3> places;
  for (const vtkIdType id : path.points)
  {
    double point[3];
    input->GetPoint(id, point);
    places.emplace_back(point);
    if (!places.back().allFinite())
    {
      throw InvalidGeometry(
        "Point " + std::to_string(id) + " of the input is not finite. Remove or mend it.");
    }
  }
  return places;
}

} // namespace hybridtree
