#include "import/e57/e57.h"

#include "base/error.h"
#include "import/e57/packets.h"
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
#include <string_view>
#include <utility>

namespace imgeo {

namespace {

using e57::Field;
using e57::FieldValues;
using e57::Limits;
using e57::PointSurvey;
using e57::Scan;
using e57::ScanPiece;

constexpr std::array cartesianNames{"cartesianX", "cartesianY", "cartesianZ"};
constexpr std::array sphericalNames{"sphericalRange", "sphericalAzimuth", "sphericalElevation"};
constexpr std::array colorNames{"colorRed", "colorGreen", "colorBlue"};
constexpr std::string_view timeName = "timeStamp";

/// The points of a scan that are valid.
struct Cloud {
  std::string name;
  std::vector<Vec3d> positions; ///< with the pose applied
  std::vector<Rgba> colors;     ///< empty: not stated
  std::vector<NamedAttribute> values;
  std::optional<Limits> intensityLimits;
};

/// Which fields of a scan are read, and for what. Numbers of fields.
struct Roles {
  std::array<std::optional<std::size_t>, 3> coordinates, colors;
  std::optional<std::size_t> invalidState;
  bool isSpherical = false;
  std::vector<std::pair<std::size_t, std::string>> attributes; ///< field and name
};

template <std::size_t N>
std::array<std::optional<std::size_t>, N> fieldsNamed(const Scan& scan, const std::array<const char*, N>& names) {
  std::array<std::optional<std::size_t>, N> found;
  for (std::size_t n = 0; n < N; ++n)
    if (const auto field = std::ranges::find(scan.fields, std::string_view(names[n]), &Field::name);
        field != scan.fields.end() && field->type != Field::Type::text)
      found[n] = static_cast<std::size_t>(field - scan.fields.begin());
  return found;
}

template <std::size_t N> bool haveAll(const std::array<std::optional<std::size_t>, N>& fields) {
  return std::ranges::all_of(fields, [](const auto& field) { return field.has_value(); });
}

class E57Reader {
public:
  E57Reader(ByteSpan bytes, const std::string& name, const ImportOptions& options)
      : file_(bytes, name), name_(name), options_(options), description_(e57::readDescription(file_, name)) {}
  E57Reader(ByteSpan bytes, const std::string& name, const ImportOptions& options, e57::Description description)
      : file_(bytes, name), name_(name), options_(options), description_(std::move(description)) {}

  Imported read() {
    for (std::size_t scan = 0; scan < description_.scans.size(); ++scan)
      readScan(ScanPiece::whole(description_, scan));
    if (box_.empty())
      throw Error(ErrorKind::malformed, name_, invalid_ > 0 ? "all points are marked as invalid" : "has no points");
    return finish();
  }

  void addTo(PointSurvey& survey, const ScanPiece& piece) {
    readScan(piece);
    if (!box_.empty())
      survey.box.add(box_.min), survey.box.add(box_.max);
    survey.points += clouds_.at(0).positions.size();
    survey.invalid += invalid_;
    survey.clampedColors += clampedColors_;
    if (!survey.timeOrigin)
      survey.timeOrigin = timeOrigin_;
  }

  Imported readPieces(const PointSurvey& survey, std::span<const ScanPiece> pieces) {
    wholeTimeOrigin_ = survey.timeOrigin;
    for (const Scan& scan : description_.scans)
      rolesOf(scan); // for the names of all fields
    std::ranges::for_each(pieces, [&](const ScanPiece& piece) { readScan(piece); });
    box_ = survey.box;
    invalid_ = survey.invalid, clampedColors_ = survey.clampedColors;
    return finish();
  }

private:
  Imported finish() {
    std::erase_if(clouds_, [](const Cloud& cloud) { return cloud.positions.empty(); });
    imported_.origin = originOf(box_);
    for (std::size_t n = 0; n < clouds_.size(); ++n)
      addCloud(std::move(clouds_[n]), n);
    warn();
    imported_.format = "E57";
    imported_.up = AxisDirection::z;
    imported_.metres = 1;
    return std::move(imported_);
  }

