#include "documents/documents.h"

#include "base/error.h"
#include "containers/named_attributes.h"
#include "containers/normals.h"
#include "containers/stored_coords.h"
#include "containers/testing.h"
#include "documents/appearance_names.h"
#include "documents/element_writer.h"
#include "scene/shape_instances.h"

#include <gtest/gtest.h>
#include <map>

namespace imgeo {
namespace {

using testing::Random;
using testing::shapeName;

/// Random text with characters that markup has to escape.
std::string randomText(Random& random) {
  static const char* pieces[] = {"a",  "\"",   "'",    "<",        ">",       "&", "&amp;", "</script>", "-->", "]]>",
                                 "\n", "\t",   "\r\n", "<X3D>",    "</X3D>",  "é", "像",    "𝄞",         " ",   "  ",
                                 "\\", "\\\"", "#",    "\xc2\xa0", "&#60;x&", "=", "/>",    "<!--",      "%",   "0"};
  std::string text = "t"; // leading white space is kept, too, but not tested
  for (std::uint32_t count = random.below(8); count > 0; --count)
    text += pieces[random.below(std::size(pieces))];
  return text;
}

Vec3d randomVector(Random& random) {
  return Vec3d(random.point()) * std::exp2(static_cast<double>(random.below(60)) - 30);
}
Vec3f randomColor(Random& random) {
  return random.point() * 0.5f + Vec3f{0.5f, 0.5f, 0.5f};
}
Box3d randomBox(Random& random) {
  Box3d box;
  if (random.oneIn(5))
    return box;
  box.add(randomVector(random));
  box.add(randomVector(random));
  return box;
}

Reference randomReference(Random& random, Encoding encoding) {
  const std::string url = "f" + std::to_string(random.below(1000)) + (random.oneIn(3) ? "\" &'<x>.png" : ".bin");
  const std::uint32_t begin = random.oneIn(2) ? random.bits() : 0;
  if (encoding != Encoding::bg)
    return {url, TexelLocation{begin}};
  return {url, ByteLocation{begin, random.oneIn(2) ? 1 + random.below(64) : 0}};
}

/// Sets bits that images hold, and gives every patch the images for them.
void setRandomImageBits(Random& random, GeometryDescription& geometry) {
  const std::uint32_t texCoordBits = 8 * (1 + random.below(3));
  for (const VertexRole role : vertexRoles) {
    std::uint32_t bits = isTexCoord(role) ? texCoordBits : 8 * (1 + random.below(3));
    if (imageCountOf(role, geometry.normalEncoding, bits) == 0)
      bits = 8;
    bool isStored = false;
    for (PatchDescription& patch : geometry.patches)
      if (patch.vertexAttributes[role]) {
        isStored = true;
        for (std::size_t image = 1; image < imageCountOf(role, geometry.normalEncoding, bits); ++image)
          patch.lowBytes[role].push_back(randomReference(random, geometry.encoding));
      }
    if (isStored)
      geometry.imageBits[role] = bits;
  }
}

PatchDescription randomPatch(Random& random, Encoding encoding, std::size_t planes) {
  PatchDescription patch;
  patch.box = randomBox(random);
  patch.vertexCount = random.bits();
  for (std::uint32_t draws = 1 + random.below(3); draws > 0; --draws)
    patch.draws.push_back({static_cast<Primitive>(random.below(4)), random.bits()});
  if (encoding == Encoding::classic)
    patch.implicitMeshSize = {1 + random.below(4096), 1 + random.below(4096)};
  if (random.oneIn(2))
    patch.index = randomReference(random, encoding);
  for (std::size_t plane = 0; plane < planes; ++plane)
    patch.coord.push_back(randomReference(random, encoding));
  for (const VertexRole role : vertexRoles)
    if (random.oneIn(2))
      patch.vertexAttributes[role] = randomReference(random, encoding);
  return patch;
}

GeometryDescription randomGeometry(Random& random) {
  GeometryDescription geometry;
  geometry.encoding = random.oneIn(2) ? Encoding::classic : Encoding::bg;
  geometry.lattice = {randomVector(random), length(randomVector(random)) + 1e-6, 8 + random.below(25)};
  geometry.box = randomBox(random);
  for (auto& [min, size] : geometry.texCoordBoxes) {
    if (random.oneIn(2))
      min = {random.between(-5, 5), random.between(-5, 5)};
    if (random.oneIn(2))
      size = {random.between(0, 5), 0};
  }
  if (random.oneIn(2))
    geometry.texCoordMappings = {"", "TEXCOORD_1", "a light map"};
  geometry.colorComponents = 3 + random.below(2);
  if (geometry.encoding == Encoding::bg) {
    do
      geometry.coordType = static_cast<ElementType>(random.below(7));
    while (!holdsLattice(geometry.coordType, geometry.lattice.bits));
    for (const VertexRole further : {VertexRole::texCoord1, VertexRole::texCoord2, VertexRole::texCoord3})
      geometry.attributeTypes[further] = ElementType::float32; // documents state the types of sets that exist
    do
      geometry.indexType = static_cast<ElementType>(random.below(7));
    while (!isUnsigned(geometry.indexType));
  }
  geometry.normalEncoding = static_cast<NormalEncoding>(random.below(4));
  if (geometry.encoding == Encoding::bg)
    do
      geometry.attributeTypes[VertexRole::normal] = static_cast<ElementType>(random.below(7));
    while (isUnsigned(geometry.attributeTypes[VertexRole::normal]) != isPair(geometry.normalEncoding) ||
           geometry.attributeTypes[VertexRole::normal] == ElementType::uint32);
  for (std::uint32_t count = random.oneIn(2) ? random.below(3) : 0; count > 0; --count) {
    AttributeDescription attribute{"a" + std::to_string(count) + "<&\"", 1 + random.below(4), 2, {}, {}};
    if (geometry.encoding == Encoding::classic)
      attribute.bytes = 1 + random.below(3);
    for (std::uint32_t c = 0; c < attribute.components; ++c) {
      attribute.min.push_back(random.between(-5, 5));
      attribute.size.push_back(random.between(0, 5));
    }
    geometry.attributes.push_back(attribute);
  }
  if (geometry.encoding == Encoding::classic && random.oneIn(2))
    geometry.indexType = ElementType::uint32;
  for (std::uint32_t patches = 1 + random.below(4); patches > 0; --patches)
    geometry.patches.push_back(
        randomPatch(random, geometry.encoding,
                    geometry.encoding == Encoding::classic ? coordBytes(Encoding::classic, geometry.lattice.bits) : 1));
  if (geometry.encoding == Encoding::classic && random.oneIn(2))
    setRandomImageBits(random, geometry);
  for (PatchDescription& patch : geometry.patches)
    for (const AttributeDescription& attribute : geometry.attributes) {
      patch.attributes.emplace_back();
      for (std::size_t file = fileCountOf(geometry.encoding, attribute); file > 0; --file)
        patch.attributes.back().push_back(randomReference(random, geometry.encoding));
    }
  if (geometry.encoding == Encoding::bg && byteSizeOf(geometry.coordType) == 2 && random.oneIn(3)) {
    geometry.normalEncoding = NormalEncoding::spherical;
    geometry.attributeTypes[VertexRole::normal] = ElementType::uint8;
    for (PatchDescription& patch : geometry.patches)
      patch.vertexAttributes[VertexRole::normal] = normalInCoords(patch.coord[0]);
  }
  return geometry;
}

Rotation randomRotation(Random& random) {
  return {randomVector(random), random.between(-3, 3)};
}

/// Extensions in the order of their kinds.
std::vector<MaterialExtension> randomExtensions(Random& random) {
  const auto unit = [&] { return random.between(0, 1); };
  std::vector<MaterialExtension> all{AnisotropyMaterialExtension{unit(), unit()},
                                     ClearcoatMaterialExtension{unit(), unit()},
                                     DispersionMaterialExtension{unit()},
                                     EmissiveStrengthMaterialExtension{unit() * 20},
                                     IORMaterialExtension{1 + unit()},
                                     IridescenceMaterialExtension{unit(), 1 + unit(), 100 * unit(), 500 * unit()},
                                     SheenMaterialExtension{randomColor(random), unit()},
                                     SpecularMaterialExtension{unit(), randomColor(random)},
                                     TransmissionMaterialExtension{unit()},
                                     VolumeMaterialExtension{unit(), 10 * unit(), randomColor(random)}};
  std::erase_if(all, [&](const MaterialExtension&) { return !random.oneIn(3); });
  return all;
}

/// Whether the material or one of its extensions has a texture of this role.
bool hasField(const AnyMaterial& material, TextureRole role) {
  const PhysicalMaterial* physical = std::get_if<PhysicalMaterial>(&material);
  return !textureField(material, role).empty() ||
         (physical && std::ranges::any_of(physical->extensions, [&](const MaterialExtension& extension) {
            return !textureField(extension, role).empty();
          }));
}

Appearance randomAppearance(Random& random, std::size_t textures) {
  Appearance appearance;
  if (random.oneIn(2))
    appearance.name = "appearance_" + std::to_string(random.bits());
  switch (random.below(3)) {
  case 0:
    appearance.material = Material{
        .diffuseColor = randomColor(random), .specularColor = randomColor(random), .shininess = random.between(0, 1)};
    break;
  case 1:
    appearance.material = PhysicalMaterial{.baseColor = randomColor(random),
                                           .metallic = random.between(0, 1),
                                           .transparency = random.between(0, 1),
                                           .extensions = randomExtensions(random)};
    break;
  default:
    appearance.material = UnlitMaterial{.emissiveColor = randomColor(random)};
  }
  const bool haveSameTransform = random.oneIn(2);
  TextureTransform transform;
  for (std::size_t i = 0; i < textureRoleCount && textures > 0; ++i) {
    const auto role = static_cast<TextureRole>(i);
    if (!hasField(appearance.material, role) || random.oneIn(2))
      continue;
    if (!haveSameTransform)
      transform = {{random.between(-2, 2), 0}, {random.between(1, 2), 1}, {0, 0}, random.between(-1, 1)};
    appearance.textures.push_back({role, random.below(textures), transform});
  }
  appearance.alphaMode = static_cast<AlphaMode>(random.below(4));
  if (appearance.alphaMode == AlphaMode::mask)
    appearance.alphaCutoff = random.between(0, 1);
  return appearance;
}

Texture randomTexture(Random& random, std::size_t images) {
  Texture texture;
  texture.image = random.below(images);
  texture.boundaryS = static_cast<Boundary>(random.below(3));
  texture.boundaryT = static_cast<Boundary>(random.below(3));
  if (random.oneIn(2))
    texture.magnification = static_cast<Filter>(1 + random.below(2));
  if (random.oneIn(2)) {
    texture.minification = static_cast<Filter>(1 + random.below(2));
    texture.mipMaps = random.oneIn(2);
    if (texture.mipMaps)
      texture.betweenMipMaps = static_cast<Filter>(1 + random.below(2));
  }
  return texture;
}

/// A random node other than Group, Transform and Shape.
NodeContent randomLeaf(Random& random) {
  switch (random.below(5)) {
  case 0:
    return Viewpoint{random.oneIn(2) ? "" : randomText(random), randomVector(random), randomRotation(random),
                     random.between(0.1f, 3), randomVector(random)};
  case 1:
    return OrthoViewpoint{randomText(random),  randomVector(random), randomRotation(random), {-2, -1}, {3, 4},
                          randomVector(random)};
  case 2:
    return DirectionalLight{randomVector(random), randomColor(random), random.between(0, 1), random.oneIn(2),
                            random.between(0, 1)};
  case 3:
    return PointLight{randomVector(random), {0, 0, 1},           7, randomColor(random), random.between(0, 9),
                      random.oneIn(2),      random.between(0, 1)};
  default:
    return SpotLight{
        randomVector(random), randomVector(random), random.between(0, 1), random.between(0, 1), {1, 2, 3},
        random.between(1, 9), randomColor(random),  random.between(0, 9), random.oneIn(2),      random.between(0, 1)};
  }
}

/// A graph in which nodes, appearances, textures and geometries are shared.
SceneDocument randomDocument(std::uint32_t seed) {
  Random random(seed);
  SceneDocument document;
  SceneGraph& graph = document.graph;
  if (!random.oneIn(4))
    graph.title = randomText(random);
  if (random.oneIn(3))
    graph.info = {randomText(random), "more"};
  if (random.oneIn(2))
    graph.background = Background{randomColor(random)};
  graph.headlight = random.oneIn(2);
  for (std::uint32_t count = random.below(3); count > 0; --count)
    graph.images.push_back({"textures/" + std::to_string(count) + ".png", {}});
  for (std::uint32_t count = graph.images.empty() ? 0 : random.below(4); count > 0; --count)
    graph.textures.push_back(randomTexture(random, graph.images.size()));
  for (std::uint32_t count = 1 + random.below(3); count > 0; --count)
    graph.appearances.push_back(randomAppearance(random, graph.textures.size()));
  for (std::uint32_t count = 1 + random.below(3); count > 0; --count)
    document.geometries.push_back(randomGeometry(random));

  std::vector<std::size_t> added; // children come before their parents, so there are no cycles
  for (std::uint32_t count = random.below(12); count > 0; --count) {
    Node node;
    if (!random.oneIn(3))
      node.name = "Größe_" + std::to_string(count) + ".a-b";
    if (random.oneIn(5))
      node.extras = "{\"note\":\"" + std::to_string(random.bits()) + "\"}";
    const std::uint32_t kind = random.below(4);
    if (kind == 0)
      node.content = randomLeaf(random);
    if (kind == 1) {
      Shape shape;
      shape.mesh = random.below(document.geometries.size());
      shape.solid = !random.oneIn(3);
      if (!random.oneIn(4))
        shape.appearance = random.below(graph.appearances.size());
      node.content = shape;
    }
    if (kind == 2)
      node.content = Transform{randomVector(random),
                               randomRotation(random),
                               randomVector(random),
                               random.oneIn(2) ? Rotation{} : randomRotation(random),
                               {}};
    if (kind >= 2)
      for (std::uint32_t children = random.below(4); children > 0 && !added.empty(); --children)
        node.children.push_back(added[random.below(added.size())]);
    added.push_back(addNode(graph, std::move(node)));
  }
  for (const std::size_t node : added)
    if (random.oneIn(2))
      graph.roots.push_back(node);
  return document;
}

/// Expects boxes that are equal up to the precision with which they are written: that of their lattice.
void expectNear(const Box3d& a, const Box3d& b, double step) {
  EXPECT_EQ(a.empty(), b.empty());
  if (a.empty() || b.empty())
    return;
  for (int axis = 0; axis < 3; ++axis) {
    const double ulps = 8e-16 * std::max(std::abs(b.min[axis]), std::abs(b.max[axis]));
    EXPECT_NEAR(a.min[axis], b.min[axis], 0.4 * step + ulps);
    EXPECT_NEAR(a.max[axis], b.max[axis], 0.4 * step + ulps);
  }
}

void expectEqual(const GeometryDescription& read, GeometryDescription written) {
  expectNear(read.box, written.box, written.lattice.step);
  EXPECT_EQ(read.lattice.bits, written.lattice.bits);
  const double extent = length(written.lattice.origin) + written.lattice.step * written.lattice.maximum();
  const double tolerance = 1e-15 * extent + 2e-7 * written.lattice.step;
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(read.lattice.origin[axis], written.lattice.origin[axis], tolerance);
  EXPECT_NEAR(read.lattice.step * read.lattice.maximum(), written.lattice.step * written.lattice.maximum(), tolerance);
  ASSERT_EQ(read.patches.size(), written.patches.size());
  for (std::size_t i = 0; i < read.patches.size(); ++i) {
    expectNear(read.patches[i].box, written.patches[i].box, written.lattice.step);
    written.patches[i].box = read.patches[i].box;
  }
  written.box = read.box;
  written.lattice = read.lattice;
  EXPECT_EQ(read, written);
}

/// Expects the same nodes in the same order with the same sharing. Names that the writer has assigned are not compared.
void expectEqual(const SceneDocument& read, const SceneDocument& written) {
  EXPECT_EQ(read.graph.title, written.graph.title);
  EXPECT_EQ(read.graph.info, written.graph.info);
  EXPECT_EQ(read.graph.background, written.graph.background);
  EXPECT_EQ(read.graph.headlight, written.graph.headlight);
  const std::vector<std::size_t> readNodes = nodesInOrder(read.graph), nodes = nodesInOrder(written.graph);
  ASSERT_EQ(readNodes.size(), nodes.size());
  std::map<std::size_t, std::size_t> readNodeOf;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    readNodeOf[nodes[i]] = readNodes[i];
  std::map<std::size_t, std::size_t> readAppearanceOf, readTextureOf;
  const auto expectSame = [](std::map<std::size_t, std::size_t>& known, std::size_t key, std::size_t value) {
    EXPECT_EQ(known.try_emplace(key, value).first->second, value);
  };
  for (const std::size_t index : nodes) {
    const Node &a = read.graph.nodes[readNodeOf[index]], &b = written.graph.nodes[index];
    EXPECT_TRUE(b.name.empty() || a.name == b.name) << a.name << b.name;
    EXPECT_EQ(a.extras, b.extras);
    std::vector<std::size_t> children;
    for (const std::size_t child : b.children)
      children.push_back(readNodeOf[child]);
    EXPECT_EQ(a.children, children);
    ASSERT_EQ(a.content.index(), b.content.index());
    const Shape* shape = std::get_if<Shape>(&b.content);
    if (!shape) {
      EXPECT_EQ(a.content, b.content);
      continue;
    }
    const Shape& readShape = std::get<Shape>(a.content);
    EXPECT_EQ(readShape.solid, shape->solid);
    expectEqual(read.geometries.at(readShape.mesh), written.geometries.at(shape->mesh));
    ASSERT_EQ(readShape.appearance.has_value(), shape->appearance.has_value());
    if (!shape->appearance)
      continue;
    expectSame(readAppearanceOf, *shape->appearance, *readShape.appearance);
    const Appearance &appearance = written.graph.appearances[*shape->appearance],
                     &readAppearance = read.graph.appearances[*readShape.appearance];
    EXPECT_EQ(readAppearance.material, appearance.material);
    EXPECT_EQ(readAppearance.alphaMode, appearance.alphaMode);
    EXPECT_EQ(readAppearance.alphaCutoff, appearance.alphaCutoff);
    ASSERT_EQ(readAppearance.textures.size(), appearance.textures.size());
    for (std::size_t i = 0; i < appearance.textures.size(); ++i) {
      TextureUse use = readAppearance.textures[i];
      expectSame(readTextureOf, appearance.textures[i].texture, use.texture);
      Texture texture = read.graph.textures[use.texture],
              expected = written.graph.textures[appearance.textures[i].texture];
      EXPECT_EQ(read.graph.images[texture.image], written.graph.images[expected.image]);
      texture.image = expected.image;
      texture.name = expected.name;
      EXPECT_EQ(texture, expected);
      use.texture = appearance.textures[i].texture;
      EXPECT_EQ(use, appearance.textures[i]);
    }
  }
}

const PageOptions page{"imgeo-viewer.js", "imgeo.css"};

TEST(Documents, AreReadBackFromX3dAndFromHtml) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const SceneDocument document = randomDocument(seed);
    expectEqual(readScene(writeX3d(document), "scene.x3d"), document);
    expectEqual(readScene(writeHtml(document, page), "index.html"), document);
  }
}

