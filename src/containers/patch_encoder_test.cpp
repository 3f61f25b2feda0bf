#include "base/soak_testing.h"
#include "containers/container_reader.h"

#include "containers/named_attributes.h"
#include "containers/normals.h"
#include "containers/stored.h"
#include "containers/stored_coords.h"
#include "containers/testing.h"
#include "containers/unit_vectors.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::filesOf;
using testing::onePatch;
using testing::Random;
using testing::randomMesh;
using testing::verticesOf;

struct Encoded {
  IndexedPatch source;
  GeometryDescription geometry;
  EncodedPatch patch;
  PatchDescription description; ///< of the patch, with references
  IndexedPatch decoded() const { return decodePatch(description, geometry, filesOf(patch)); }
};

Encoded encode(const Mesh& mesh, Primitive primitive, bool indexed, std::uint32_t bits, const EncodeOptions& options) {
  const PatchedMesh patched = onePatch(mesh, bits);
  Encoded encoded{verticesOf(patched.patches[0], primitive, indexed), describe(patched, options), {}, {}};
  encoded.patch = encodePatch(encoded.source, encoded.geometry, options);
  encoded.description = testing::describedByIndex(encoded.patch);
  return encoded;
}

void expectEqualWithinSteps(const NamedAttribute& decoded, const NamedAttribute& source,
                            const GeometryDescription& geometry, std::size_t attributeIndex) {
  EXPECT_EQ(decoded.name, source.name);
  ASSERT_EQ(decoded.components, source.components);
  ASSERT_EQ(decoded.values.size(), source.values.size());
  for (std::size_t i = 0; i < source.values.size(); ++i) {
    const auto component = static_cast<std::uint32_t>(i % source.components);
    ASSERT_NEAR(decoded.values[i], source.values[i],
                numberErrorBound(geometry.encoding, geometry.attributes[attributeIndex], component));
  }
}

/// Expects integers to decode exactly, texture coordinates within half a step, and normals within the angle that their
/// encoding states.
void expectEqualWithinSteps(const Encoded& encoded) {
  const IndexedPatch& source = encoded.source;
  const IndexedPatch decoded = encoded.decoded();
  EXPECT_EQ(decoded.positions, source.positions);
  EXPECT_EQ(decoded.colors, source.colors);
  EXPECT_EQ(decoded.indices, source.indices);
  EXPECT_EQ(decoded.draws, source.draws);
  ASSERT_EQ(decoded.normals.size(), source.normals.size());
  const double normalBound = std::max(normalErrorBound(encoded.geometry), encoded.patch.normalError + 1e-6);
  for (std::size_t i = 0; i < source.normals.size(); ++i) {
    ASSERT_LE(angleBetween(decoded.normals[i], source.normals[i]), normalBound);
    ASSERT_NEAR(length(Vec3d(decoded.normals[i])), 1, 1e-6);
  }
  for (std::size_t set = 0; set < maxTexCoordSets; ++set) {
    const std::vector<Vec2f>&is = texCoordsOf(decoded, set), &should = texCoordsOf(source, set);
    ASSERT_EQ(is.size(), should.size());
    const Vec2<double> bound =
        texCoordErrorBound(encoded.geometry, set, encoded.geometry.imageBits[texCoordRoles[set]]);
    for (std::size_t i = 0; i < should.size(); ++i) {
      ASSERT_NEAR(is[i].x, should[i].x, bound.x);
      ASSERT_NEAR(is[i].y, should[i].y, bound.y);
    }
  }
  ASSERT_EQ(decoded.namedAttributes.size(), source.namedAttributes.size());
  for (std::size_t a = 0; a < source.namedAttributes.size(); ++a)
    expectEqualWithinSteps(decoded.namedAttributes[a], source.namedAttributes[a], encoded.geometry, a);
}

constexpr std::uint32_t everyPrecision[] = {8, 10, 12, 16, 20, 24, 32};

