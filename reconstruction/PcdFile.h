// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace hybridtree
{

/// A field of PCL's PCD format: what its header says in FIELDS, TYPE, SIZE and COUNT.
struct PcdField
{
  std::string name;
  char type = 'F';       ///< F, I or U: float, signed, unsigned
  std::size_t size = 4;  ///< bytes of one number: 1, 2, 4 or 8; of F 4 or 8
  std::size_t count = 1; ///< numbers per point
  std::size_t bytes() const { return size * count; }
};

/// A whole PCD file, versions 0.5 to 0.7: DATA ascii, binary or binary_compressed.
struct PcdCloud
{
  std::vector<PcdField> fields;
  /// Per field: its numbers, point by point, in this machine's byte order.
  std::vector<std::vector<std::uint8_t>> data;
  std::size_t points = 0;
  std::size_t width = 0; ///< of an organised cloud; else all points
  std::size_t height = 1;
  double viewpoint[7] = { 0, 0, 0, 1, 0, 0, 0 }; ///< translation, then quaternion w x y z
};

/// Reads a cloud from a stream opened as binary.
///
/// Nothing is allocated that the file could not fill: sizes in the header are held against what
/// follows it. Fields named _ are padding and left out. Lines may end in CR LF.
/// \throws InvalidGeometry that names what is wrong: the header's line, or the point.
/// \throws Cancelled.
PcdCloud readPcd(std::istream& stream, const Progress& progress = Progress::none());

/// Undoes LZF compression (M. Lehmann's liblzf, as PCL's binary_compressed uses it). Runs of bytes:
/// a control byte below 32 is followed by that many and one bytes as they are; else its upper three
/// bits (7: and the next byte) and 2 give the length, its lower five and the next byte the distance
/// back less 1, of bytes to repeat.
/// \returns whether the input was whole and gave exactly `size` bytes.
bool decompressLzf(
  const std::uint8_t* input, std::size_t inputSize, std::uint8_t* output, std::size_t size);

} // namespace hybridtree