TEST(Documents, AreReadWithoutRegardToCase) {
  const SceneDocument document = randomDocument(3);
  std::string text = writeX3d(document);
  const auto lowerNames = [](std::string& x3d) {
    bool inTag = false;
    char quote = 0;
    for (char& c : x3d) {
      if (quote != 0)
        quote = c == quote ? char{0} : quote;
      else if (inTag && (c == '"' || c == '\''))
        quote = c;
      else if (c == '<')
        inTag = true;
      else if (c == '>')
        inTag = false;
      else if (inTag && c >= 'A' && c <= 'Z')
        c = static_cast<char>(c + 32);
    }
  };
  lowerNames(text);
  EXPECT_NE(text.find("<x3d"), std::string::npos);
  expectEqual(readScene(text, "x"), document);
}

TEST(Documents, HaveTheSameX3dElementInHtmlAndX3d) {
  const SceneDocument document = randomDocument(5);
  const auto withoutIndents = [](std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] != ' ' || (i > 0 && text[i - 1] != '\n' && text[i - 1] != ' '))
        out += text[i];
    return out.substr(out.find("<X3D"), out.rfind("</X3D>") - out.find("<X3D"));
  };
  EXPECT_EQ(withoutIndents(writeX3d(document)), withoutIndents(writeHtml(document, page)));
}

