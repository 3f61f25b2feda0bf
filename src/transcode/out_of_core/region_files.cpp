#include "transcode/out_of_core/region_files.h"

#include "base/error.h"
#include "base/random_access_file.h"

#include <array>
#include <bit>
#include <fmt/format.h>
#include <numeric>

namespace imgeo {

std::string taskFile(const char* pass, std::uint32_t level, std::size_t task) {
  return fmt::format("{}-{}-{}", pass, level, task);
}

namespace {

/// What a work file of scattered elements begins with. `regionCount` numbers follow: the floats up to the end of each
/// region's records. Then come the sums; the records are the rest of the file. So one region's records are found
/// without reading the others, whose number is that of the regions, in as many files as the source has pieces.
struct ScatteredHeader {
  std::uint64_t recordsOffset;
  std::uint64_t regionCount;
};

[[noreturn]] void failForeign(const std::string& path) {
  throw Error(ErrorKind::malformed, path, "is no work file of this conversion; convert without --resume");
}

void readAt(const RandomAccessFile& file, const std::string& path, std::uint64_t offset, std::span<std::uint8_t> to) {
  if (offset > file.size() || to.size() > file.size() - offset)
    failForeign(path);
  file.read(offset, to);
}

template <typename T> T valueAt(const RandomAccessFile& file, const std::string& path, std::uint64_t offset) {
  std::array<std::uint8_t, sizeof(T)> bytes;
  readAt(file, path, offset, bytes);
  return std::bit_cast<T>(bytes);
}

std::vector<std::uint64_t> takeEnds(WorkReader& in) {
  in.take<std::uint64_t>(); // recordsOffset
  return in.takeAll<std::uint64_t>();
}

ScatteredElements takeSums(WorkReader& in) {
  ScatteredElements elements;
  const auto sum = in.take<std::uint64_t>(), count = in.take<std::uint64_t>();
  elements.lengths = EdgeLengths(sum, count);
  elements.collapsed = in.take<std::uint64_t>();
  elements.labels = in.takeAll<std::uint32_t>();
  return elements;
}

} // namespace

Bytes writeScattered(const ScatteredElements& elements) {
  WorkWriter sums;
  sums.add(elements.lengths.sum());
  sums.add(elements.lengths.count());
  sums.add(elements.collapsed);
  sums.addAll(std::span<const std::uint32_t>(elements.labels));
  std::vector<std::uint64_t> ends;
  ends.reserve(elements.records.size());
  for (std::uint64_t end = 0; const std::vector<float>& records : elements.records)
    ends.push_back(end += records.size());

  WorkWriter out;
  const std::uint64_t recordsOffset = sizeof(ScatteredHeader) + ends.size() * sizeof(std::uint64_t) + sums.bytes.size();
  out.bytes.reserve(recordsOffset + (ends.empty() ? 0 : ends.back() * sizeof(float)));
  out.add(recordsOffset);
  out.addAll(std::span<const std::uint64_t>(ends));
  out.bytes.insert(out.bytes.end(), sums.bytes.begin(), sums.bytes.end());
  for (const std::vector<float>& records : elements.records) {
    const auto* from = reinterpret_cast<const std::uint8_t*>(records.data());
    out.bytes.insert(out.bytes.end(), from, from + records.size() * sizeof(float));
  }
  return std::move(out.bytes);
}

ScatteredElements readScatteredSums(const std::string& path) {
  const FileView view(path);
  WorkReader in(view.bytes(), path);
  takeEnds(in);
  return takeSums(in);
}

std::vector<std::uint64_t> readScatteredSizes(const std::string& path) {
  const FileView view(path);
  WorkReader in(view.bytes(), path);
  auto sizes = takeEnds(in);
  std::adjacent_difference(sizes.begin(), sizes.end(), sizes.begin());
  return sizes;
}

void appendScattered(std::vector<float>& records, const std::string& path, std::uint32_t region) {
  const RandomAccessFile file(path);
  const auto header = valueAt<ScatteredHeader>(file, path, 0);
  if (region >= header.regionCount)
    failForeign(path);
  const auto endOf = [&](std::uint64_t of) {
    return valueAt<std::uint64_t>(file, path, sizeof(ScatteredHeader) + of * sizeof(std::uint64_t));
  };
  const std::uint64_t begin = region == 0 ? 0 : endOf(region - 1), end = endOf(region);
  if (end < begin || end > file.size() / sizeof(float))
    failForeign(path);
  const std::size_t before = records.size();
  records.resize(before + (end - begin));
  const std::span<float> added = std::span(records).subspan(before);
  readAt(file, path, header.recordsOffset + begin * sizeof(float),
         {reinterpret_cast<std::uint8_t*>(added.data()), added.size_bytes()});
}

void visitScattered(const std::string& path, const std::function<void(std::span<const float>)>& visit) {
  const FileView view(path);
  WorkReader in(view.bytes(), path);
  takeEnds(in);
  takeSums(in);
  visit(floatsOf(in.rest()));
}

Bytes writeRegionGroups(const RegionGroups& groups, const std::vector<Bytes>& files, const std::vector<Bytes>& chips) {
  WorkWriter out;
  out.add(groups.formElements);
  out.add(std::uint64_t{groups.rows.size()});
  for (const GroupRow& row : groups.rows) {
    out.add(row.group.level), out.addAll(std::span<const std::uint32_t>(row.group.children));
    out.add(row.group.center), out.add(row.group.radius), out.add(row.group.error);
    out.add(std::uint64_t{row.file.vertices}), out.add(std::uint64_t{row.file.triangles});
    out.add(row.file.bytes), out.add(row.file.normalError);
    out.addText(row.file.contentName);
    out.add(row.chip.size), out.add(row.chip.texelEdge), out.add(row.chip.bytes), out.addText(row.chip.contentName);
  }
  for (const std::vector<Bytes>* const each : {&files, &chips})
    for (const Bytes& file : *each)
      out.bytes.insert(out.bytes.end(), file.begin(), file.end());
  return std::move(out.bytes);
}

RegionGroups readRegionGroups(ByteSpan bytes, const std::string& path) {
  WorkReader in(bytes, path);
  RegionGroups groups;
  groups.formElements = in.take<std::uint64_t>();
  for (auto count = in.take<std::uint64_t>(); count > 0; --count) {
    GroupRow& row = groups.rows.emplace_back();
    row.group.level = in.take<std::uint32_t>(), row.group.children = in.takeAll<std::uint32_t>();
    row.group.center = in.take<Vec3d>(), row.group.radius = in.take<double>(), row.group.error = in.take<double>();
    row.file.vertices = in.take<std::uint64_t>(), row.file.triangles = in.take<std::uint64_t>();
    row.file.bytes = in.take<std::uint32_t>(), row.file.normalError = in.take<double>();
    row.file.contentName = in.takeText();
    row.chip.size = in.take<RasterSize>(), row.chip.texelEdge = in.take<double>();
    row.chip.bytes = in.take<std::uint32_t>(), row.chip.contentName = in.takeText();
  }
  groups.dataOffset = bytes.size() - in.rest().size();
  return groups;
}

std::span<const float> floatsOf(ByteSpan bytes) {
  // Records begin at a multiple of four bytes of a mapped file, or of memory of its own.
  return {reinterpret_cast<const float*>(bytes.data()), bytes.size() / sizeof(float)};
}

} // namespace imgeo
