#include "containers/container_reader.h"

#include "base/error.h"
#include "containers/encodings.h"

#include <algorithm>

namespace imgeo {

BaseMesh PatchReader::decodeBase(const GeometryDescription&) {
  throw Error(ErrorKind::unsupported, "", "the encoding has no base mesh");
}

IndexedPatch SinglePatchReader::decode(const PatchDescription& patch, const GeometryDescription& geometry) {
  return decode_(patch, geometry, fetch_);
}

StoredPrecision SinglePatchReader::precisionOf(const GeometryDescription& geometry) {
  StoredPrecision precision;
  precision.normalEncoding = geometry.normalEncoding;
  for (const VertexRole role : vertexRoles)
    if (std::ranges::any_of(geometry.patches,
                            [&](const PatchDescription& patch) { return patch.vertexAttributes[role].has_value(); }))
      precision.bits[role] =
          hasElementTypes(geometry.encoding) ? 8 * byteSizeOf(geometry.attributeTypes[role]) : geometry.imageBits[role];
  return precision;
}

ContainerReader::ContainerReader(const FetchFile& fetch) : fetch_(fetch) {
  for (const EncodingRow* row : allEncodings())
    readers_.push_back(row->makeReader(fetch));
}

PatchReader& ContainerReader::readerOf(const GeometryDescription& geometry) const {
  return *readers_.at(static_cast<std::size_t>(geometry.encoding));
}

Lattice ContainerReader::latticeOf(const GeometryDescription& geometry) const {
  return readerOf(geometry).latticeOf(geometry);
}

namespace {

/// Leaves out the draws of other kinds of elements; the vertices stay.
void keepDrawsOf(Topology topology, IndexedPatch& patch) {
  std::vector<std::uint32_t> indices;
  std::size_t first = 0;
  for (const Draw& draw : patch.draws) {
    for (std::size_t n = first; n < first + draw.count && topologyOf(draw.primitive) == topology; ++n)
      indices.push_back(patch.indices.empty() ? static_cast<std::uint32_t>(n) : patch.indices[n]);
    first += draw.count;
  }
  patch.indices = std::move(indices);
  std::erase_if(patch.draws, [&](const Draw& draw) { return topologyOf(draw.primitive) != topology; });
}

} // namespace

IndexedPatch ContainerReader::decode(const PatchDescription& patch, const GeometryDescription& geometry) const {
  IndexedPatch decoded = readerOf(geometry).decode(patch, geometry);
  decoded.ccw = geometry.ccw;
  if (geometry.levels && geometry.levels->chipSet > 0) // that of images, which pages alone read
    texCoordsOf(decoded, geometry.levels->chipSet).clear();
  if (geometry.topology)
    keepDrawsOf(*geometry.topology, decoded);
  return decoded;
}

BaseMesh ContainerReader::decodeBase(const GeometryDescription& geometry) const {
  return readerOf(geometry).decodeBase(geometry);
}

StoredPrecision ContainerReader::precisionOf(const GeometryDescription& geometry) const {
  return readerOf(geometry).precisionOf(geometry);
}

IndexedPatch decodePatch(const PatchDescription& patch, const GeometryDescription& geometry, const FetchFile& fetch) {
  return ContainerReader(fetch).decode(patch, geometry);
}

IndexedPatch decodePatch(const EncodedPatch& encoded, const GeometryDescription& geometry) {
  std::vector<std::string> urls;
  for (std::size_t i = 0; i < encoded.files.size(); ++i)
    urls.push_back("file " + std::to_string(i));
  return decodePatch(describeWithUrls(encoded, urls), geometry, [&](const std::string& url) {
    return encoded.files[static_cast<std::size_t>(std::ranges::find(urls, url) - urls.begin())].bytes;
  });
}

} // namespace imgeo