/// Options for every normal encoding that coordinates of `bits` bits allow.
std::vector<EncodeOptions> everyNormalEncoding(std::uint32_t bits) {
  const auto options = [](Encoding encoding, NormalEncoding normals, std::uint32_t normalBits) {
    return EncodeOptions{encoding, normalBits, 1, Target::web, normals};
  };
  std::vector<EncodeOptions> all;
  for (const NormalEncoding normals :
       {NormalEncoding::rgb, NormalEncoding::octahedral, NormalEncoding::spherical, NormalEncoding::palette})
    for (const std::uint32_t normalBits : {8u, 16u})
      if (normalBits == 8 || normals != NormalEncoding::palette)
        all.push_back(options(Encoding::classic, normals, normalBits));
  for (const std::uint32_t normalBits : {8u, 16u, 32u})
    all.push_back(options(Encoding::bg, NormalEncoding::rgb, normalBits));
  for (const NormalEncoding normals : {NormalEncoding::octahedral, NormalEncoding::spherical})
    all.push_back(options(Encoding::bg, normals, 16));
  if (coordBytes(Encoding::bg, bits) == 2) {
    all.push_back(options(Encoding::bg, NormalEncoding::octahedral, 8));
    all.push_back(options(Encoding::bg, NormalEncoding::spherical, 8));
  }
  return all;
}

TEST(Containers, DecodeEveryMeshAtEveryPrecision) {
  Random random(1);
  for (const std::uint32_t bits : everyPrecision)
    for (std::uint32_t seed = 0; seed < 24; ++seed) {
      const Mesh mesh = randomMesh(seed + 100 * bits);
      const bool indexed = !random.oneIn(4);
      for (const EncodeOptions& options : everyNormalEncoding(bits)) {
        SCOPED_TRACE(std::to_string(bits) + " bits, mesh " + std::to_string(seed) + ", " + nameOf(options.normals) +
                     " normals of " + std::to_string(options.normalBits));
        const Primitive primitive = static_cast<Primitive>(random.below(4));
        expectEqualWithinSteps(encode(mesh, primitive, indexed, bits, options));
      }
    }
}

/// A mesh with normals, texture coordinates, colours and two further attributes.
Mesh richMesh(std::uint32_t seed) {
  Random random(seed);
  Mesh mesh = testing::torus(3 + random.below(9), 3 + random.below(9));
  mesh.colorComponents = 3 + random.below(2);
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
    mesh.colors.push_back(random.color());
    if (mesh.colorComponents == 4)
      mesh.colors.back().a = static_cast<float>((random.bits() & 255) / 255.0);
  }
  for (const char* name : {"heat", "flow"})
    mesh.namedAttributes.push_back(
        testing::randomAttribute(random, name, static_cast<std::uint32_t>(mesh.wedgeCount())));
  return mesh;
}

TEST(Containers, DecodeEveryAttributeOfEveryPrimitiveAtEveryPrecision) {
  using enum Primitive;
  std::uint32_t seed = 0;
  for (const Encoding encoding : {Encoding::classic, Encoding::bg})
    for (const Primitive primitive : {points, lines, lineStrip, triangles, triangleStrip})
      for (const bool indexed : {true, false})
        for (std::uint32_t bits = 8; bits <= 32; ++bits) {
          EncodeOptions options;
          options.encoding = encoding;
          options.effort = 0;
          options.attributeBits = 8 * (1 + ++seed % 3);
          SCOPED_TRACE(fmt::format("encoding {}, primitive {}, {} bits, {}, seed {}", int(encoding), int(primitive),
                                   bits, indexed ? "indexed" : "without an index", seed));
          const Encoded encoded = encode(richMesh(seed), primitive, indexed, bits, options);
          EXPECT_FALSE(encoded.source.normals.empty() || encoded.source.texCoords.empty() ||
                       encoded.source.colors.empty());
          EXPECT_EQ(encoded.source.namedAttributes.size(), 2u);
          EXPECT_EQ(encoded.source.draws.front().primitive, primitive);
          expectEqualWithinSteps(encoded);
        }
}

