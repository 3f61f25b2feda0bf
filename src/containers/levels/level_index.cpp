#include "containers/levels/level_index.h"

#include "containers/compact/payload_image.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace imgeo {

namespace {

void appendNumber(Bytes& out, std::uint32_t value) {
  assert(value < 1u << 28);
  for (; value >= 128; value >>= 7)
    out.push_back(static_cast<std::uint8_t>(value | 128));
  out.push_back(static_cast<std::uint8_t>(value));
}

/// Appends the low bytes of all numbers and then the high ones.
template <typename ValueOf> void appendPlanes(Bytes& out, std::span<const LevelGroup> groups, ValueOf valueOf) {
  for (const int shift : {0, 8})
    for (std::size_t i = 0; i < groups.size(); ++i)
      out.push_back(static_cast<std::uint8_t>(valueOf(i) >> shift & 255));
}

void appendColumns(Bytes& out, std::span<const LevelGroup> groups, std::uint32_t firstNumber, const LevelIndex& index) {
  for (const LevelGroup& group : groups)
    out.push_back(group.level);
  for (int axis = 0; axis < 3; ++axis)
    appendPlanes(out, groups, [&](std::size_t i) {
      const int before = i == 0 ? 0 : groups[i - 1].sphere.center[axis];
      return static_cast<std::uint16_t>(groups[i].sphere.center[axis] - before);
    });
  appendPlanes(out, groups, [&](std::size_t i) { return groups[i].sphere.radius; });
  for (const LevelGroup& group : groups)
    out.push_back(group.errorCode);
  for (const LevelGroup& group : groups)
    appendNumber(out, group.vertices);
  if (!index.hasPoints)
    for (const LevelGroup& group : groups)
      appendNumber(out, group.triangles);
  for (const LevelGroup& group : groups)
    appendNumber(out, group.bytes);
  for (const LevelGroup& group : groups)
    appendNumber(out, static_cast<std::uint32_t>(group.children.size()));
  for (std::size_t i = 0; i < groups.size(); ++i) {
    auto before = firstNumber + static_cast<std::uint32_t>(i);
    for (const std::uint32_t child : groups[i].children) {
      appendNumber(out, child - before);
      before = child;
    }
  }
  if (!index.hasChips)
    return;
  for (const auto column : {&LevelGroup::chipColumns, &LevelGroup::chipRows, &LevelGroup::chipBytes})
    for (const LevelGroup& group : groups)
      appendNumber(out, group.*column);
}

/// The smallest sphere about the point nearest to `center` that contains the sphere of `bounds` and all of `children`.
LevelSphere sphereAround(const GroupBounds& bounds, std::uint32_t unit, std::span<const LevelSphere> children) {
  LevelSphere sphere;
  Vec3d moved;
  for (int axis = 0; axis < 3; ++axis) {
    const double code = std::clamp(std::round(bounds.center[axis] / unit), 0.0, 65535.0);
    sphere.center[axis] = static_cast<std::uint16_t>(code);
    moved[axis] = bounds.center[axis] - code * unit;
  }
  const double codes = std::ceil((bounds.radius + length(moved)) / (4.0 * unit));
  if (!(codes < unboundedRadiusCode))
    sphere.radius = unboundedRadiusCode;
  else
    sphere.radius = static_cast<std::uint16_t>(codes);
  for (const LevelSphere& child : children) {
    const double distance = length(Vec3d(sphere.center) - Vec3d(child.center));
    const double needed = std::ceil(distance / 4) + child.radius;
    if (child.radius == unboundedRadiusCode || !(needed < unboundedRadiusCode))
      sphere.radius = unboundedRadiusCode;
    else
      sphere.radius = std::max(sphere.radius, static_cast<std::uint16_t>(needed));
  }
  return sphere;
}

} // namespace

void setBounds(LevelIndex& index, std::span<const GroupBounds> bounds) {
  const std::uint32_t unit = levelUnit(index.positionBits);
  for (std::size_t number = index.groups.size(); number-- > 0;) {
    LevelGroup& group = index.groups[number];
    std::vector<LevelSphere> spheres;
    std::uint8_t code = errorCodeFor(bounds[number].error);
    for (const std::uint32_t child : group.children) {
      if (index.hasNestedSpheres)
        spheres.push_back(index.groups[child].sphere);
      code = std::max(code, static_cast<std::uint8_t>(index.groups[child].errorCode + 1));
    }
    group.errorCode = number < index.rootCount ? rootErrorCode : code;
    group.sphere = sphereAround(bounds[number], unit, spheres);
  }
}

