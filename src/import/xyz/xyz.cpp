#include "import/xyz/xyz.h"

#include "base/error.h"
#include "import/mesh/add_shape.h"
#include "import/mesh/point_cloud.h"
#include "import/mesh/unit_normal.h"
#include "import/source_name.h"
#include "import/text/line_ends.h"
#include "import/warnings.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <utility>

namespace imgeo {

namespace {

std::array<double, 3> at(const XyzColumns::Triple& triple, std::span<const double> numbers) {
  return {numbers[triple[0]], numbers[triple[1]], numbers[triple[2]]};
}

class XyzReader {
public:
  XyzReader(ByteSpan text, std::size_t from, const XyzColumns& columns, const std::string& name,
            const ImportOptions& options)
      : lines_(text, name, maxXyzNumbers, from), columns_(columns), name_(name) {
    for (const XyzColumns::Value& value : columns.values) {
      imported_.attributes.push_back(value.name);
      if (options.attributes.has(value.name)) {
        kept_.push_back(value.column);
        values_.push_back({value.name, 1, {}});
      } else {
        left_.push_back(value.name);
      }
    }
  }

  Imported read(const std::optional<Vec3d>& origin) {
    while (lines_.next())
      readPoint(xyzNumbers(lines_, columns_.count));
    imported_.origin = origin.value_or(originOf(box_));
    Mesh mesh = pointCloud(stemOf(name_), std::move(points_), imported_.origin);
    for (NamedAttribute& each : values_)
      addPointValues(mesh, std::move(each), imported_.warnings);
    addShape(imported_.scene, std::move(mesh), "");
    addOrigin(imported_.scene.graph, imported_.origin);
    if (!left_.empty())
      imported_.warnings.push_back(fmt::format("Not carried over from the XYZ file: {}.", fmt::join(left_, ", ")));
    warnOfNormals(imported_.warnings, unusableNormals_);
    warnOfColors(imported_.warnings, clampedColors_);
    imported_.format = "XYZ";
    imported_.up = AxisDirection::z;
    return std::move(imported_);
  }

private:
  void readPoint(std::span<const double> numbers) {
    if (points_.positions.size() == std::numeric_limits<std::uint32_t>::max())
      throw Error(ErrorKind::limit, name_, "has more points than 32-bit indices can name");
    points_.positions.push_back(xyzPosition(lines_, numbers, columns_));
    box_.add(points_.positions.back());
    if (columns_.normal) {
      const auto [x, y, z] = at(*columns_.normal, numbers);
      Vec3f& normal = points_.normals.emplace_back(Vec3d{x, y, z});
      unusableNormals_ += !makeUnit(normal);
    }
    if (columns_.color)
      points_.colors.push_back(pointColor(at(*columns_.color, numbers), columns_.white, clampedColors_));
    for (std::size_t n = 0; n < kept_.size(); ++n)
      values_[n].values.push_back(static_cast<float>(numbers[kept_[n]]));
  }

  NumberLines lines_;
  const XyzColumns& columns_;
  const std::string& name_;
  std::vector<std::size_t> kept_; ///< the columns of the values that are carried over
  std::vector<NamedAttribute> values_;
  std::vector<std::string> left_; ///< the names of the others
  CloudPoints points_;
  Box3d box_;
  std::uint64_t unusableNormals_ = 0, clampedColors_ = 0;
  Imported imported_;
};

/// Whether points of three numbers are the cells of a grid, one row or column after the other: along it one coordinate
/// stays and the other grows or falls, by any number of cells; at the next it begins again.
bool areHeights(ByteSpan text, const XyzColumns& columns) {
  const std::string name;
  NumberLines lines(text, name, maxXyzNumbers, columns.begin);
  std::optional<std::array<double, 2>> last;
  std::optional<std::size_t> fast; // the coordinate that changes along a row: 0 or 1
  double step = 0, rowStep = 0;    // of which the signs count
  while (lines.next()) {
    const std::span<const double> numbers = xyzNumbers(lines, columns.count);
    const std::array<double, 2> cell{numbers[0], numbers[1]};
    if (last) {
      const std::array<double, 2> change{cell[0] - (*last)[0], cell[1] - (*last)[1]};
      if (!fast) {
        if ((change[0] == 0) == (change[1] == 0))
          return false;
        fast = change[0] == 0 ? 1 : 0;
        step = change[*fast];
      }
      const double along = change[*fast] * step, across = change[1 - *fast];
      const bool isInRow = across == 0 && along > 0;
      const bool isNextRow = along <= 0 && across != 0 && across * rowStep >= 0;
      if (!isInRow && !isNextRow)
        return false;
      if (isNextRow)
        rowStep = across;
    }
    last = cell;
  }
  return rowStep != 0;
}

} // namespace

Vec3d xyzPosition(const NumberLines& lines, std::span<const double> numbers, const XyzColumns& columns) {
  const auto [x, y, z] = at(columns.position, numbers);
  const Vec3d position{x, y, z};
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(position[axis]) <= std::numeric_limits<float>::max()))
      lines.fail("a coordinate is not a number or beyond single precision");
  return position;
}

bool resemblesXyz(ByteSpan bytes) {
  try {
    const std::optional<Bytes> text = withLineFeeds(bytes);
    const ByteSpan lines = text ? ByteSpan(*text) : bytes;
    const XyzColumns columns = xyzColumnsOf(lines, {});
    return columns.count > 3 || !areHeights(lines, columns);
  } catch (const Error&) {
    return false;
  }
}

Imported readXyz(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  const std::optional<Bytes> text = withLineFeeds(bytes);
  const ByteSpan lines = text ? ByteSpan(*text) : bytes;
  const XyzColumns columns = xyzColumnsOf(lines, name);
  return XyzReader(lines, columns.begin, columns, name, options).read(std::nullopt);
}

Imported readXyzAround(const Vec3d& origin, ByteSpan lines, const XyzColumns& columns, const std::string& name,
                       const ImportOptions& options) {
  return XyzReader(lines, 0, columns, name, options).read(origin);
}

} // namespace imgeo