TEST(Containers, DecodeEveryAttributeWithinTheBoundOfEachOfItsPrecisions) {
  std::uint32_t seed = 0;
  for (const Encoding encoding : {Encoding::classic, Encoding::bg})
    for (const std::uint32_t texCoordBits : {8u, 16u, encoding == Encoding::bg ? 32u : 24u})
      for (const std::uint32_t colorBits : {8u, 16u, encoding == Encoding::bg ? 32u : 24u})
        for (const EncodeOptions& normals : everyNormalEncoding(16))
          if (normals.encoding == encoding) {
            EncodeOptions options = normals;
            options.effort = 0;
            options.texCoordBits = texCoordBits;
            options.colorBits = colorBits;
            SCOPED_TRACE(fmt::format("{}: {} normals of {} bits, texture coordinates of {}, colours of {}",
                                     nameOf(encoding), nameOf(options.normals), options.normalBits, texCoordBits,
                                     colorBits));
            const Encoded encoded = encode(richMesh(++seed), Primitive::triangles, true, 16, options);
            ASSERT_FALSE(encoded.source.texCoords.empty() || encoded.source.colors.empty());
            expectEqualWithinSteps(encoded);
            for (const VertexRole role : {VertexRole::normal, VertexRole::texCoord, VertexRole::color})
              if (encoding == Encoding::classic) {
                EXPECT_EQ(1 + encoded.description.lowBytes[role].size(),
                          imageCountOf(role, options.normals, encoded.geometry.imageBits[role]));
              }
          }
}

/// BG options for every coordinate type, layout and normal encoding that can hold coordinates of `bits` bits.
std::vector<EncodeOptions> everyArray(std::uint32_t bits) {
  std::vector<EncodeOptions> all;
  for (const ElementType type : {ElementType::int8, ElementType::uint8, ElementType::int16, ElementType::uint16,
                                 ElementType::int32, ElementType::uint32})
    for (const Layout layout : {Layout::separate, Layout::interleaved})
      if (holdsLattice(type, bits))
        for (const EncodeOptions& normals : everyNormalEncoding(8 * byteSizeOf(type)))
          if (normals.encoding == Encoding::bg) {
            all.push_back(normals);
            all.back().coordType = type;
            all.back().layout = layout;
          }
  return all;
}

TEST(Containers, DecodeEveryMeshFromEveryArrayType) {
  std::uint32_t seed = 0;
  for (std::uint32_t bits = 8; bits <= 32; ++bits)
    for (const EncodeOptions& options : everyArray(bits)) {
      ++seed;
      SCOPED_TRACE(std::to_string(bits) + " bits as " + nameOf(*options.coordType) + ", layout " +
                   std::to_string(int(options.layout)) + ", mesh " + std::to_string(seed));
      const Encoded encoded = encode(randomMesh(seed), Primitive::triangles, seed % 2 == 0, bits, options);
      expectEqualWithinSteps(encoded);
      const PatchDescription& patch = encoded.description;
      if (options.layout == Layout::interleaved &&
          (patch.vertexAttributes[VertexRole::normal] || patch.vertexAttributes[VertexRole::texCoord] ||
           patch.vertexAttributes[VertexRole::color])) {
        EXPECT_EQ(encoded.patch.files.size(), patch.index ? 2u : 1u);
      }
    }
}

TEST(Containers, DecodeFloatsWithinSinglePrecision) {
  for (const std::uint32_t bits : {8u, 12u, 20u, 24u, 32u})
    for (const Layout layout : {Layout::separate, Layout::interleaved})
      for (std::uint32_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(std::to_string(bits) + " bits, mesh " + std::to_string(seed));
        const Mesh mesh = randomMesh(seed);
        const Lattice lattice = latticeFor(boxOf(mesh), ElementType::float32, bits);
        const PatchedMesh patched = cutIntoPatches(mesh, lattice, 65535);
        const EncodeOptions options{Encoding::bg,         32,    0, Target::web, NormalEncoding::rgb,
                                    ElementType::float32, layout};
        const GeometryDescription geometry = describe(patched, options);
        ASSERT_EQ(patched.patches.size(), 1u);
        const IndexedPatch source = verticesOf(patched.patches[0], Primitive::triangles, true);
        const EncodedPatch encoded = encodePatch(source, geometry, options);
        const IndexedPatch decoded = decodePatch(encoded, geometry);
        ASSERT_EQ(decoded.vertexCount(), source.vertexCount());
        for (std::size_t i = 0; i < source.vertexCount(); ++i) {
          EXPECT_EQ(decoded.positions[i], pointReadBack(source.positions[i], lattice, geometry));
          const Vec3d error = lattice.point(decoded.positions[i]) - lattice.point(source.positions[i]);
          for (int axis = 0; axis < 3; ++axis)
            EXPECT_LE(std::abs(error[axis]), positionErrorBound(geometry));
        }
      }
}

