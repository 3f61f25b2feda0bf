#include "import/pts/pts.h"

#include "base/error.h"
#include "import/mesh/add_shape.h"
#include "import/mesh/point_cloud.h"
#include "import/source_name.h"
#include "import/text/line_ends.h"
#include "import/warnings.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace imgeo {

namespace {

constexpr const char* intensityName = "intensity";
/// The shortest line of a point, "0 0 0" and a line end.
constexpr std::size_t minLineBytes = 6;

class PtsReader {
public:
  PtsReader(ByteSpan bytes, const std::string& name, const ImportOptions& options)
      : name_(name), scanner_(bytes, name), keepsIntensity_(options.attributes.has(intensityName)) {}

  Imported read(const std::optional<Vec3d>& origin) {
    while (scanner_.hasScan())
      readScan();
    if (box_.empty())
      throw Error(ErrorKind::malformed, name_, "has no points");
    imported_.origin = origin.value_or(originOf(box_));
    for (std::size_t n = 0; n < scans_.size(); ++n)
      if (!scans_[n].positions.empty())
        addShape(imported_.scene, pointCloud(stemOf(name_), std::move(scans_[n]), imported_.origin),
                 scans_.size() > 1 ? fmt::format("{}-{}", stemOf(name_), n + 1) : "");
    addOrigin(imported_.scene.graph, imported_.origin);
    if (hasIntensity_) {
      imported_.attributes = {intensityName};
      if (!keepsIntensity_)
        imported_.warnings.emplace_back("Not carried over from the PTS file: intensity.");
    }
    warnOfColors(imported_.warnings, clampedColors_);
    imported_.format = "PTS";
    imported_.up = AxisDirection::z;
    return std::move(imported_);
  }

private:
  void readScan() {
    const std::uint64_t count = scanner_.pointCount();
    CloudPoints& scan = scans_.emplace_back();
    scan.positions.reserve(static_cast<std::size_t>(count));
    for (std::uint64_t number = 0; number < count; ++number) {
      const PtsScanner::Point point = scanner_.point(number, count);
      scan.positions.push_back(point.position);
      box_.add(point.position);
      if (point.hasIntensity())
        addIntensity(scan, static_cast<float>(point.numbers[0]));
      if (point.hasColor())
        scan.colors.push_back(pointColor(std::span<const double, 3>(point.color(), 3), 255, clampedColors_));
    }
  }

  void addIntensity(CloudPoints& scan, float intensity) {
    hasIntensity_ = true;
    if (!keepsIntensity_)
      return;
    if (!std::isfinite(intensity))
      scanner_.fail(ErrorKind::malformed, "an intensity is not a number or beyond single precision");
    if (scan.values.empty())
      scan.values.push_back({intensityName, 1, {}});
    scan.values.front().values.push_back(intensity);
  }

  const std::string& name_;
  PtsScanner scanner_;
  bool keepsIntensity_;
  bool hasIntensity_ = false;
  std::uint64_t clampedColors_ = 0;
  std::vector<CloudPoints> scans_;
  Box3d box_; ///< of all scans
  Imported imported_;
};

} // namespace

bool PtsScanner::hasScan() {
  scanner_.skipSpace();
  return !scanner_.atEnd();
}

std::uint64_t PtsScanner::pointCount() {
  const std::int64_t count = scanner_.integerWord("the number of points of a scan");
  scanner_.skipBlanks();
  if (!scanner_.atLineEnd())
    scanner_.fail(ErrorKind::malformed, "the line before a scan's points has more than their number");
  if (count < 0)
    scanner_.fail(ErrorKind::malformed, "a scan has a negative number of points");
  if (static_cast<std::uint64_t>(count) > (scanner_.bytesLeft() + 1) / minLineBytes)
    scanner_.fail(ErrorKind::truncated, fmt::format("a scan of {} points is promised, but only {} bytes follow", count,
                                                    scanner_.bytesLeft()));
  total_ += static_cast<std::uint64_t>(count);
  if (total_ > std::numeric_limits<std::uint32_t>::max())
    scanner_.fail(ErrorKind::limit, "more points than 32-bit indices can name");
  columns_ = 0;
  return static_cast<std::uint64_t>(count);
}

std::size_t PtsScanner::beginOfPoint() {
  scanner_.skipSpace();
  return scanner_.byteOffset();
}

PtsScanner::Point PtsScanner::point(std::uint64_t number, std::uint64_t count) {
  scanner_.skipSpace();
  if (scanner_.atEnd())
    scanner_.fail(ErrorKind::truncated, fmt::format("the file ends after {} of a scan's {} points", number, count));
  double numbers[7];
  std::size_t found = 0;
  for (scanner_.skipBlanks(); !scanner_.atLineEnd(); scanner_.skipBlanks()) {
    if (found == std::size(numbers))
      scanner_.fail(ErrorKind::malformed, "a point has more than seven numbers");
    numbers[found++] = scanner_.float64("a number of a point");
  }
  if (found != 3 && found != 4 && found != 6 && found != 7)
    scanner_.fail(ErrorKind::malformed, fmt::format("a point has {} numbers, and not 3, 4, 6 or 7", found));
  if (columns_ != 0 && found != columns_)
    scanner_.fail(ErrorKind::malformed,
                  fmt::format("a point has {} numbers, and those before have {}", found, columns_));
  columns_ = found;
  Point point{{numbers[0], numbers[1], numbers[2]}, {}, found};
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(point.position[axis]) <= std::numeric_limits<float>::max()))
      scanner_.fail(ErrorKind::malformed, "a coordinate is not a number or beyond single precision");
  std::copy(numbers + 3, numbers + found, point.numbers);
  return point;
}

Imported readPts(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  const std::optional<Bytes> text = withLineFeeds(bytes);
  return PtsReader(text ? ByteSpan(*text) : bytes, name, options).read(std::nullopt);
}

Imported readPtsAround(const Vec3d& origin, ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  return PtsReader(bytes, name, options).read(origin);
}

} // namespace imgeo