  void readScan(const ScanPiece& piece) {
    const Scan& scan = description_.scans.at(piece.scan);
    const Roles roles = rolesOf(scan);
    std::vector<FieldValues> stored; // a reference into it is taken: no reallocation
    stored.reserve(scan.fields.size());
    std::vector<FieldValues*> values(scan.fields.size());
    const auto require = [&](std::size_t field, bool isNarrow) {
      if (!values[field])
        values[field] = &stored.emplace_back(scan.fields[field], piece.range, isNarrow, piece.states[field]);
    };
    for (const auto& field : roles.coordinates)
      require(*field, false);
    if (roles.invalidState)
      require(*roles.invalidState, true);
    for (const auto& field : roles.colors)
      if (field)
        require(*field, true);
    for (const auto& [field, name] : roles.attributes)
      require(field, name != timeName);
    e57::readPackets(file_, scan, values, piece.firstPacket);

    Cloud cloud;
    cloud.name = scan.name;
    cloud.intensityLimits = scan.intensityLimits;
    const std::vector<std::uint32_t> points = validPoints(piece.range, roles, values);
    readPositions(cloud, scan, piece.range.first, roles, values, points);
    if (haveAll(roles.colors))
      readColors(cloud, scan, roles, values, points);
    for (const auto& [field, name] : roles.attributes)
      readAttribute(cloud, name, *values[field], points);
    clouds_.push_back(std::move(cloud));
  }

  Roles rolesOf(const Scan& scan) {
    Roles roles;
    roles.coordinates = fieldsNamed(scan, cartesianNames);
    if (!haveAll(roles.coordinates)) {
      roles.isSpherical = true;
      roles.coordinates = fieldsNamed(scan, sphericalNames);
    }
    if (!haveAll(roles.coordinates))
      throw Error(ErrorKind::malformed, file_.locationOf(scan.section),
                  "the points of a scan have neither Cartesian nor spherical coordinates");
    roles.invalidState =
        fieldsNamed(scan, std::array{roles.isSpherical ? "sphericalInvalidState" : "cartesianInvalidState"})[0];
    roles.colors = fieldsNamed(scan, colorNames);
    std::vector<std::string> taken;
    for (std::size_t field = 0; field < scan.fields.size(); ++field) {
      const bool hasRole = std::ranges::count(roles.coordinates, field) > 0 || roles.invalidState == field ||
                           (haveAll(roles.colors) && std::ranges::count(roles.colors, field) > 0);
      if (hasRole)
        continue;
      const std::string name = pointValueName(scan.fields[field].name, taken);
      taken.push_back(name);
      addOnce(imported_.attributes, name);
      if (scan.fields[field].type != Field::Type::text && options_.attributes.has(name))
        roles.attributes.emplace_back(field, name);
      else
        addOnce(left_, name);
    }
    return roles;
  }

  static void addOnce(std::vector<std::string>& names, const std::string& name) {
    if (std::ranges::find(names, name) == names.end())
      names.push_back(name);
  }

  std::vector<std::uint32_t> validPoints(const e57::RecordRange& range, const Roles& roles,
                                         std::span<FieldValues* const> values) {
    std::vector<std::uint32_t> points;
    points.reserve(range.count);
    for (std::uint32_t point = 0; point < range.count; ++point)
      if (!roles.invalidState || values[*roles.invalidState]->narrow()[point] == 0)
        points.push_back(point);
    invalid_ += range.count - points.size();
    return points;
  }

  /// `first`: the number of the first record.
  void readPositions(Cloud& cloud, const Scan& scan, std::uint64_t first, const Roles& roles,
                     std::span<FieldValues* const> values, const std::vector<std::uint32_t>& points) {
    cloud.positions.reserve(points.size());
    for (const std::uint32_t point : points) {
      const auto coordinate = [&](std::size_t n) { return values[*roles.coordinates[n]]->wide()[point]; };
      Vec3d local{coordinate(0), coordinate(1), coordinate(2)};
      if (roles.isSpherical) {
        const double range = local.x, azimuth = local.y, elevation = local.z;
        local = {range * std::cos(elevation) * std::cos(azimuth), range * std::cos(elevation) * std::sin(azimuth),
                 range * std::sin(elevation)};
      }
      const Vec3d position = scan.pose.point(local);
      for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(position[axis]) <= std::numeric_limits<float>::max()))
          throw Error(ErrorKind::malformed, file_.locationOf(scan.section),
                      fmt::format("a coordinate of point {} of a scan is not a number or beyond single precision",
                                  first + point + 1));
      cloud.positions.push_back(position);
      box_.add(position);
    }
  }

  /// The limits that the scan states, or else the range of integers, or else 0 and 1.
  static Limits colorLimitsOf(const Scan& scan, const Roles& roles, std::size_t channel) {
    if (const auto& stated = scan.colorLimits[channel]; stated && stated->maximum > stated->minimum)
      return *stated;
    const Field& field = scan.fields[*roles.colors[channel]];
    if (field.type == Field::Type::integer && field.range > 0)
      return {field.valueOf(0), field.valueOf(field.range)};
    return {};
  }