TEST(Containers, StoreTwoComponentNormalsInThePaddingOfCoordinates) {
  for (const NormalEncoding normals : {NormalEncoding::octahedral, NormalEncoding::spherical}) {
    const Encoded encoded =
        encode(testing::torus(9, 9), Primitive::triangles, true, 16, {Encoding::bg, 8, 1, Target::web, normals});
    const PatchDescription& patch = encoded.description;
    EXPECT_EQ(patch.vertexAttributes[VertexRole::normal], (Reference{patch.coord[0].url, ByteLocation{6, 8}}));
    EXPECT_EQ(encoded.patch.files.size(), 3u); // index, coordinates, texture coordinates
  }
}

SOAK_TEST(Containers, DecodeTwoComponentNormalsOfMoreVerticesThanIndicesOf16BitsAddress) {
  for (const std::uint32_t count : {65537u, 1048577u}) {
    Mesh mesh = testing::pointCloud(count, 3);
    Random random(count);
    for (std::uint32_t i = 0; i < count; ++i)
      mesh.normals.push_back(random.direction());
    expectEqualWithinSteps(
        encode(mesh, Primitive::points, false, 8, {Encoding::classic, 8, 0, Target::web, NormalEncoding::octahedral}));
  }
}

TEST(Containers, DecodePatchesOfEverySizeAroundAnImageRow) {
  for (const Encoding encoding : {Encoding::classic, Encoding::bg})
    for (const std::uint32_t count : {1u, 2u, 255u, 256u, 257u, 511u, 512u, 513u, 65535u})
      for (const bool indexed : {false, true})
        expectEqualWithinSteps(
            encode(testing::pointCloud(count, count), Primitive::points, indexed, 16, {encoding, 8, 0}));
}

SOAK_TEST(Containers, DecodeMoreVerticesThanIndicesOf16BitsAddress) {
  for (const Encoding encoding : {Encoding::classic, Encoding::bg})
    for (const std::uint32_t count : {65536u, 65537u, 262144u, 262145u})
      expectEqualWithinSteps(encode(testing::pointCloud(count, count), Primitive::points, false, 16, {encoding, 8, 0}));
}

TEST(Containers, DecodeIndicesOf32Bits) {
  for (const Encoding encoding : {Encoding::classic, Encoding::bg})
    for (const std::uint32_t side : {256u, 300u, 1030u}) { // 66,049, 90,601 and 1,062,961 vertices
      Mesh mesh = testing::grid(side);
      mesh.normals.clear();
      mesh.texCoords.clear();
      if (side > 1000)
        mesh.corners.resize(100'002); // fewer triangles over the same vertices
      mesh.corners.back() = static_cast<std::uint32_t>(mesh.wedgeCount() - 1);
      const Encoded encoded = encode(mesh, Primitive::triangles, true, 12, {encoding, 8, 0});
      EXPECT_EQ(encoded.geometry.indexType, ElementType::uint32);
      expectEqualWithinSteps(encoded);
    }
}

TEST(Containers, RefuseMoreVerticesThanTheLargestImageHolds) {
  const std::uint32_t maxVertexCount = 2048 * 2048;
  PatchedMesh mesh;
  IndexedPatch patch;
  patch.positions.resize(maxVertexCount + 1);
  patch.draws = {{Primitive::points, maxVertexCount + 1}};
  try {
    encodePatch(patch, describe(mesh, {}), {});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::limit);
  }
}

