#include "import/las/las.h"

#include "base/error.h"
#include "import/las/header.h"
#include "import/mesh/add_shape.h"
#include "import/mesh/metadata_set.h"
#include "import/mesh/point_cloud.h"
#include "import/source_name.h"
#include "import/warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <optional>
#include <utility>

namespace imgeo {

namespace {

using las::Dimension;
using las::Header;
using las::PointRange;
using las::Survey;

std::int64_t storedCoordinate(const std::uint8_t* record, std::size_t axis) {
  return loadLittle<std::int32_t>(record + 4 * axis);
}

class LasReader {
public:
  LasReader(ByteSpan bytes, const std::string& name, const ImportOptions& options, const Header& header,
            const Survey& survey, const PointRange& range)
      : bytes_(bytes), name_(name), options_(options), header_(header), survey_(survey), range_(range) {}

  Imported read() {
    findPoints();
    Mesh mesh = pointCloud(stemOf(name_), positions());
    readColors(mesh);
    readAttributes(mesh);
    addShape(imported_.scene, std::move(mesh), "");
    addGeoreference();
    imported_.format = "LAS";
    imported_.up = AxisDirection::z;
    return std::move(imported_);
  }

private:
  const std::uint8_t* record(std::uint64_t point) const {
    return &bytes_[header_.firstPoint + point * header_.recordBytes];
  }

  /// Finds the points that are not withheld.
  void findPoints() {
    points_.reserve(range_.count);
    for (std::uint64_t point = range_.first; point < range_.first + range_.count; ++point)
      if (!header_.isWithheld(record(point)))
        points_.push_back(static_cast<std::uint32_t>(point));
    if (range_.first > 0)
      return;
    if (const std::uint64_t withheld = header_.pointCount - survey_.pointCount; withheld > 0)
      imported_.warnings.push_back(fmt::format("{} marked as withheld in the LAS file, and left out.",
                                               counted(withheld, "point is", "points are")));
    if (header_.hasWaveforms)
      imported_.warnings.emplace_back("Waveforms of the LAS file are not carried over.");
  }

  double coordinate(std::int64_t number, int axis) const {
    return static_cast<double>(number) * header_.scale[axis] + header_.offset[axis];
  }

  /// Chooses the origin: whole units near the middle where single precision would lose a fourth of a step.
  void chooseOrigin() {
    for (int axis = 0; axis < 3; ++axis) {
      const auto n = static_cast<std::size_t>(axis);
      const double low = coordinate(survey_.lowest[n], axis), high = coordinate(survey_.highest[n], axis);
      const double largest = std::max(std::abs(low), std::abs(high));
      if (largest * std::numeric_limits<float>::epsilon() / 2 > std::abs(header_.scale[axis]) / 4)
        origin_[axis] = std::floor((low + high) / 2);
    }
  }

  std::vector<Vec3f> positions() {
    chooseOrigin();
    std::vector<Vec3f> positions;
    positions.reserve(points_.size());
    for (const std::uint32_t point : points_) {
      const std::uint8_t* const at = record(point);
      Vec3f position;
      for (int axis = 0; axis < 3; ++axis)
        position[axis] =
            static_cast<float>(coordinate(storedCoordinate(at, static_cast<std::size_t>(axis)), axis) - origin_[axis]);
      positions.push_back(position);
    }
    return positions;
  }

  /// Colours of 16 bits. Many programs store 8 bits in them, or nothing at all.
  void readColors(Mesh& mesh) {
    const std::size_t color = header_.colorOffset();
    if (color == 0)
      return;
    if (survey_.largestChannel == 0) {
      imported_.warnings.emplace_back("The colours of the LAS file are all black, and left out.");
      return;
    }
    const bool isEightBits = survey_.largestChannel < 256;
    if (isEightBits)
      imported_.warnings.emplace_back("The colours of the LAS file are at most 255 of 65,535: read as 8 bits.");
    mesh.colors.reserve(points_.size());
    for (const std::uint32_t point : points_) {
      const std::uint8_t* const at = record(point) + color;
      const auto channel = [&](std::size_t n) { return loadLittle<std::uint16_t>(at + 2 * n); };
      if (isEightBits)
        mesh.colors.emplace_back(Rgba8{at[0], at[2], at[4], 255});
      else
        mesh.colors.emplace_back(channelOf(channel(0) / 65535.0), channelOf(channel(1) / 65535.0),
                                 channelOf(channel(2) / 65535.0), 1.0f);
    }
  }