  void readColors(Cloud& cloud, const Scan& scan, const Roles& roles, std::span<FieldValues* const> values,
                  const std::vector<std::uint32_t>& points) {
    cloud.colors.resize(points.size(), Rgba(0, 0, 0, 1));
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const Limits limits = colorLimitsOf(scan, roles, channel);
      const std::vector<float>& column = values[*roles.colors[channel]]->narrow();
      float Rgba::*const member = std::array{&Rgba::r, &Rgba::g, &Rgba::b}[channel];
      for (std::size_t n = 0; n < points.size(); ++n) {
        const double fraction = (column[points[n]] - limits.minimum) / (limits.maximum - limits.minimum);
        clampedColors_ += !(fraction >= 0 && fraction <= 1);
        cloud.colors[n].*member = channelOf(fraction);
      }
    }
  }

  void readAttribute(Cloud& cloud, const std::string& name, FieldValues& values,
                     const std::vector<std::uint32_t>& points) {
    NamedAttribute attribute{name, 1, {}};
    if (name == timeName && wholeTimeOrigin_)
      timeOrigin_ = wholeTimeOrigin_;
    attribute.values.reserve(points.size());
    for (const std::uint32_t point : points) {
      if (name != timeName) {
        attribute.values.push_back(values.narrow()[point]);
        continue;
      }
      const double seconds = values.wide()[point];
      if (!timeOrigin_ && std::isfinite(seconds))
        timeOrigin_ = std::floor(seconds);
      attribute.values.push_back(static_cast<float>(seconds - timeOrigin_.value_or(0)));
    }
    cloud.values.push_back(std::move(attribute));
  }

  void addCloud(Cloud cloud, std::size_t number) {
    std::vector<Vec3f> positions;
    positions.reserve(cloud.positions.size());
    for (const Vec3d& position : cloud.positions)
      positions.emplace_back(position - imported_.origin);
    const std::string name = !cloud.name.empty()  ? cloud.name
                             : clouds_.size() > 1 ? fmt::format("{}-{}", stemOf(name_), number + 1)
                                                  : "";
    Mesh mesh = pointCloud(name.empty() ? stemOf(name_) : name, std::move(positions));
    mesh.colors = std::move(cloud.colors);
    for (NamedAttribute& values : cloud.values)
      addPointValues(mesh, std::move(values), imported_.warnings);
    addShape(imported_.scene, std::move(mesh), name);

    MetadataSet set(imported_.scene.graph);
    set.addText("wkt", description_.wkt);
    set.addPoint("origin", imported_.origin);
    if (timeOrigin_)
      set.add("MetadataDouble", "timeStampOrigin", fmt::format("{}", *timeOrigin_));
    if (const auto& limits = cloud.intensityLimits)
      set.add("MetadataDouble", "intensityLimits", fmt::format("{} {}", limits->minimum, limits->maximum));
    set.addTo(imported_.scene.graph.roots.back(), georeferenceName);
  }

  void warn() {
    std::vector<std::string>& warnings = imported_.warnings;
    if (invalid_ > 0)
      warnings.push_back(fmt::format("{} marked as invalid in the E57 file, and left out.",
                                     counted(invalid_, "point is", "points are")));
    if (!left_.empty())
      warnings.push_back(fmt::format("Not carried over from the E57 file: {}.", fmt::join(left_, ", ")));
    if (description_.images > 0)
      warnings.push_back(fmt::format("{} not carried over.", counted(description_.images, "picture of the E57 file is",
                                                                     "pictures of the E57 file are")));
    warnOfColors(warnings, clampedColors_);
  }

  e57::PagedFile file_;
  const std::string& name_;
  const ImportOptions& options_;
  e57::Description description_;
  std::vector<Cloud> clouds_;             ///< in finish(), those with points
  Box3d box_;                             ///< of all clouds
  std::optional<double> timeOrigin_;      ///< what is subtracted from time stamps, in seconds
  std::optional<double> wholeTimeOrigin_; ///< of the whole file
  std::uint64_t invalid_ = 0, clampedColors_ = 0;
  std::vector<std::string> left_; ///< names of fields that are not kept
  Imported imported_;
};

} // namespace

bool isE57(ByteSpan bytes) {
  return asText(bytes).starts_with("ASTM-E57");
}

void e57::survey(PointSurvey& survey, ByteSpan bytes, const std::string& name, const Description& description,
                 const ScanPiece& piece) {
  const ImportOptions options{.attributes = {.all = false, .names = {std::string(timeName)}}};
  E57Reader(bytes, name, options, description).addTo(survey, piece);
}

Imported e57::readPieces(ByteSpan bytes, const std::string& name, const ImportOptions& options,
                         const Description& description, const PointSurvey& survey, std::span<const ScanPiece> pieces) {
  return E57Reader(bytes, name, options, description).readPieces(survey, pieces);
}

Imported readE57(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  return E57Reader(bytes, name, options).read();
}

} // namespace imgeo
