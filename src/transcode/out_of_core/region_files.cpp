#include "transcode/out_of_core/region_files.h"

#include "base/error.h"

#include <fmt/format.h>
#include <numeric>

namespace imgeo {

std::string taskFile(const char* pass, std::uint32_t level, std::size_t task) {
  return fmt::format("{}-{}-{}", pass, level, task);
}

Bytes writeScattered(const ScatteredElements& elements) {
  WorkWriter out;
  out.add(elements.lengths.sum());
  out.add(elements.lengths.count());
  out.add(elements.collapsed);
  out.addAll(std::span<const std::uint32_t>(elements.labels));
  out.add(std::uint64_t{elements.records.size()});
  std::uint64_t end = 0, size = 0;
  for (const std::vector<float>& records : elements.records)
    size += records.size() * sizeof(float) + sizeof end;
  out.bytes.reserve(out.bytes.size() + size);
  for (const std::vector<float>& records : elements.records)
    out.add(end += records.size());
  for (const std::vector<float>& records : elements.records) {
    const auto* from = reinterpret_cast<const std::uint8_t*>(records.data());
    out.bytes.insert(out.bytes.end(), from, from + records.size() * sizeof(float));
  }
  return std::move(out.bytes);
}

namespace {

ScatteredElements takeSums(WorkReader& in) {
  ScatteredElements elements;
  const auto sum = in.take<std::uint64_t>(), count = in.take<std::uint64_t>();
  elements.lengths = EdgeLengths(sum, count);
  elements.collapsed = in.take<std::uint64_t>();
  elements.labels = in.takeAll<std::uint32_t>();
  return elements;
}

} // namespace

ScatteredElements readScatteredSums(const std::string& path) {
  const FileView view(path);
  WorkReader in(view.bytes(), path);
  return takeSums(in);
}

std::vector<std::uint64_t> readScatteredSizes(const std::string& path) {
  const FileView view(path);
  WorkReader in(view.bytes(), path);
  takeSums(in);
  auto sizes = in.takeAll<std::uint64_t>();
  std::adjacent_difference(sizes.begin(), sizes.end(), sizes.begin());
  return sizes;
}

void appendScattered(std::vector<float>& records, const std::string& path, std::uint32_t region) {
  const FileView view(path);
  WorkReader in(view.bytes(), path);
  takeSums(in);
  const auto ends = in.takeAll<std::uint64_t>();
  if (region >= ends.size())
    throw Error(ErrorKind::malformed, path, "is no work file of this conversion; convert without --resume");
  const std::uint64_t begin = region == 0 ? 0 : ends[region - 1];
  in.takeBytes(begin * sizeof(float));
  const ByteSpan bytes = in.takeBytes((ends[region] - begin) * sizeof(float));
  const std::size_t before = records.size();
  records.resize(before + bytes.size() / sizeof(float));
  std::memcpy(records.data() + before, bytes.data(), bytes.size());
}

void visitScattered(const std::string& path, const std::function<void(std::span<const float>)>& visit) {
  const FileView view(path);
  WorkReader in(view.bytes(), path);
  takeSums(in);
  in.takeAll<std::uint64_t>();
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
