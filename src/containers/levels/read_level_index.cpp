// Reads the index of levels from bytes that may be damaged.

#include "base/error.h"
#include "containers/compact/payload_image.h"
#include "containers/levels/level_index.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace imgeo {

namespace {

constexpr std::uint8_t levelSignature[] = {'I', 'G', 'L'};

/// What every page states first, and all pages alike.
struct PageBeginning {
  std::uint8_t version = 0, features = 0;
  friend bool operator==(const PageBeginning&, const PageBeginning&) = default;
};

/// Reads the fields of one page.
class PageReader {
public:
  PageReader(ByteSpan bytes, std::string url) : bytes_(bytes), url_(std::move(url)) {}

  std::uint8_t byte() {
    if (at_ == bytes_.size())
      throw Error(ErrorKind::truncated, url_, "the index of levels ends too early");
    return bytes_[at_++];
  }

  /// A number below 2^28, stored as seven bits per byte, the least significant bits first.
  std::uint32_t number() {
    std::uint32_t value = 0;
    for (std::uint32_t shift = 0; shift < 28; shift += 7) {
      const std::uint8_t next = byte();
      value |= (next & 127u) << shift;
      if (next < 128)
        return value;
    }
    throw Error(ErrorKind::malformed, url_, "the index of levels states a number that is too long");
  }

  /// A number of things, 1 .. max. Throws Error{limit} if it is above `max`.
  std::uint32_t count(std::uint32_t max, const char* things) {
    const std::uint32_t value = number();
    require(value > 0, std::string("the index of levels states no ") + things);
    if (value > max)
      throw Error(ErrorKind::limit, url_, "an index of levels has at most " + std::to_string(max) + " " + things);
    return value;
  }

  void require(bool condition, const std::string& message) const {
    if (!condition)
      throw Error(ErrorKind::malformed, url_, message);
  }
  void requireOfGroup(bool condition, std::size_t group, const char* message) const {
    if (!condition)
      throw Error(ErrorKind::malformed, url_, "group " + std::to_string(group) + " " + message);
  }