TEST(Containers, DecodeSeveralDraws) {
  for (const Encoding encoding : {Encoding::classic, Encoding::bg}) {
    const PatchedMesh patched = onePatch(testing::grid(9), 12);
    const EncodeOptions options{encoding};
    Encoded encoded{verticesOf(patched.patches[0], Primitive::triangles, true), describe(patched, options), {}, {}};
    const auto count = static_cast<std::uint32_t>(encoded.source.indices.size());
    encoded.source.draws = {
        {Primitive::triangles, 30}, {Primitive::triangleStrip, 50}, {Primitive::points, count - 80}};
    encoded.patch = encodePatch(encoded.source, encoded.geometry, options);
    encoded.description = testing::describedByIndex(encoded.patch);
    expectEqualWithinSteps(encoded);
  }
}

TEST(Containers, RefuseIndicesOf32BitsBeyondTheVertices) {
  for (const Encoding encoding : {Encoding::classic, Encoding::bg}) {
    Encoded encoded = encode(testing::grid(256), Primitive::triangles, true, 12, {encoding, 8, 0});
    ASSERT_GE(encoded.description.vertexCount, 65536u);
    encoded.description.vertexCount = encoded.source.indices.back();
    EXPECT_THROW(encoded.decoded(), Error);
    encoded.description.vertexCount = 0xffffffff;
    EXPECT_THROW(encoded.decoded(), Error);
  }
}

TEST(Containers, RefuseAnIndexWhoseVertexCountOverflows) {
  Encoded encoded = encode(testing::grid(256), Primitive::triangles, true, 12, {Encoding::bg, 8, 0});
  encoded.description.vertexCount = 0;
  EXPECT_NO_THROW(encoded.decoded());
  const std::size_t index = std::stoul(encoded.description.index->url);
  Bytes& bytes = encoded.patch.files.at(index).bytes;
  std::fill(bytes.end() - 4, bytes.end(), std::uint8_t{0xff});
  EXPECT_THROW(encoded.decoded(), Error);
}

TEST(Containers, DeriveTheVertexCountFromTheIndicesIfItIsNotStated) {
  for (const Encoding encoding : {Encoding::classic, Encoding::bg}) {
    Encoded encoded = encode(testing::torus(5, 7), Primitive::triangles, true, 16, {encoding});
    encoded.description.vertexCount = 0;
    EXPECT_EQ(encoded.decoded().positions, encoded.source.positions);
  }
}

TEST(Containers, EncodeTheSameBytesEveryTime) {
  for (const Encoding encoding : {Encoding::classic, Encoding::bg}) {
    const Encoded a = encode(randomMesh(7), Primitive::triangles, true, 16, {encoding});
    const Encoded b = encode(randomMesh(7), Primitive::triangles, true, 16, {encoding});
    ASSERT_EQ(a.patch.files.size(), b.patch.files.size());
    for (std::size_t i = 0; i < a.patch.files.size(); ++i)
      EXPECT_EQ(a.patch.files[i].bytes, b.patch.files[i].bytes);
  }
}