std::uint32_t levelUnit(std::uint32_t positionBits) {
  return positionBits > 16 ? 1u << (positionBits - 16) : 1;
}

double statedError(std::uint8_t errorCode) {
  return std::exp2(errorCode / 8.0);
}

std::uint8_t errorCodeFor(double steps) {
  std::uint8_t code = 0;
  while (code < rootErrorCode - 1 && statedError(code) < steps)
    ++code;
  return code;
}

bool contains(const LevelSphere& outer, const LevelSphere& inner) {
  if (outer.radius == unboundedRadiusCode)
    return true;
  if (inner.radius > outer.radius)
    return false;
  const std::int64_t slack = std::int64_t{4} * (outer.radius - inner.radius);
  std::int64_t square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t difference = std::int64_t{outer.center[axis]} - inner.center[axis];
    square += difference * difference;
  }
  return square <= slack * slack;
}

namespace {

std::string nameOf(std::uint32_t group, const char* extension) {
  return std::to_string(group / 1000) + "/" + std::to_string(group % 1000) + extension;
}

std::string besideIndex(const std::string& indexUrl, const std::string& file) {
  return indexUrl.substr(0, indexUrl.rfind('/') + 1) + file;
}

} // namespace

std::string groupFileName(std::uint32_t group) {
  return nameOf(group, ".png");
}

std::string groupUrl(const std::string& indexUrl, std::uint32_t group) {
  return besideIndex(indexUrl, groupFileName(group));
}

std::string chipFileName(std::uint32_t group) {
  return nameOf(group, ".webp");
}

std::string chipUrl(const std::string& indexUrl, std::uint32_t group) {
  return besideIndex(indexUrl, chipFileName(group));
}

std::string levelPageUrl(const std::string& indexUrl, std::size_t page) {
  if (page == 0)
    return indexUrl;
  const std::size_t slash = indexUrl.rfind('/'), dot = indexUrl.rfind('.');
  const std::size_t end =
      dot == std::string::npos || (slash != std::string::npos && dot < slash) ? indexUrl.size() : dot;
  return indexUrl.substr(0, end) + "-" + std::to_string(page) + indexUrl.substr(end);
}

Bytes levelPagePayload(const LevelIndex& index, std::size_t page, std::span<const std::uint32_t> pageBytes) {
  const std::uint8_t features = index.hasPoints ? pointsFeature : index.hasChips ? chipFeature : std::uint8_t{0};
  const std::uint8_t version = index.hasNestedSpheres ? 1 : 2;
  Bytes out{'I', 'G', 'L', version, features};
  appendNumber(out, static_cast<std::uint32_t>(page));
  if (page == 0) {
    appendNumber(out, static_cast<std::uint32_t>(index.groups.size()));
    appendNumber(out, index.pageGroups);
    appendNumber(out, index.rootCount);
    out.push_back(static_cast<std::uint8_t>(index.positionBits));
    for (std::size_t i = 1; i < index.pageCount(); ++i)
      appendNumber(out, pageBytes[i]);
  }
  const std::size_t first = page * index.pageGroups;
  const std::size_t count = std::min<std::size_t>(index.pageGroups, index.groups.size() - first);
  appendColumns(out, std::span(index.groups).subspan(first, count), static_cast<std::uint32_t>(first), index);
  return out;
}

std::vector<Bytes> writeLevelIndex(const LevelIndex& index) {
  std::vector<Bytes> files(index.pageCount());
  std::vector<std::uint32_t> pageBytes(files.size());
  for (std::size_t page = files.size(); page-- > 0;) { // the first page states the sizes of the others
    files[page] = compact::imageOfPayload(levelPagePayload(index, page, pageBytes));
    pageBytes[page] = static_cast<std::uint32_t>(files[page].size());
  }
  return files;
}

} // namespace imgeo