  PageBeginning readBeginning(std::size_t page) {
    std::uint8_t begin[4];
    for (std::uint8_t& each : begin)
      each = byte();
    require(std::equal(std::begin(levelSignature), std::end(levelSignature), begin), "is no index of levels");
    if (begin[3] != 1 && begin[3] != 2)
      throw Error(ErrorKind::unsupported, url_,
                  "an index of levels of version " + std::to_string(begin[3]) + " is not known");
    const std::uint8_t features = byte();
    if (features != 0 && features != pointsFeature && features != chipFeature)
      throw Error(ErrorKind::unsupported, url_, "the index of levels has features that are not known");
    require(number() == page, "is another page of an index of levels");
    return {begin[3], features};
  }

private:
  ByteSpan bytes_;
  std::size_t at_ = 0;
  std::string url_;
};

struct IndexHeader {
  LevelIndex index; ///< without groups
  std::uint32_t groupCount = 0;
  std::vector<std::uint32_t> pageBytes; ///< by page; 0 for the first
};

IndexHeader readHeader(PageReader& reader) {
  IndexHeader header;
  header.groupCount = reader.count(maxLevelGroups, "groups");
  header.index.pageGroups = reader.count(maxLevelPageGroups, "groups a page");
  header.index.rootCount = reader.count(maxLevelGroups, "roots");
  reader.require(header.index.rootCount <= header.groupCount, "the index of levels states more roots than groups");
  header.index.positionBits = reader.byte();
  reader.require(header.index.positionBits >= minLevelPositionBits && header.index.positionBits <= maxLevelPositionBits,
                 "the index of levels states impossible position bits");
  const std::uint32_t pages = (header.groupCount - 1) / header.index.pageGroups + 1;
  header.pageBytes.push_back(0);
  for (std::uint32_t page = 1; page < pages; ++page)
    header.pageBytes.push_back(reader.count(maxGroupBytes, "bytes of a page"));
  return header;
}

/// Reads 16-bit numbers: their low bytes, then their high ones.
std::vector<std::uint16_t> readPlanes(PageReader& reader, std::size_t count) {
  std::vector<std::uint16_t> values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(reader.byte());
  for (std::size_t i = 0; i < count; ++i)
    values[i] = static_cast<std::uint16_t>(values[i] | reader.byte() << 8);
  return values;
}

/// Appends the groups of a page to those of the pages before.
void readColumns(PageReader& reader, std::size_t count, std::uint32_t groupCount, LevelIndex& index) {
  std::vector<LevelGroup>& all = index.groups;
  const std::size_t first = all.size();
  for (std::size_t i = 0; i < count; ++i) { // grows with the bytes that are there
    all.emplace_back().level = reader.byte();
    reader.requireOfGroup(all.back().level < maxLevelCount, first + i, "has an impossible level");
  }
  const std::span<LevelGroup> groups = std::span(all).subspan(first);
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<std::uint16_t> differences = readPlanes(reader, count);
    std::uint16_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
      groups[i].sphere.center[axis] = value = static_cast<std::uint16_t>(value + differences[i]);
  }
  const std::vector<std::uint16_t> radii = readPlanes(reader, count);
  for (std::size_t i = 0; i < count; ++i)
    groups[i].sphere.radius = radii[i];
  for (LevelGroup& group : groups)
    group.errorCode = reader.byte();
  for (LevelGroup& group : groups)
    group.vertices = reader.count(maxGroupCount, "vertices of a group");
  for (LevelGroup& group : groups)
    group.triangles = index.hasPoints ? 0 : reader.count(maxGroupCount, "triangles of a group");
  for (LevelGroup& group : groups)
    group.bytes = reader.count(maxGroupBytes, "bytes of a group");
  std::vector<std::uint32_t> childCounts;
  for (std::size_t i = 0; i < count; ++i) {
    childCounts.push_back(reader.number());
    const bool fits = childCounts[i] <= (index.hasPoints ? groups[i].vertices : groups[i].triangles);
    reader.requireOfGroup(fits, first + i, "has more children than triangles or points");
    reader.requireOfGroup((childCounts[i] == 0) == (groups[i].level == 0), first + i,
                          "has children on level 0, or none above");
  }
  for (std::size_t i = 0; i < count; ++i) {
    auto child = static_cast<std::uint32_t>(first + i);
    for (std::uint32_t n = 0; n < childCounts[i]; ++n) {
      const std::uint32_t difference = reader.number();
      reader.requireOfGroup(difference > 0 && difference < groupCount - child, first + i,
                            "has children that do not exist");
      groups[i].children.push_back(child += difference);
    }
  }
  if (!index.hasChips)
    return;
  for (LevelGroup& group : groups)
    group.chipColumns = reader.count(maxChipImageEdge, "columns of an image");
  for (LevelGroup& group : groups)
    group.chipRows = reader.count(maxChipImageEdge, "rows of an image");
  for (LevelGroup& group : groups)
    group.chipBytes = reader.count(maxGroupBytes, "bytes of an image");
}

