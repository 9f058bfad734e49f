// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/PcdFile.h"

#include "core/base/Error.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <istream>
#include <limits>
#include <sstream>
#include <utility>

namespace hybridtree
{
namespace
{

// Points are counted in 32 bits elsewhere in this room.
constexpr std::uint64_t kMostPoints = std::numeric_limits<std::int32_t>::max();
constexpr std::uint64_t kMostCount = 1 << 20;
constexpr std::size_t kMostPointBytes = std::size_t(1) << 28;

enum class Kind
{
  None,
  Ascii,
  Binary,
  Compressed
};

struct Header
{
  PcdCloud cloud;
  Kind kind = Kind::None;
  std::size_t pointBytes = 0;
};

[[noreturn]] void fail(const std::string& what)
{
  throw InvalidGeometry("Not a readable PCD file: " + what);
}

std::uint64_t wholeNumber(const std::string& key, const std::string& word, std::uint64_t most)
{
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value > most)
  {
    fail("the header's " + key + " has \"" + word.substr(0, 40) +
      "\"; it must be a whole number from 0 to " + std::to_string(most) + ".");
  }
  return value;
}

std::vector<std::string> words(const std::string& line)
{
  std::istringstream stream(line);
  std::vector<std::string> result;
  for (std::string word; stream >> word;)
  {
    result.push_back(word);
  }
  return result;
}

// The lines TYPE, SIZE and COUNT: a word for each of FIELDS.
template <typename Set>
void setFields(std::vector<PcdField>& fields, const std::vector<std::string>& line, const Set& set)
{
  if (line.size() != fields.size() + 1)
  {
    fail("the header's " + line[0] + " has " + std::to_string(line.size() - 1) +
      " entries, and FIELDS before it " + std::to_string(fields.size()) + ".");
  }
  for (std::size_t k = 0; k < fields.size(); ++k)
  {
    set(fields[k], line[k + 1]);
  }
}

const std::string& single(const std::vector<std::string>& line)
{
  if (line.size() != 2)
  {
    fail("the header's " + line[0] + " must have one entry.");
  }
  return line[1];
}

void readViewpoint(const std::vector<std::string>& line, PcdCloud& cloud)
{
  for (std::size_t k = 0; k < 7 && k + 1 < line.size(); ++k)
  {
    cloud.viewpoint[k] = std::strtod(line[k + 1].c_str(), nullptr);
  }
}

void readType(PcdField& field, const std::string& word)
{
  if (word != "F" && word != "I" && word != "U")
  {
    fail("the header's TYPE has \"" + word.substr(0, 40) + "\"; it must be F, I or U.");
  }
  field.type = word[0];
}

Kind kindOf(const std::string& word)
{
  if (word == "ascii")
  {
    return Kind::Ascii;
  }
  if (word != "binary" && word != "binary_compressed")
  {
    fail("the header's DATA is \"" + word.substr(0, 40) +
      "\"; it must be ascii, binary or binary_compressed.");
  }
  return word == "binary" ? Kind::Binary : Kind::Compressed;
}

void readLine(const std::vector<std::string>& line, Header& header, std::uint64_t& points)
{
  PcdCloud& cloud = header.cloud;
  const std::string& key = line[0];
  if (key == "FIELDS" || key == "COLUMNS")
  {
    cloud.fields.resize(line.size() - 1);
    setFields(
      cloud.fields, line, [](PcdField& field, const std::string& word) { field.name = word; });
  }
  else if (key == "TYPE")
  {
    setFields(cloud.fields, line, readType);
  }
  else if (key == "SIZE")
  {
    setFields(cloud.fields, line,
      [](PcdField& field, const std::string& word) { field.size = wholeNumber("SIZE", word, 8); });
  }
  else if (key == "COUNT")
  {
    setFields(cloud.fields, line,
      [](PcdField& field, const std::string& word)
      { field.count = wholeNumber("COUNT", word, kMostCount); });
  }
  else if (key == "WIDTH")
  {
    cloud.width = wholeNumber(key, single(line), kMostPoints);
  }
  else if (key == "HEIGHT")
  {
    cloud.height = wholeNumber(key, single(line), kMostPoints);
  }
  else if (key == "POINTS")
  {
    points = wholeNumber(key, single(line), kMostPoints);
  }
  else if (key == "VIEWPOINT")
  {
    readViewpoint(line, cloud);
  }
  else if (key == "DATA")
  {
    header.kind = kindOf(single(line));
  }
  else if (key != "VERSION")
  {
    fail("its header has a line that begins with \"" + key.substr(0, 40) + "\".");
  }
}

void checkFields(Header& header)
{
  if (header.cloud.fields.empty())
  {
    fail("the header has no FIELDS.");
  }
  for (const PcdField& field : header.cloud.fields)
  {
    const bool whole = field.size == 1 || field.size == 2;
    const bool wide = field.size == 4 || field.size == 8;
    if (!wide && (!whole || field.type == 'F'))
    {
      fail("field " + field.name.substr(0, 40) + " has TYPE " + field.type + " and SIZE " +
        std::to_string(field.size) + "; sizes are 1, 2, 4 or 8 bytes, of F 4 or 8.");
    }
    header.pointBytes += field.bytes();
  }
  if (header.pointBytes > kMostPointBytes)
  {
    fail("one of its points takes " + std::to_string(header.pointBytes) + " bytes; at most " +
      std::to_string(kMostPointBytes) + " are read.");
  }
  if (header.pointBytes == 0)
  {
    fail("its points have no data: all of COUNT is 0.");
  }
}

Header readHeader(std::istream& stream)
{
  constexpr std::size_t kLongestLine = 1 << 16;
  Header header;
  constexpr std::uint64_t kUnknown = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t points = kUnknown;
  std::vector<char> buffer(kLongestLine);
  while (header.kind == Kind::None)
  {
    if (!stream.getline(buffer.data(), static_cast<std::streamsize>(buffer.size())))
    {
      fail("its header does not end with a line DATA.");
    }
    const std::vector<std::string> line = words(buffer.data());
    if (!line.empty() && line[0][0] != '#')
    {
      readLine(line, header, points);
    }
  }
  checkFields(header);
  PcdCloud& cloud = header.cloud;
  if (cloud.width == 0 && points != kUnknown && cloud.height == 1)
  {
    cloud.width = points; // before version 0.7 it was not there
  }
  if (cloud.height > 0 && cloud.width > kMostPoints / cloud.height)
  {
    fail("WIDTH times HEIGHT is more than the " + std::to_string(kMostPoints) +
      " points that can be counted.");
  }
  cloud.points = cloud.width * cloud.height;
  if (points != kUnknown && points != cloud.points)
  {
    fail("POINTS is " + std::to_string(points) + ", but WIDTH times HEIGHT " +
      std::to_string(cloud.points) + ".");
  }
  return header;
}

std::uint64_t bytesLeft(std::istream& stream)
{
  const auto here = stream.tellg();
  stream.seekg(0, std::ios::end);
  const auto end = stream.tellg();
  stream.seekg(here);
  return stream && end >= here ? static_cast<std::uint64_t>(end - here) : 0;
}

// Before memory is taken for it.
void expectBytes(std::istream& stream, std::uint64_t wanted, const char* what)
{
  const std::uint64_t left = bytesLeft(stream);
  if (left < wanted)
  {
    fail("it is cut off: " + std::string(what) + " takes " + std::to_string(wanted) +
      " bytes, and " + std::to_string(left) + " follow the header.");
  }
}

void allocate(PcdCloud& cloud)
{
  for (const PcdField& field : cloud.fields)
  {
    cloud.data.emplace_back(field.bytes() * cloud.points);
  }
}

void readBytes(std::istream& stream, std::uint8_t* bytes, std::size_t count)
{
  if (!stream.read(reinterpret_cast<char*>(bytes), static_cast<std::streamsize>(count)))
  {
    fail("it is cut off, or cannot be read to its end.");
  }
}

// Point by point, in blocks.
void readBinary(std::istream& stream, Header& header, const Progress& progress)
{
  PcdCloud& cloud = header.cloud;
  expectBytes(stream, std::uint64_t(header.pointBytes) * cloud.points, "its data");
  allocate(cloud);
  const std::size_t block = std::max<std::size_t>(1, (1 << 20) / header.pointBytes);
  std::vector<std::uint8_t> bytes(std::min(block, cloud.points) * header.pointBytes);
  for (std::size_t begin = 0; begin < cloud.points; begin += block)
  {
    progress.check();
    progress.report(double(begin) / double(cloud.points));
    const std::size_t count = std::min(block, cloud.points - begin);
    readBytes(stream, bytes.data(), count * header.pointBytes);
    const std::uint8_t* from = bytes.data();
    for (std::size_t point = begin; point < begin + count; ++point)
    {
      for (std::size_t f = 0; f < cloud.fields.size(); ++f)
      {
        const std::size_t size = cloud.fields[f].bytes();
        std::copy_n(from, size, cloud.data[f].data() + point * size);
        from += size;
      }
    }
  }
}

// Field by field, all in one piece.
void readCompressed(std::istream& stream, Header& header, const Progress& progress)
{
  // LZF makes at most 264 bytes of three.
  constexpr std::uint64_t kMostGain = 88;
  PcdCloud& cloud = header.cloud;
  expectBytes(stream, 8, "the sizes of its data");
  std::uint32_t sizes[2];
  std::uint8_t packed[8];
  readBytes(stream, packed, sizeof packed);
  std::memcpy(sizes, packed, sizeof packed);
  const std::uint64_t wanted = std::uint64_t(header.pointBytes) * cloud.points;
  if (sizes[1] != wanted)
  {
    fail("its data are " + std::to_string(sizes[1]) + " bytes once unpacked, but " +
      std::to_string(cloud.points) + " points take " + std::to_string(wanted) + ".");
  }
  expectBytes(stream, sizes[0], "its packed data");
  if (wanted > kMostGain * sizes[0])
  {
    fail("its packed data are too short for " + std::to_string(cloud.points) + " points.");
  }
  std::vector<std::uint8_t> input(sizes[0]);
  readBytes(stream, input.data(), input.size());
  progress.check();
  std::vector<std::uint8_t> output(wanted);
  if (!decompressLzf(input.data(), input.size(), output.data(), output.size()))
  {
    fail("its packed data are damaged.");
  }
  progress.check();
  allocate(cloud);
  const std::uint8_t* from = output.data();
  for (std::vector<std::uint8_t>& data : cloud.data)
  {
    std::copy_n(from, data.size(), data.data());
    from += data.size();
  }
}

template <typename Number>
void store(Number number, std::uint8_t* to)
{
  std::memcpy(to, &number, sizeof number);
}

// \returns false for what is no such number.
bool storeWord(const std::string& word, const PcdField& field, std::uint8_t* to)
{
  char* end = nullptr;
  if (field.type == 'F')
  {
    const double value = std::strtod(word.c_str(), &end);
    field.size == 8 ? store(value, to) : store(static_cast<float>(value), to);
    return end == word.c_str() + word.size();
  }
  errno = 0;
  const int bits = static_cast<int>(8 * field.size);
  if (field.type == 'U')
  {
    const std::uint64_t value = std::strtoull(word.c_str(), &end, 10);
    std::memcpy(to, &value, field.size); // little endian: the low bytes come first
    return word[0] != '-' && errno == 0 && end == word.c_str() + word.size() &&
      (bits == 64 || value >> bits == 0);
  }
  const std::int64_t value = std::strtoll(word.c_str(), &end, 10);
  std::memcpy(to, &value, field.size);
  const std::int64_t most =
    bits == 64 ? std::numeric_limits<std::int64_t>::max() : (std::int64_t(1) << (bits - 1)) - 1;
  return errno == 0 && end == word.c_str() + word.size() && value <= most && value >= -most - 1;
}

void readAscii(std::istream& stream, Header& header, const Progress& progress)
{
  PcdCloud& cloud = header.cloud;
  std::uint64_t numbers = 0;
  for (const PcdField& field : cloud.fields)
  {
    numbers += field.count;
  }
  // A number takes a character, and what ends it another; the last needs none.
  expectBytes(stream, 2 * numbers * cloud.points - (cloud.points > 0 ? 1 : 0), "its data at least");
  allocate(cloud);
  std::string word;
  for (std::size_t point = 0; point < cloud.points; ++point)
  {
    if (point % 4096 == 0)
    {
      progress.check();
      progress.report(double(point) / double(cloud.points));
    }
    for (std::size_t f = 0; f < cloud.fields.size(); ++f)
    {
      const PcdField& field = cloud.fields[f];
      std::uint8_t* to = cloud.data[f].data() + point * field.bytes();
      for (std::size_t k = 0; k < field.count; ++k, to += field.size)
      {
        const std::string where = field.name.substr(0, 40) + " of point " + std::to_string(point);
        if (!(stream >> word))
        {
          fail(
            "it is cut off before " + where + "; POINTS is " + std::to_string(cloud.points) + ".");
        }
        if (!storeWord(word, field, to))
        {
          fail("\"" + word.substr(0, 40) + "\" is no number of TYPE " + field.type + " and SIZE " +
            std::to_string(field.size) + ", for " + where + ".");
        }
      }
    }
  }
}

void dropPadding(PcdCloud& cloud)
{
  for (std::size_t f = cloud.fields.size(); f-- > 0;)
  {
    if (cloud.fields[f].name == "_" || cloud.fields[f].count == 0)
    {
      cloud.fields.erase(cloud.fields.begin() + static_cast<std::ptrdiff_t>(f));
      cloud.data.erase(cloud.data.begin() + static_cast<std::ptrdiff_t>(f));
    }
  }
}

} // namespace

