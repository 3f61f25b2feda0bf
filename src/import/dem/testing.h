#pragma once
// GeoTIFF files for tests.

#include "base/bytes.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace imgeo::testing {

struct TiffGrid {
  std::uint32_t columns = 0, rows = 0;
  std::vector<float> heights{};   ///< row by row
  std::array<double, 2> corner{}; ///< west and north edge
  double cell = 0;                ///< edge of a cell; 0: the file states none
  /// EPSG code of a geographic (model type 2) or projected (1) reference system; 0: none.
  std::uint16_t modelType = 0, epsg = 0;
  std::string noData{}; ///< of GDAL's tag; empty: none
};

/// An uncompressed TIFF of 32-bit floats with the tags of OGC 19-008.
inline Bytes tiffOf(const TiffGrid& grid) {
  Bytes directory, further;
  std::uint16_t tags = 0;
  const std::size_t maxDirectory = 2 + 12 * 16 + 4, begin = 8;
  const auto addTag = [&](std::uint16_t tag, std::uint16_t type, std::uint32_t count, const Bytes& values) {
    ++tags;
    appendLittle(directory, tag);
    appendLittle(directory, type);
    appendLittle(directory, count);
    Bytes entry = values;
    if (values.size() > 4) {
      entry.clear();
      appendLittle(entry, static_cast<std::uint32_t>(begin + maxDirectory + further.size()));
      further.insert(further.end(), values.begin(), values.end());
    }
    entry.resize(4);
    directory.insert(directory.end(), entry.begin(), entry.end());
  };
  const auto shorts = [](const std::vector<std::uint16_t>& numbers) {
    Bytes bytes;
    for (const std::uint16_t number : numbers)
      appendLittle(bytes, number);
    return bytes;
  };
  const auto addShort = [&](std::uint16_t tag, std::uint16_t value) { addTag(tag, 3, 1, shorts({value})); };
  const auto addLong = [&](std::uint16_t tag, std::uint32_t value) {
    Bytes bytes;
    appendLittle(bytes, value);
    addTag(tag, 4, 1, bytes);
  };
  const auto addDoubles = [&](std::uint16_t tag, const std::vector<double>& numbers) {
    Bytes bytes;
    for (const double number : numbers)
      appendLittle(bytes, number);
    addTag(tag, 12, static_cast<std::uint32_t>(numbers.size()), bytes);
  };
  constexpr std::uint32_t heightsAt = 1024;
  addLong(256, grid.columns);
  addLong(257, grid.rows);
  addShort(258, 32);
  addShort(259, 1);
  addShort(262, 1);
  addLong(273, heightsAt);
  addShort(277, 1);
  addLong(278, grid.rows);
  addLong(279, static_cast<std::uint32_t>(4 * grid.heights.size()));
  addShort(339, 3);
  if (grid.cell > 0) {
    addDoubles(33550, {grid.cell, grid.cell, 0});
    addDoubles(33922, {0, 0, 0, grid.corner[0], grid.corner[1], 0});
  }
  if (grid.epsg != 0) {
    const std::uint16_t key = grid.modelType == 2 ? 2048 : 3072;
    const std::vector<std::uint16_t> keys{1, 1, 0, 3, 1024, 0, 1, grid.modelType, 1025, 0, 1, 1, key, 0, 1, grid.epsg};
    addTag(34735, 3, static_cast<std::uint32_t>(keys.size()), shorts(keys));
  }
  if (!grid.noData.empty()) {
    Bytes text(grid.noData.begin(), grid.noData.end());
    text.push_back(0);
    addTag(42113, 2, static_cast<std::uint32_t>(text.size()), text);
  }
  Bytes file{'I', 'I', 42, 0, 8, 0, 0, 0};
  appendLittle(file, tags);
  file.insert(file.end(), directory.begin(), directory.end());
  file.resize(begin + maxDirectory);
  file.insert(file.end(), further.begin(), further.end());
  file.resize(heightsAt);
  for (const float height : grid.heights)
    appendLittle(file, height);
  return file;
}

} // namespace imgeo::testing