/// Checks the levels and errors of the groups from `first` on, and each as a child of its parents, which come before
/// it. `hasParent` and `laterParents` say what the pages before have told about the groups.
void checkRelations(const PageReader& reader, const LevelIndex& index, std::uint32_t groupCount, std::size_t first,
                    std::vector<bool>& hasParent, std::map<std::size_t, std::vector<std::size_t>>& laterParents) {
  const auto checkChild = [&](std::size_t parentNumber, std::size_t childNumber) {
    const LevelGroup &parent = index.groups[parentNumber], &child = index.groups[childNumber];
    reader.requireOfGroup(child.level + 1 == parent.level, childNumber, "is not on the level below its parents'");
    reader.requireOfGroup(child.errorCode < parent.errorCode, childNumber, "has no smaller error than its parents");
    reader.requireOfGroup(!index.hasNestedSpheres || contains(parent.sphere, child.sphere), childNumber,
                          "lies outside of its parents' spheres");
  };
  for (std::size_t number = first; number < index.groups.size(); ++number) {
    const LevelGroup& group = index.groups[number];
    const bool isRoot = number < index.rootCount;
    const std::uint8_t before = number == 0 ? group.level : index.groups[number - 1].level;
    reader.requireOfGroup(group.level <= before && isRoot == (group.level == index.groups[0].level), number,
                          "is in the wrong order of levels");
    reader.requireOfGroup(isRoot == (group.errorCode == rootErrorCode), number, "has the error of a root, or lacks it");
    if (const auto parents = laterParents.find(number); parents != laterParents.end()) {
      for (const std::size_t parent : parents->second)
        checkChild(parent, number);
      laterParents.erase(parents);
    }
    reader.requireOfGroup(isRoot || hasParent[number], number, "has no parent");
    for (const std::uint32_t child : group.children) {
      hasParent[child] = true;
      if (child < index.groups.size())
        checkChild(number, child);
      else
        laterParents[child].push_back(number);
    }
  }
  reader.requireOfGroup(index.groups.size() < groupCount || index.groups.back().level == 0, groupCount - 1,
                        "is the last one and not on level 0");
}

/// payloadOf(page, bytes) gives the payload of a page; `bytes` is the size of its file, 0 if it is not stated.
template <typename PayloadOf> LevelIndex readPages(const std::string& url, PayloadOf payloadOf) {
  const Bytes firstPayload = payloadOf(0, 0);
  PageReader firstReader(firstPayload, url);
  const PageBeginning beginning = firstReader.readBeginning(0);
  IndexHeader header = readHeader(firstReader);
  LevelIndex index = std::move(header.index);
  index.hasPoints = beginning.features == pointsFeature;
  index.hasChips = beginning.features == chipFeature;
  index.hasNestedSpheres = beginning.version == 1;
  // An index of few bytes takes little memory: all but this grows with the pages that have been read.
  std::vector<bool> hasParent(header.groupCount);
  std::map<std::size_t, std::vector<std::size_t>> laterParents; // of groups on pages that have not been read
  const auto readPage = [&](PageReader& reader) {
    const std::size_t first = index.groups.size();
    const std::size_t count = std::min<std::size_t>(index.pageGroups, header.groupCount - first);
    readColumns(reader, count, header.groupCount, index);
    checkRelations(reader, index, header.groupCount, first, hasParent, laterParents);
  };
  readPage(firstReader);
  for (std::size_t page = 1; page < header.pageBytes.size(); ++page) {
    const Bytes payload = payloadOf(page, header.pageBytes[page]);
    PageReader reader(payload, levelPageUrl(url, page));
    const PageBeginning own = reader.readBeginning(page);
    reader.require(own.features == beginning.features, "has other features than the first page");
    reader.require(own.version == beginning.version, "has another version than the first page");
    readPage(reader);
  }
  return index;
}

} // namespace

LevelIndex readLevelIndex(const std::string& url, const FetchLevelFile& fetch) {
  return readPages(url, [&](std::size_t page, std::uint32_t bytes) {
    const std::string pageUrl = levelPageUrl(url, page);
    const Bytes file = fetch(pageUrl);
    if (page > 0 && file.size() != bytes)
      throw Error(ErrorKind::malformed, pageUrl, "has another size than the index of levels states");
    return compact::payloadOfImage(file, pageUrl);
  });
}

LevelIndex readLevelPayloads(std::span<const Bytes> payloads, const std::string& url) {
  return readPages(url, [&](std::size_t page, std::uint32_t) {
    if (page >= payloads.size())
      throw Error(ErrorKind::truncated, levelPageUrl(url, page), "the index of levels lacks a page");
    return payloads[page];
  });
}

} // namespace imgeo
