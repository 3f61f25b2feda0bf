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

ContainerReader::ContainerReader(const FetchFile& fetch) {
  for (const EncodingRow* row : allEncodings())
    readers_.push_back(row->makeReader(fetch));
}

PatchReader& ContainerReader::readerOf(const GeometryDescription& geometry) const {
  return *readers_.at(static_cast<std::size_t>(geometry.encoding));
}

IndexedPatch ContainerReader::decode(const PatchDescription& patch, const GeometryDescription& geometry) const {
  IndexedPatch decoded = readerOf(geometry).decode(patch, geometry);
  decoded.ccw = geometry.ccw;
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
