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

/// The records that count, and what all of them have in common.
struct Survey {
  std::vector<std::uint32_t> points; ///< numbers of the records
  std::uint16_t largestChannel = 0;
  std::array<std::int64_t, 3> lowest{}, highest{}; ///< stored coordinates
  double firstTime = std::numeric_limits<double>::infinity();
};

class LasReader {
public:
  LasReader(ByteSpan bytes, const std::string& name, const ImportOptions& options)
      : bytes_(bytes), name_(name), options_(options), header_(las::readHeader(bytes, name)) {}

  Imported read() {
    survey();
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

  static std::int64_t stored(const std::uint8_t* record, std::size_t axis) {
    return loadLittle<std::int32_t>(record + 4 * axis);
  }

  /// Finds the points that are not withheld, and the ranges of their numbers.
  void survey() {
    const auto time = std::ranges::find(header_.dimensions, "gpsTime", &Dimension::name);
    survey_.lowest.fill(std::numeric_limits<std::int64_t>::max());
    survey_.highest.fill(std::numeric_limits<std::int64_t>::min());
    survey_.points.reserve(header_.pointCount);
    for (std::uint64_t point = 0; point < header_.pointCount; ++point) {
      const std::uint8_t* const at = record(point);
      if (header_.isWithheld(at))
        continue;
      survey_.points.push_back(static_cast<std::uint32_t>(point));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        survey_.lowest[axis] = std::min(survey_.lowest[axis], stored(at, axis));
        survey_.highest[axis] = std::max(survey_.highest[axis], stored(at, axis));
      }
      if (const std::size_t color = header_.colorOffset())
        for (std::size_t channel = 0; channel < 3; ++channel)
          survey_.largestChannel =
              std::max(survey_.largestChannel, loadLittle<std::uint16_t>(at + color + 2 * channel));
      if (time != header_.dimensions.end())
        if (const double seconds = time->valueOf(at, 0); std::isfinite(seconds))
          survey_.firstTime = std::min(survey_.firstTime, std::floor(seconds));
    }
    if (survey_.points.empty())
      throw Error(ErrorKind::malformed, name_, "all points are marked as withheld");
    if (const std::uint64_t withheld = header_.pointCount - survey_.points.size(); withheld > 0)
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
    positions.reserve(survey_.points.size());
    for (const std::uint32_t point : survey_.points) {
      const std::uint8_t* const at = record(point);
      Vec3f position;
      for (int axis = 0; axis < 3; ++axis)
        position[axis] =
            static_cast<float>(coordinate(stored(at, static_cast<std::size_t>(axis)), axis) - origin_[axis]);
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
    mesh.colors.reserve(survey_.points.size());
    for (const std::uint32_t point : survey_.points) {
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
    for (const Dimension& dimension : header_.dimensions) {
      imported_.attributes.push_back(dimension.name);
      if (options_.attributes.has(dimension.name))
        readAttribute(mesh, dimension);
      else if (hasValues(dimension))
        left.push_back(dimension.name);
    }
    if (!left.empty())
      imported_.warnings.push_back(fmt::format("Not carried over from the LAS file: {}.", fmt::join(left, ", ")));
  }

  void readAttribute(Mesh& mesh, const Dimension& dimension) {
    const bool isTime = dimension.name == "gpsTime" && std::isfinite(survey_.firstTime);
    const double subtrahend = isTime ? survey_.firstTime : 0;
    NamedAttribute attribute{dimension.name, dimension.components, {}};
    attribute.values.reserve(survey_.points.size() * dimension.components);
    for (const std::uint32_t point : survey_.points)
      for (std::uint32_t component = 0; component < dimension.components; ++component)
        attribute.values.push_back(static_cast<float>(dimension.valueOf(record(point), component) - subtrahend));
    if (subtrahend != 0)
      timeOrigin_ = subtrahend;
    addPointValues(mesh, std::move(attribute), imported_.warnings);
  }

  /// Whether a value of any point is not zero.
  bool hasValues(const Dimension& dimension) const {
    return std::ranges::any_of(survey_.points, [&](std::uint32_t point) {
      for (std::uint32_t component = 0; component < dimension.components; ++component)
        if (dimension.valueOf(record(point), component) != 0)
          return true;
      return false;
    });
  }

  void addGeoreference() {
    MetadataSet set(imported_.scene.graph);
    set.addText("crs", header_.crs);
    set.addText("wkt", header_.wkt);
    set.add("MetadataDouble", "origin", fmt::format("{} {} {}", origin_.x, origin_.y, origin_.z));
    if (timeOrigin_)
      set.add("MetadataDouble", "gpsTimeOrigin", fmt::format("{}", *timeOrigin_));
    set.addTo(imported_.scene.graph.roots.back(), "georeference");
  }

  ByteSpan bytes_;
  const std::string& name_;
  const ImportOptions& options_;
  Header header_;
  Survey survey_;
  Vec3d origin_{0, 0, 0};            ///< what has been subtracted from coordinates
  std::optional<double> timeOrigin_; ///< what has been subtracted from the values of gpsTime, in seconds
  Imported imported_;
};

} // namespace

bool isLas(ByteSpan bytes) {
  return asText(bytes).starts_with("LASF");
}

Imported readLas(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  return LasReader(bytes, name, options).read();
}

} // namespace imgeo
