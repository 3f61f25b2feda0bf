#include "containers/classic/classic.h"

#include "base/error.h"
#include "base/narrow.h"
#include "base/parallel.h"
#include "containers/classic/attribute_images.h"
#include "containers/classic/layout.h"
#include "containers/image_file.h"
#include "containers/limits.h"
#include "containers/named_attributes.h"
#include "containers/normals.h"
#include "containers/stored.h"
#include "containers/stored_coords.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace imgeo {

namespace {

struct RoleImage {
  Role role;
  Image image;
  std::size_t attribute = 0; ///< index in the geometry's attributes; Role::attribute only
};

ImageSize recordImageSizeOf(const IndexedPatch& patch, Target target) {
  if (target == Target::x3dom)
    return {recordColumns, std::bit_ceil(rowsFor(patch.vertexCount(), recordColumns))};
  return recordImageSize(patch.vertexCount());
}

/// The size that implicitMeshSize states: that of the index image or, without an index, of the used rows of the record
/// images.
ImageSize implicitMeshSizeOf(const IndexedPatch& patch, ImageSize records, Target target) {
  const ImageSize size =
      patch.indices.empty()     ? ImageSize{records.columns, rowsFor(patch.vertexCount(), records.columns)}
      : target == Target::x3dom ? ImageSize{recordColumns, rowsFor(patch.indices.size(), recordColumns)}
                                : longImageSize(patch.indices.size());
  if (size.rows > guaranteedImageEdge)
    throw Error(ErrorKind::limit, "",
                "a patch that draws " + std::to_string(drawnCount(patch.draws)) +
                    " vertices does not fit into an image; use smaller patches");
  return size;
}

/// Stores three bytes of each index. They are enough: no image that readers accept has more than 2^24 texels.
Image wideIndexImage(const IndexedPatch& patch, ImageSize size) {
  return imageOf(size, 3, patch.indices.size(), [&](std::size_t n, std::uint8_t* out) {
    for (std::uint32_t byte = 0; byte < 3; ++byte)
      out[byte] = static_cast<std::uint8_t>(patch.indices[n] >> (8 * byte));
  });
}

Image indexImage(const IndexedPatch& patch, ImageSize size, ImageSize records) {
  const std::uint32_t rowStep = recordColumns / records.rows;
  return imageOf(size, 3, patch.indices.size(), [&](std::size_t n, std::uint8_t* out) {
    const std::uint32_t record = patch.indices[n];
    out[0] = static_cast<std::uint8_t>(record % recordColumns);
    out[1] = static_cast<std::uint8_t>(record / recordColumns * rowStep);
    out[2] = 0;
  });
}

/// The image of byte `plane` of every coordinate, counted from the least significant.
Image coordImage(const IndexedPatch& patch, ImageSize size, const StoredCoords& stored, std::uint32_t plane) {
  return imageOf(size, 3, patch.vertexCount(), [&](std::size_t n, std::uint8_t* out) {
    for (int axis = 0; axis < 3; ++axis)
      out[axis] = static_cast<std::uint8_t>(storeCoord(patch.positions[n][axis], stored) >> (8 * plane));
  });
}

/// The image of byte `plane` of every number, counted from the least significant; one channel for each component.
Image namedAttributeImage(const NamedAttribute& attribute, const AttributeDescription& description, ImageSize size,
                          std::size_t count, std::uint32_t plane) {
  return imageOf(size, channelsOf(description), count, [&](std::size_t n, std::uint8_t* out) {
    for (std::uint32_t c = 0; c < description.components; ++c) {
      const float value = attribute.values[n * description.components + c];
      out[c] = static_cast<std::uint8_t>(storeNumber(value, description, c) >> (8 * plane));
    }
  });
}

/// The image of byte `plane` of the heights of a height map.
Image heightImage(const IndexedPatch& patch, ImageSize size, std::uint32_t plane) {
  return imageOf(size, 1, patch.vertexCount(), [&](std::size_t n, std::uint8_t* out) {
    *out = static_cast<std::uint8_t>(patch.positions[n].y >> (8 * plane));
  });
}

/// Adds the images of each property of the patch, but not of its indices.
void addRecordImages(const IndexedPatch& patch, const GeometryDescription& geometry, ImageSize size,
                     std::vector<RoleImage>& images) {
  const StoredCoords stored = storedCoords(Encoding::classic, geometry.coordType, geometry.lattice.bits);
  for (std::uint32_t plane = coordBytes(Encoding::classic, geometry.lattice.bits); plane-- > 0;)
    images.push_back({Role::coord, geometry.grid == GridKind::heightMap ? heightImage(patch, size, plane)
                                                                        : coordImage(patch, size, stored, plane)});
  for (const VertexRole role : vertexRoles)
    if (hasAttribute(patch, role))
      for (Image& image : attributeImages(role, patch, geometry, size))
        images.push_back({fileRoleOf(role), std::move(image)});
  for (std::size_t a = 0; a < geometry.attributes.size(); ++a)
    for (std::uint32_t plane = geometry.attributes[a].bytes; plane-- > 0;)
      images.push_back(
          {Role::attribute,
           namedAttributeImage(patch.namedAttributes.at(a), geometry.attributes[a], size, patch.vertexCount(), plane),
           a});
}

/// Adds the images as files, with a reference to each.
void addFiles(EncodedPatch& encoded, const std::vector<RoleImage>& images, const EncodeOptions& options) {
  std::vector<EncodedImage> encodedImages(images.size());
  parallelFor(images.size(),
              [&](std::size_t i) { encodedImages[i] = encodeImage(images[i].image, options.images, options.effort); });
  for (std::size_t i = 0; i < images.size(); ++i) {
    const FileIndex file =
        addFile(encoded, {images[i].role, extensionOf(encodedImages[i].format), std::move(encodedImages[i].bytes)});
    encoded.references.push_back({images[i].role, file, TexelLocation{}, images[i].attribute});
  }
}

} // namespace

EncodedPatch encodeClassic(const IndexedPatch& patch, const GeometryDescription& geometry,
                           const EncodeOptions& options) {
  const Target target = options.target;
  EncodedPatch encoded{.description = describePatch(patch, geometry)};
  const ImageSize records = recordImageSizeOf(patch, target);
  const ImageSize implicitMeshSize = implicitMeshSizeOf(patch, records, target);
  encoded.description.implicitMeshSize = {implicitMeshSize.columns, implicitMeshSize.rows};

  std::vector<RoleImage> images;
  if (!patch.indices.empty())
    images.push_back({Role::index, geometry.indexType == ElementType::uint32
                                       ? wideIndexImage(patch, implicitMeshSize)
                                       : indexImage(patch, implicitMeshSize, records)});
  addRecordImages(patch, geometry, records, images);
  if (geometry.normalEncoding == NormalEncoding::palette && hasAttribute(patch, VertexRole::normal))
    encoded.normalError = paletteErrorOf(patch, std::ranges::find(images, Role::normal, &RoleImage::role)->image);
  addFiles(encoded, images, options);
  return encoded;
}

EncodedPatch encodeGrids(const IndexedPatch& vertices, std::uint32_t columns, const GeometryDescription& geometry,
                         const EncodeOptions& options) {
  assert(geometry.grid && !isPair(geometry.normalEncoding) && vertices.vertexCount() % columns == 0);
  EncodedPatch encoded;
  std::vector<RoleImage> images;
  addRecordImages(vertices, geometry, {columns, rowsFor(vertices.vertexCount(), columns)}, images);
  addFiles(encoded, images, options);
  return encoded;
}

} // namespace imgeo
