#include "import/dem/ground.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <utility>

namespace imgeo {

namespace {

constexpr double radiansPerDegree = std::numbers::pi / 180;

std::pair<double, double> heightRange(const HeightGrid& grid, const std::string& name) {
  std::pair<double, double> range{INFINITY, -INFINITY};
  for (const float height : grid.heights)
    if (!std::isnan(height))
      range = {std::min<double>(range.first, height), std::max<double>(range.second, height)};
  if (range.first > range.second)
    throw Error(ErrorKind::malformed, name, "has no cell with a height");
  return range;
}

/// Metres to the east and to the north in a radian of longitude and of latitude, on an ellipsoid.
Vec2<double> metresPerRadian(const HeightGrid& grid, double latitude) {
  const double flattening = grid.inverseFlattening > 0 ? 1 / grid.inverseFlattening : 0;
  const double e2 = flattening * (2 - flattening), w = 1 - e2 * std::sin(latitude) * std::sin(latitude);
  return {grid.semiMajor / std::sqrt(w) * std::cos(latitude), grid.semiMajor * (1 - e2) / (w * std::sqrt(w))};
}

/// Metres in a unit of height; 0 for a unit that is not known.
double metresOf(std::string unit) {
  std::ranges::transform(unit, unit.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  const auto isOne = [&](std::initializer_list<const char*> names) {
    return std::ranges::any_of(names, [&](const char* known) { return unit == known; });
  };
  if (isOne({"", "m", "metre", "metres", "meter", "meters"}))
    return 1;
  if (isOne({"ft", "foot", "feet", "international foot"}))
    return 0.3048;
  if (isOne({"us-ft", "ftus", "us survey foot", "us survey feet", "foot_us"}))
    return 1200.0 / 3937;
  if (isOne({"dm", "decimetre", "decimeter"}))
    return 0.1;
  if (isOne({"cm", "centimetre", "centimeter"}))
    return 0.01;
  if (isOne({"km", "kilometre", "kilometer"}))
    return 1000;
  return 0;
}

/// The coordinates of the middle of the grid.
Vec2<double> centreOf(const HeightGrid& grid) {
  const double column = grid.columns / 2.0, row = grid.rows / 2.0;
  if (!grid.transform)
    return {column, row};
  const auto& t = *grid.transform;
  return {t[0] + t[1] * column + t[2] * row, t[3] + t[4] * column + t[5] * row};
}

/// Whether coordinates without a reference system are degrees: they are those of the globe, and as metres the relief
/// would be steeper than any on it.
bool resemblesDegrees(const HeightGrid& grid, double relief) {
  const auto& t = *grid.transform;
  const Vec2<double> centre = centreOf(grid);
  const double width = std::abs(t[1]) * grid.columns, height = std::abs(t[5]) * grid.rows;
  return grid.wkt.empty() && std::abs(centre.x) + width / 2 <= 361 && std::abs(centre.y) + height / 2 <= 91 &&
         relief > std::max(width, height);
}

class GroundReader {
public:
  GroundReader(const HeightGrid& grid, const std::string& name)
      : grid_(grid), range_(heightRange(grid, name)), name_(name) {}

  Ground read() {
    ground_.origin = centreOf(grid_);
    readHeightUnit();
    if (!grid_.transform) {
      spreadHeights();
      return std::move(ground_);
    }
    const bool isDegrees = grid_.isGeographic || resemblesDegrees(grid_, relief() * ground_.metresPerHeight);
    ground_.metresPerUnit = isDegrees ? metresPerDegree() : Vec2<double>{grid_.unit, grid_.unit};
    const auto& t = *grid_.transform;
    const auto [east, north] = ground_.metresPerUnit;
    ground_.columnStep = {t[1] * east, -t[4] * north};
    ground_.rowStep = {t[2] * east, -t[5] * north};
    if (isDegrees)
      noteDegrees();
    return std::move(ground_);
  }

private:
  double relief() const { return range_.second - range_.first; }

  void readHeightUnit() {
    ground_.metresPerHeight = metresOf(grid_.heightUnit);
    if (ground_.metresPerHeight != 0)
      return;
    ground_.metresPerHeight = 1;
    ground_.notes.push_back(
        fmt::format("The unit of heights is \"{}\", which is taken as the metre.", grid_.heightUnit));
  }

  /// For pictures, whose numbers are no metres.
  void spreadHeights() {
    const double longest = std::max(grid_.columns, grid_.rows) - 1;
    if (relief() > 0)
      ground_.metresPerHeight = longest / 10 / relief();
    ground_.notes.push_back(
        fmt::format("The file states no cell size: a cell is a metre wide, and heights of {:.6g} to "
                    "{:.6g} are spread over {:.4g} m (--exaggerate changes that).",
                    range_.first, range_.second, longest / 10));
  }

  double radiansPerUnit() const { return grid_.isGeographic ? grid_.unit : radiansPerDegree; }

  Vec2<double> metresPerDegree() const {
    const double latitude = ground_.origin.y * radiansPerUnit();
    if (!(std::abs(latitude) < 0.4999 * std::numbers::pi))
      throw Error(ErrorKind::unsupported, name_, "is centred on a pole of its geographic coordinates");
    const auto [east, north] = metresPerRadian(grid_, latitude);
    return {east * radiansPerUnit(), north * radiansPerUnit()};
  }

  void noteDegrees() {
    const auto& t = *grid_.transform;
    const double latitude = ground_.origin.y * radiansPerUnit() / radiansPerDegree;
    const Vec2<double> cell{std::hypot(ground_.columnStep.x, ground_.columnStep.y),
                            std::hypot(ground_.rowStep.x, ground_.rowStep.y)};
    std::string note = fmt::format("Its coordinates {} degrees: cells are {:.4g} m by {:.4g} m, as at its centre, at a "
                                   "latitude of {:.4g} degrees",
                                   grid_.isGeographic ? "are" : "are taken as", cell.x, cell.y, latitude);
    const double reach = std::abs(t[5]) * grid_.rows / 2 * radiansPerUnit() / radiansPerDegree;
    const auto widthAt = [](double degrees) { return std::cos(std::clamp(degrees, -90.0, 90.0) * radiansPerDegree); };
    const double error = std::max(std::abs(widthAt(latitude + reach) / widthAt(latitude) - 1),
                                  std::abs(widthAt(latitude - reach) / widthAt(latitude) - 1));
    if (error > 0.01)
      note += fmt::format("; to the north and south their width is off by up to {:.2g} %", 100 * error);
    ground_.notes.push_back(note + ".");
  }

  const HeightGrid& grid_;
  std::pair<double, double> range_;
  const std::string& name_;
  Ground ground_;
};

} // namespace

Ground groundOf(const HeightGrid& grid, const std::string& name) {
  return GroundReader(grid, name).read();
}

} // namespace imgeo