TEST(Containers, RefuseAFileThatIsCutAnywhere) {
  Mesh mesh = testing::torus(4, 4);
  mesh.colors.resize(mesh.wedgeCount());
  for (const Encoding encoding : {Encoding::classic, Encoding::bg}) {
    Encoded encoded = encode(mesh, Primitive::triangles, true, 16, {encoding});
    for (EncodedFile& file : encoded.patch.files) {
      const Bytes whole = file.bytes;
      for (std::size_t length = 0; length < whole.size(); ++length) {
        file.bytes.assign(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
        EXPECT_THROW(encoded.decoded(), Error) << nameOf(file.role) << ", " << length << " of " << whole.size();
      }
      file.bytes = whole;
    }
    EXPECT_NO_THROW(encoded.decoded());
  }
}

TEST(Containers, RefuseSwappedBytePlanes) {
  for (const std::uint32_t bits : {12u, 16u, 20u, 24u, 32u}) {
    Encoded encoded = encode(testing::torus(16, 8), Primitive::triangles, true, bits, {Encoding::classic});
    std::swap(encoded.description.coord[0], encoded.description.coord[1]);
    EXPECT_THROW(encoded.decoded(), Error) << bits << " bits";
  }
}

/// The kind of the Error that decoding throws.
ErrorKind decodingErrorKind(const Encoded& encoded) {
  try {
    encoded.decoded();
  } catch (const Error& error) {
    return error.kind();
  }
  ADD_FAILURE() << "was decoded";
  return ErrorKind::usage;
}

/// Sets the stride of a reference in bytes; texel references have none.
void setStride(Reference& reference, std::uint32_t stride) {
  if (ByteLocation* location = std::get_if<ByteLocation>(&reference.location))
    location->byteStride = stride;
}

void setBegin(Reference& reference, std::uint32_t begin) {
  if (ByteLocation* bytes = std::get_if<ByteLocation>(&reference.location))
    bytes->byteOffset = begin;
  else
    reference.location = TexelLocation{begin};
}

class HostilePatch : public ::testing::TestWithParam<Encoding> {
protected:
  Encoded encoded = encode(testing::torus(9, 9), Primitive::triangles, true, 16, {GetParam()});
  PatchDescription& patch = encoded.description;
};

TEST_P(HostilePatch, WithAMissingFileIsAnIoError) {
  patch.vertexAttributes[VertexRole::normal]->url = "missing";
  EXPECT_EQ(decodingErrorKind(encoded), ErrorKind::io);
}

TEST_P(HostilePatch, WithIndicesBeyondItsVerticesIsMalformed) {
  patch.vertexCount -= 1;
  EXPECT_EQ(decodingErrorKind(encoded), ErrorKind::malformed);
}

TEST_P(HostilePatch, WithMoreVerticesThanItsFilesHoldIsRefused) {
  for (const std::uint32_t count : {257u, 65536u, 0xffffffffu}) {
    patch.vertexCount = count;
    EXPECT_THROW(encoded.decoded(), Error) << count;
  }
}

TEST_P(HostilePatch, WithMoreIndicesThanItsFileHoldsIsRefused) {
  for (const std::uint32_t count : {1024u * 1024u, 0xffffffffu}) {
    patch.draws.assign(3, {Primitive::triangles, count});
    EXPECT_THROW(encoded.decoded(), Error) << count;
  }
}

TEST_P(HostilePatch, WhoseSizeOverflowsSixtyFourBitsIsRefused) {
  patch.draws.assign(1u << 20, {Primitive::triangles, 0xffffffff});
  setStride(*patch.index, 0xfffff001);
  EXPECT_THROW(encoded.decoded(), Error);
  patch.draws.assign(1u << 20, {Primitive::triangles, 1u << 12}); // 2^32 records of 2^32 bytes
  setStride(*patch.index, 0x80000000);
  EXPECT_THROW(encoded.decoded(), Error);
}

TEST_P(HostilePatch, WithoutDrawsIsMalformed) {
  patch.draws.clear();
  EXPECT_EQ(decodingErrorKind(encoded), ErrorKind::malformed);
  patch.index.reset();
  EXPECT_EQ(decodingErrorKind(encoded), ErrorKind::malformed);
}

TEST_P(HostilePatch, WithoutCoordinatesIsMalformed) {
  patch.coord.clear();
  EXPECT_EQ(decodingErrorKind(encoded), ErrorKind::malformed);
}

TEST_P(HostilePatch, ThatBeginsBeyondTheEndOfItsFilesIsRefused) {
  for (const std::uint32_t first : {1024u * 64u, 0xffffffffu}) {
    setBegin(patch.coord[0], first);
    EXPECT_THROW(encoded.decoded(), Error) << first;
  }
}

TEST_P(HostilePatch, WithSwappedFilesIsRefused) {
  std::swap(patch.coord[0], *patch.index);
  EXPECT_THROW(encoded.decoded(), Error);
}

TEST_P(HostilePatch, OutsideItsStatedBoxIsMalformed) {
  patch.box.max.x -= 0.1;
  EXPECT_EQ(decodingErrorKind(encoded), ErrorKind::malformed);
}

INSTANTIATE_TEST_SUITE_P(EveryEncoding, HostilePatch, ::testing::Values(Encoding::classic, Encoding::bg),
                         [](const auto& parameter) { return parameter.param == Encoding::classic ? "Sig" : "Bg"; });

} // namespace
} // namespace imgeo