  void readAttributes(Mesh& mesh) {
    std::vector<std::string> left;
    for (std::size_t i = 0; i < header_.dimensions.size(); ++i) {
      const Dimension& dimension = header_.dimensions[i];
      imported_.attributes.push_back(dimension.name);
      if (options_.attributes.has(dimension.name))
        readAttribute(mesh, dimension);
      else if (survey_.hasValues[i])
        left.push_back(dimension.name);
    }
    if (!left.empty())
      imported_.warnings.push_back(fmt::format("Not carried over from the LAS file: {}.", fmt::join(left, ", ")));
  }

  void readAttribute(Mesh& mesh, const Dimension& dimension) {
    const bool isTime = dimension.name == "gpsTime" && std::isfinite(survey_.firstTime);
    const double subtrahend = isTime ? survey_.firstTime : 0;
    NamedAttribute attribute{dimension.name, dimension.components, {}};
    attribute.values.reserve(points_.size() * dimension.components);
    for (const std::uint32_t point : points_)
      for (std::uint32_t component = 0; component < dimension.components; ++component)
        attribute.values.push_back(static_cast<float>(dimension.valueOf(record(point), component) - subtrahend));
    if (subtrahend != 0)
      timeOrigin_ = subtrahend;
    addPointValues(mesh, std::move(attribute), imported_.warnings);
  }

  void addGeoreference() {
    imported_.origin = origin_;
    MetadataSet set(imported_.scene.graph);
    set.addText("crs", header_.crs);
    set.addText("wkt", header_.wkt);
    set.addPoint("origin", origin_);
    if (timeOrigin_)
      set.add("MetadataDouble", "gpsTimeOrigin", fmt::format("{}", *timeOrigin_));
    set.addTo(imported_.scene.graph.roots.back(), georeferenceName);
  }

  ByteSpan bytes_;
  const std::string& name_;
  const ImportOptions& options_;
  const Header& header_;
  const Survey& survey_; ///< of all points of the file
  PointRange range_;
  std::vector<std::uint32_t> points_; ///< numbers of the records that are read
  Vec3d origin_{0, 0, 0};             ///< what has been subtracted from coordinates
  std::optional<double> timeOrigin_;  ///< what has been subtracted from the values of gpsTime, in seconds
  Imported imported_;
};

} // namespace

bool isLas(ByteSpan bytes) {
  return asText(bytes).starts_with("LASF");
}

Imported readLas(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  const Header header = las::readHeader(bytes, name);
  Survey survey(header);
  for (std::uint64_t point = 0; point < header.pointCount; ++point)
    survey.add(header, &bytes[header.firstPoint + point * header.recordBytes]);
  return las::readLasPoints(bytes, name, options, header, survey, {0, header.pointCount});
}

namespace las {

Survey::Survey(const Header& header)
    : hasValues(header.dimensions.size()),
      time_(static_cast<std::size_t>(std::ranges::find(header.dimensions, "gpsTime", &Dimension::name) -
                                     header.dimensions.begin())) {
  lowest.fill(std::numeric_limits<std::int64_t>::max());
  highest.fill(std::numeric_limits<std::int64_t>::min());
}

void Survey::add(const Header& header, const std::uint8_t* record) {
  if (header.isWithheld(record))
    return;
  ++pointCount;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lowest[axis] = std::min(lowest[axis], storedCoordinate(record, axis));
    highest[axis] = std::max(highest[axis], storedCoordinate(record, axis));
  }
  if (const std::size_t color = header.colorOffset())
    for (std::size_t channel = 0; channel < 3; ++channel)
      largestChannel = std::max(largestChannel, loadLittle<std::uint16_t>(record + color + 2 * channel));
  for (std::size_t i = 0; i < header.dimensions.size(); ++i) {
    const Dimension& dimension = header.dimensions[i];
    if (i == time_)
      if (const double seconds = dimension.valueOf(record, 0); std::isfinite(seconds))
        firstTime = std::min(firstTime, std::floor(seconds));
    for (std::uint32_t component = 0; !hasValues[i] && component < dimension.components; ++component)
      hasValues[i] = dimension.valueOf(record, component) != 0;
  }
}

Imported readLasPoints(ByteSpan bytes, const std::string& name, const ImportOptions& options, const Header& header,
                       const Survey& survey, const PointRange& range) {
  if (survey.pointCount == 0)
    throw Error(ErrorKind::malformed, name, "all points are marked as withheld");
  return LasReader(bytes, name, options, header, survey, range).read();
}

} // namespace las

} // namespace imgeo