SceneDocument documentNamed(const std::string& name) {
  SceneDocument document;
  document.graph.title = name;
  GeometryDescription geometry;
  geometry.patches = {
      {{}, 3, {{Primitive::triangles, 3}}, {256, 1}, {}, {}, {{"a.png", {}}, {"b.png", {}}}, {}, {}, {}, {}}};
  document.geometries = {geometry, geometry};
  addRoot(document.graph, {"", Viewpoint{name, {}, {}, 0.8, {}}, {}, ""});
  addRoot(document.graph, {name, Shape{0, {}, true}, {}, ""});
  addRoot(document.graph, {name, Shape{1, {}, true}, {}, ""});
  return document;
}

TEST(Documents, WriteAnOnlyChildOnTheLineOfItsParent) {
  ElementWriter writer(1);
  const Element transform{"Transform", {{{"translation", "1 2 3"}}}}, shape{"Shape", {{{"USE", "seat"}}}};
  writer.open(transform);
  writer.open({"Group", {}});
  writer.leaf(shape);
  writer.close({"Group", {}});
  writer.close(transform);
  EXPECT_EQ(writer.text(),
            "  <Transform translation=\"1 2 3\"><Group><Shape USE=\"seat\"></Shape></Group></Transform>\n");

  ElementWriter multiLine(0);
  multiLine.open(transform);
  multiLine.leaf(shape);
  multiLine.open({"Group", {}});
  multiLine.leaf({"Shape", {{{"USE", std::string(90, 'x')}}}});
  multiLine.close({"Group", {}});
  multiLine.close(transform);
  EXPECT_EQ(multiLine.text(), "<Transform translation=\"1 2 3\">\n"
                              "  <Shape USE=\"seat\"></Shape>\n"
                              "  <Group>\n"
                              "    <Shape USE=\"" +
                                  std::string(90, 'x') +
                                  "\"></Shape>\n"
                                  "  </Group>\n"
                                  "</Transform>\n");
}