bool decompressLzf(
  const std::uint8_t* input, std::size_t inputSize, std::uint8_t* output, std::size_t size)
{
  const std::uint8_t* const end = input + inputSize;
  std::size_t made = 0;
  while (input < end)
  {
    const std::size_t control = *input++;
    if (control < 32)
    {
      const std::size_t length = control + 1;
      if (length > static_cast<std::size_t>(end - input) || length > size - made)
      {
        return false;
      }
      std::copy_n(input, length, output + made);
      input += length;
      made += length;
      continue;
    }
    std::size_t length = control >> 5;
    if (length == 7)
    {
      if (input == end)
      {
        return false;
      }
      length += *input++;
    }
    length += 2;
    if (input == end)
    {
      return false;
    }
    const std::size_t back = ((control & 31) << 8) + *input++ + 1;
    if (back > made || length > size - made)
    {
      return false;
    }
    for (std::size_t k = 0; k < length; ++k, ++made)
    {
      output[made] = output[made - back]; // may overlap: a repeated pattern
    }
  }
  return made == size;
}

PcdCloud readPcd(std::istream& stream, const Progress& progress)
{
  Header header = readHeader(stream);
  switch (header.kind)
  {
    case Kind::Ascii:
      readAscii(stream, header, progress);
      break;
    case Kind::Binary:
      readBinary(stream, header, progress);
      break;
    default:
      readCompressed(stream, header, progress);
      break;
  }
  dropPadding(header.cloud);
  return std::move(header.cloud);
}

} // namespace hybridtree
