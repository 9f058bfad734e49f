// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/ContentHash.h"

#include "core/mesh/PerMesh.h"

#include <cstddef>
#include <cstring>

namespace hybridtree
{
namespace
{

// The finaliser of SplitMix64 (Steele, Lea, Flood 2014): every input bit reaches every output bit.
std::uint64_t mix(std::uint64_t value)
{
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ull;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebull;
  return value ^ (value >> 31);
}

// Four independent chains, so that the multiplications of one hide behind those of the others.
class Hasher
{
public:
  void add(std::uint64_t word)
  {
    state_[next_] = mix(state_[next_] ^ word) + 0x9e3779b97f4a7c15ull;
    next_ = (next_ + 1) % 4;
  }

  void add(double value)
  {
    std::uint64_t word;
    std::memcpy(&word, &value, sizeof word);
    this->add(word);
  }

  std::uint64_t result() const
  {
    std::uint64_t all = 0;
    for (const std::uint64_t state : state_)
    {
      all = mix(all ^ state);
    }
    return all;
  }

private:
  std::uint64_t state_[4] = { 0x243f6a8885a308d3ull, 0x13198a2e03707344ull, 0xa4093822299f31d0ull,
    0x082efa98ec4e6c89ull };
  std::size_t next_ = 0;
};

} // namespace

std::uint64_t contentHash(const TriangleMesh& mesh)
{
  Hasher hasher;
  hasher.add(std::uint64_t(mesh.points.size()));
  for (const Vec3& point : mesh.points)
  {
    hasher.add(point.x());
    hasher.add(point.y());
    hasher.add(point.z());
  }
  hasher.add(std::uint64_t(mesh.triangles.size()));
  for (const Triangle& corner : mesh.triangles)
  {
    hasher.add(
      std::uint64_t(std::uint32_t(corner[0])) | std::uint64_t(std::uint32_t(corner[1])) << 32);
    hasher.add(std::uint64_t(std::uint32_t(corner[2])));
  }
  return hasher.result();
}

std::string contentHashText(const TriangleMesh& mesh)
{
  static const char digits[] = "0123456789abcdef";
  std::uint64_t hash = contentHash(mesh);
  std::string text(16, '0');
  for (std::size_t k = text.size(); k-- > 0; hash >>= 4)
  {
    text[k] = digits[hash & 15u];
  }
  return text;
}

std::string contentHashText(const MeshPtr& mesh)
{
  static PerMesh<std::string> known;
  return *known.of(mesh,
    [](const TriangleMesh& object)
    { return std::make_shared<const std::string>(contentHashText(object)); });
}

} // namespace hybridtree