TEST(Documents, WriteAShapeOnALineOfADenseLayout) {
  const auto written = [](TextLayout layout) {
    ElementWriter writer(2, layout);
    writer.open({"Group", {{{"DEF", "all"}}}});
    writer.open({"Shape", {}});
    writer.leaf({"Box", {{{"size", std::string(200, '1')}}, {{"solid", "false"}}}});
    writer.leaf({"Sphere", {}});
    writer.close({"Shape", {}});
    writer.close({"Group", {}});
    return writer.text();
  };
  const std::string box = "<Box size=\"" + std::string(200, '1') + "\" solid=\"false\"";
  EXPECT_EQ(written(TextLayout::dense),
            "<Group DEF=\"all\">\n<Shape>" + box + "></Box><Sphere></Sphere></Shape>\n</Group>\n");
  EXPECT_EQ(written(TextLayout::denseXml), "<Group DEF=\"all\">\n<Shape>" + box + "/><Sphere/></Shape>\n</Group>\n");
}

TEST(Documents, DescribeSmallShapesOfLargeScenesByTheirBoxes) {
  Random random(11);
  SceneDocument document;
  document.graph.isComplete = true;
  for (std::uint32_t i = 0; i <= 10'000; ++i) {
    Box3d box;
    const Vec3d corner(random.point() * 1000);
    box.add(corner);
    box.add(Vec3d(Vec3f(corner + Vec3d{1.5, random.oneIn(3) ? 0 : 0.123456, 1e-3} * (1.0 + random.below(9)))));
    GeometryDescription geometry;
    geometry.encoding = Encoding::compact;
    geometry.lattice = latticeFor(box, geometry.coordType, packedPositionBits);
    const std::vector<Vec3f> corners{Vec3f(box.min), Vec3f(box.max)};
    geometry.box.add(geometry.lattice.origin);
    geometry.box.add(geometry.lattice.point(quantise(corners, geometry.lattice)[1]));
    PatchDescription patch;
    patch.box = geometry.box;
    patch.vertexCount = 4;
    patch.draws = {{Primitive::triangles, 6}};
    patch.data = Reference{"a.png", PatchLocation{i}};
    geometry.patches = {patch};
    document.geometries.push_back(geometry);
    addRoot(document.graph, {"", Shape{i, {}, true}, {}, ""});
  }
  for (const std::string& text : {writeX3d(document), writeHtml(document, {})}) {
    EXPECT_EQ(text.find("profile=\"compact\""), text.npos);
    const SceneDocument read = readScene(text, "a");
    ASSERT_EQ(read.geometries.size(), document.geometries.size());
    std::size_t withoutPosition = 0;
    for (std::size_t i = 0; i < read.geometries.size(); ++i) {
      const Lattice &a = read.geometries[i].lattice, &b = document.geometries[i].lattice;
      EXPECT_EQ(read.geometries[i].encoding, Encoding::compact);
      EXPECT_LT(length(a.point({0, 0, 0}) - b.point({0, 0, 0})), 1e-5 * b.step);
      EXPECT_LT(length(a.point({65535, 65535, 65535}) - b.point({65535, 65535, 65535})), 1e-5 * b.step);
      EXPECT_LT(length(read.geometries[i].box.max - document.geometries[i].box.max), b.step);
      EXPECT_EQ(read.geometries[i].box, read.geometries[i].patches[0].box);
      EXPECT_EQ(read.geometries[i].patches[0].data, document.geometries[i].patches[0].data);
    }
    for (std::size_t at = text.find("<Shape><ImageGeometry bboxCenter"); at != text.npos;
         at = text.find("<Shape><ImageGeometry bboxCenter", at + 1))
      ++withoutPosition;
    EXPECT_GT(withoutPosition, 9'000u);
  }
}

TEST(Documents, EscapeActiveContentInNames) {
  for (const std::string name : {"\"><script>alert(1)</script>", "' onload='alert(1)", "</title><script>",
                                 "--><script>", "</noscript><script>", "a\0b<script>"}) {
    const std::string html = writeHtml(documentNamed(name), page);
    EXPECT_EQ(html.find("<script"), html.rfind("<script")) << html;
    EXPECT_EQ(readScene(html, "x").graph.title, name);
    EXPECT_EQ(std::get<Viewpoint>(readScene(html, "x").graph.nodes.at(0).content).description, name);
  }
}

TEST(Documents, GiveShapesValidUniqueNames) {
  EXPECT_EQ(shapeName(readScene(writeX3d(documentNamed("\"><script>")), "x").graph, 0), "___script_");
  EXPECT_EQ(shapeName(readScene(writeX3d(documentNamed("2 hares")), "x").graph, 0), "_2_hares");
  EXPECT_EQ(shapeName(readScene(writeX3d(documentNamed("2 hares")), "x").graph, 1), "_2_hares_2");
  EXPECT_EQ(shapeName(readScene(writeX3d(documentNamed("\xff\xfe")), "x").graph, 0), "__");
  EXPECT_EQ(shapeName(readScene(writeX3d(documentNamed("")), "x").graph, 1), "");
}

TEST(Documents, AreValidUtf8WhateverTheirNamesAre) {
  const SceneDocument read = readScene(writeHtml(documentNamed("a\xc3(\xed\xa0\x80\x01z\xf0\x9f"), page), "x");
  const std::string r = "\xef\xbf\xbd";
  EXPECT_EQ(read.graph.title, "a" + r + "(" + r + r + r + r + "z" + r + r);
}

TEST(Html, PreloadsFirstPlanesAndCompactPatchesThenIndices) {
  SceneDocument document = documentNamed("a");
  document.geometries[0].patches[0].index = {"i.png", {}};
  document.geometries[1].patches[0].coord[0].url = "c.png";
  document.geometries[1].patches.emplace_back().data = Reference{"d.png", PatchLocation{}};
  const std::string html = writeHtml(document, page);
  std::string hints;
  const std::string hint =
      "<link rel=\"preload\" as=\"fetch\" crossorigin=\"anonymous\" fetchpriority=\"high\" href=\"";
  for (std::size_t at = html.find(hint); at != std::string::npos; at = html.find(hint, at + 1))
    hints += html.substr(at + hint.size(), 5) + " ";
  EXPECT_EQ(hints, "a.png c.png d.png i.png ");
}

TEST(Html, PreloadsABaseMeshAndItsDecoderInsteadOfPatches) {
  SceneDocument document = documentNamed("a");
  document.geometries[0].encoding = Encoding::compact;
  document.geometries[0].base = Reference{"base.png", PatchLocation{7}};
  document.geometries[0].patches[0].data = Reference{"patch.png", PatchLocation{}};
  const PageOptions options{"r.js", "s.css", {"first.js"}, {"later.js"}, "files.js"};
  const std::string html = writeHtml(document, options);
  std::size_t at = 0; // modules come first, since they have work to do before they need the base mesh
  for (const char* link : {"modulepreload\" href=\"first.js\">", "modulepreload\" href=\"r.js\">",
                           "stylesheet\" href=\"s.css\">", "fetchpriority=\"high\" href=\"base.png\">"}) {
    EXPECT_LT(at, html.find(link)) << link;
    at = html.find(link);
    EXPECT_NE(at, html.npos) << link;
  }
  EXPECT_EQ(html.find("later.js"), html.npos);
  EXPECT_EQ(html.find("href=\"patch.png\""), html.npos);
  EXPECT_NE(html.find("base=\"base.png#7\""), html.npos);
  document.geometries[0].base.reset();
  const std::string later = "<link rel=\"modulepreload\" href=\"later.js\">";
  EXPECT_NE(writeHtml(document, options).find(later), html.npos);
}

TEST(Html, PreloadsTheModuleForFilesOfClassicAndBgBeforeTheirFiles) {
  SceneDocument document = documentNamed("a");
  const PageOptions options{"r.js", "s.css", {"first.js"}, {"later.js"}, "files.js"};
  for (const Encoding encoding : {Encoding::classic, Encoding::bg}) {
    document.geometries[0].encoding = encoding;
    const std::string html = writeHtml(document, options);
    const std::size_t at = html.find("<link rel=\"modulepreload\" href=\"files.js\">");
    EXPECT_LT(html.find("href=\"later.js\""), at);
    EXPECT_LT(at, html.find("as=\"fetch\""));
  }
  for (GeometryDescription& geometry : document.geometries)
    geometry.encoding = Encoding::compact;
  EXPECT_EQ(writeHtml(document, options).find("files.js"), std::string::npos);
}

TEST(Html, PreloadsTheModuleThatChoosesGroupsOfLevelsBeforeTheirIndex) {
  SceneDocument document = documentNamed("a");
  PageOptions options{"r.js", "s.css"};
  options.cutModuleUrl = "cut.js";
  EXPECT_EQ(writeHtml(document, options).find("cut.js"), std::string::npos);
  document.geometries[0].levels.emplace().url = "l/levels.png";
  const std::string html = writeHtml(document, options);
  const std::size_t at = html.find("<link rel=\"modulepreload\" href=\"cut.js\">");
  EXPECT_LT(html.find("href=\"r.js\""), at);
  EXPECT_LT(at, html.find("href=\"l/levels.png\""));
}

TEST(Html, PreloadsUpToSixteenFiles) {
  SceneDocument document = documentNamed("a");
  for (int i = 0; i < 100; ++i) {
    document.geometries[0].patches.push_back(document.geometries[0].patches[0]);
    document.geometries[0].patches.back().coord[0].url = std::to_string(i);
  }
  const std::string html = writeHtml(document, page);
  std::size_t hints = 0;
  for (std::size_t at = html.find("as=\"fetch\""); at != std::string::npos; at = html.find("as=\"fetch\"", at + 1))
    ++hints;
  EXPECT_EQ(hints, 16u);
}

TEST(Html, HasNoInlineScriptOrStyle) {
  const std::string html = writeHtml(randomDocument(8), page);
  EXPECT_EQ(html.find("<style"), std::string::npos);
  EXPECT_EQ(html.find("style="), std::string::npos);
  EXPECT_NE(html.find("<script type=\"module\" src=\"imgeo-viewer.js\"></script>"), std::string::npos);
  EXPECT_NE(html.find("<link rel=\"stylesheet\" href=\"imgeo.css\">"), std::string::npos);
  EXPECT_NE(pageStylesheet().find("x3d {"), std::string::npos);
}

TEST(Documents, KeepTheLatticeOfForeignGeometry) {
  for (const std::string type : {"Int8", "Int16", "Uint8", "Uint16", "Uint32", "Float32"})
    for (const std::string size : {"4 2 0", "1 1 1", "1e-3 5 100"}) {
      const SceneDocument document =
          readScene("<X3D><Scene><Shape><BinaryGeometry coordType='" + type + "' position='1 2 3' size='" + size +
                        "' coord='a'/></Shape></Scene></X3D>",
                    "x");
      const Lattice before = document.geometries.at(0).lattice;
      const Lattice after = readScene(writeX3d(document), "x").geometries.at(0).lattice;
      const std::uint32_t maximum = before.maximum();
      const Vec3u corners[] = {{0, 0, 0}, {maximum, maximum, maximum}, {maximum / 2, maximum / 3, 1}};
      for (const Vec3u& q : corners)
        EXPECT_LE(length(after.point(q) - before.point(q)), 1e-12) << type << ", " << size;
    }
}

TEST(Documents, WriteSharedNodesOnce) {
  SceneDocument document = documentNamed("");
  SceneGraph& graph = document.graph;
  graph.appearances.push_back({"", Material{}, {}, AlphaMode::automatic, 0.5f});
  const std::vector<std::size_t> shapes = shapeNodes(graph);
  for (const std::size_t node : shapes)
    std::get<Shape>(graph.nodes[node].content) = {0, 0, true};
  for (double x = 0; x < 3; ++x)
    addRoot(graph, {"", Transform{{x, 0, 0}, {}, {1, 1, 1}, {}, {}}, {shapes[0]}, ""});
  const std::string text = writeX3d(document);
  const auto countOf = [&](const std::string& what) {
    std::size_t count = 0;
    for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1))
      ++count;
    return count;
  };
  EXPECT_EQ(countOf("<Shape DEF=\"shared\""), 1u);
  EXPECT_EQ(countOf("<Shape USE=\"shared\""), 3u);
  EXPECT_EQ(countOf("<Appearance DEF=\"appearance\""), 1u);
  EXPECT_EQ(countOf("<Appearance USE=\"appearance\""), 1u);
  EXPECT_EQ(countOf("<ImageGeometry DEF=\"geometry\""), 1u);
  EXPECT_EQ(countOf("<ImageGeometry USE=\"geometry\""), 1u);
  EXPECT_EQ(countOf("<GeometryPatch "), 1u);
  EXPECT_EQ(shapeInstances(readScene(text, "x").graph).size(), 5u);
}

TEST(ReadScene, RefusesEveryTruncatedText) {
  const std::string x3d = writeX3d(randomDocument(11));
  for (std::size_t length = 0; length < x3d.size() - 1; ++length) // the last byte is a newline
    EXPECT_THROW(readScene(std::string_view(x3d).substr(0, length), "x"), Error) << length;
}

} // namespace
} // namespace imgeo
