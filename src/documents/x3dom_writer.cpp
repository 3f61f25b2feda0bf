#include "documents/x3dom_writer.h"

#include "containers/encodings.h"
#include "containers/normals.h"
#include "containers/stored_coords.h"
#include "documents/appearance_element.h"
#include "documents/geometry_element.h"
#include "documents/scene_writer.h"

#include <algorithm>
#include <cassert>

namespace imgeo {

namespace {

/// The size of the one implicit mesh that X3DOM keeps for a page: the width of all index images, and the maximum number
/// of rows of a patch.
Vec2<std::uint32_t> implicitMeshSizeOf(const SceneDocument& document) {
  Vec2<std::uint32_t> size{0, 0};
  for (const GeometryDescription& geometry : document.geometries)
    for (const PatchDescription& patch : geometry.patches) {
      assert(rowOf(geometry).storage == PatchStorage::arrays || size.x == 0 || size.x == patch.implicitMeshSize.x);
      size = {patch.implicitMeshSize.x, std::max(size.y, patch.implicitMeshSize.y)};
    }
  return size;
}

class X3domWriter : public SceneWriter {
public:
  X3domWriter(const SceneDocument& document, std::size_t level, DocumentKind kind,
              std::optional<std::size_t> inlineNode)
      : SceneWriter(document, level, kind, inlineNode), samplingName_(names_.all.take("exactTexels")),
        emissiveNames_(document.graph.appearances.size()), implicitMeshSize_(implicitMeshSizeOf(document)) {}

private:
  void writeShape(const Node& node, const Attributes& names) override {
    const Shape& shape = std::get<Shape>(node.content);
    const GeometryDescription& geometry = document_.geometries.at(shape.mesh);
    if (geometry.patches.size() == 1)
      return writePatch(node, names, geometry, geometry.patches[0]);
    if (shape.appearance) { // the appearance needs a DEF, which all patches but the first USE
      std::string& name = appearanceNames(isEmissive(geometry.patches[0]))[*shape.appearance];
      if (name.empty())
        name = names_.all.take(names.empty() ? "appearance" : names[0].value + "-appearance");
    }
    const Element group{"Group", {names, furtherFields(node), boxAttributes(geometry.box, geometry.lattice)}};
    writer_.open(group);
    writeExtras(node);
    for (const PatchDescription& patch : geometry.patches)
      writePatch({"", shape, node.children, "", {}}, {}, geometry, patch);
    writer_.close(group);
  }

  /// X3DOM reads the style of a FontStyle from this attribute only. X3D's four values have no effect as an HTML style;
  /// other values of a source might have one.
  Attribute fontStyleAttribute(const std::string& style) const override {
    constexpr std::string_view styles[] = {"PLAIN", "BOLD", "ITALIC", "BOLDITALIC"};
    return {"style", std::ranges::find(styles, style) != std::end(styles) ? style : "PLAIN"};
  }

  /// X3DOM lights triangles only; other elements are drawn in their emissive colour.
  static bool isEmissive(const PatchDescription& patch) {
    return !isLit(patch) && !patch.vertexAttributes[VertexRole::color];
  }

  ElementNames& appearanceNames(bool emissive) { return emissive ? emissiveNames_ : names_.appearances; }

  void writeAppearanceOf(const Shape& shape, bool emissive) {
    if (!shape.appearance)
      return;
    const Attributes names = appearanceNames(emissive).defOrUse(*shape.appearance);
    if (isUse(names))
      return writer_.leaf({"Appearance", {names}});
    const Appearance& source = document_.graph.appearances.at(*shape.appearance);
    Material material = phongOf(source.material);
    if (emissive)
      material.emissiveColor = material.diffuseColor;
    Appearance appearance{"", material, {}, AlphaMode::automatic, 0.5f};
    for (const TextureUse& use : source.textures)
      if (use.role == TextureRole::color)
        appearance.textures.push_back(use);
    writeAppearance(writer_, document_.graph, appearance, names,
                    [&](std::size_t texture) { return names_.textures.defOrUse(texture); });
  }

  /// Without normals X3DOM would use the content of other textures for lighting.
  static bool isLit(const PatchDescription& patch) {
    const auto isTriangles = [](const Draw& draw) { return topologyOf(draw.primitive) == Topology::triangles; };
    return patch.vertexAttributes[VertexRole::normal] && std::ranges::all_of(patch.draws, isTriangles);
  }

  void writePatch(const Node& node, Attributes names, const GeometryDescription& geometry,
                  const PatchDescription& patch) {
    const Shape& shape = std::get<Shape>(node.content);
    const bool hasImages = rowOf(geometry).storage == PatchStorage::bytePlanes;
    if (hasImages)
      names.push_back({"isPickable", "false"}); // X3DOM's picking shader for images does not compile
    const Element element{"Shape", {names, furtherFields(node), boxAttributes(patch.box, geometry.lattice)}};
    writer_.open(element);
    writeChildren(node);
    writeAppearanceOf(shape, isEmissive(patch));
    if (hasImages)
      writeImages(geometry, patch, shape.solid);
    else
      writer_.leaf(binaryGeometry(geometry, patch, shape.solid));
    writer_.close(element);
  }

  static Attributes geometryFields(const GeometryDescription& geometry, bool solid) {
    Attributes fields = decodeAttributes(geometry);
    const std::uint32_t bits = geometry.lattice.bits;
    const std::uint32_t storedBits = !hasElementTypes(geometry.encoding) ? 8 * coordBytes(geometry.encoding, bits)
                                     : geometry.coordType == ElementType::float32 ? sourceBits
                                                                                  : 8 * byteSizeOf(geometry.coordType);
    if (bits != storedBits)
      fields.push_back({"positionBits", std::to_string(bits)});
    addUnless(fields, "solid", solid, true, "false");
    return fields;
  }

  static Attributes drawFields(const PatchDescription& patch) {
    Attributes fields{{"primType", primTypes(patch.draws)},
                      {"vertexCount", vertexCounts(patch.draws)},
                      {"recordCount", std::to_string(patch.vertexCount)}};
    if (!isLit(patch))
      fields.push_back({"lit", "false"});
    return fields;
  }

  void writeImages(const GeometryDescription& geometry, const PatchDescription& patch, bool solid) {
    assert(geometry.texCoordBoxes[0] == TexCoordBox{});
    assert(!isPair(geometry.normalEncoding) && geometry.indexType == ElementType::uint16);
    Attributes draws = drawFields(patch);
    draws.push_back(
        {"implicitMeshSize", std::to_string(implicitMeshSize_.x) + " " + std::to_string(implicitMeshSize_.y)});
    draws.push_back({"numColorComponents", std::to_string(geometry.colorComponents)});
    if (geometry.normalEncoding == NormalEncoding::palette)
      draws.push_back({"normalEncoding", nameOf(geometry.normalEncoding)});
    const Element node{"ImageGeometry", {geometryFields(geometry, solid), draws}};
    writer_.open(node);
    const auto write = [&](const char* role, const std::optional<Reference>& image) {
      if (image)
        writeImage(role, *image);
    };
    write("index", patch.index);
    for (const Reference& plane : patch.coord)
      write("coord", plane);
    for (const VertexRole role : vertexRoles)
      write(nameOf(role), patch.vertexAttributes[role]);
    writer_.close(node);
  }

  /// Writes an ImageTexture whose texels X3DOM does not resize, filter or repeat.
  void writeImage(const char* role, const Reference& image) {
    assert(image.location == FileLocation{TexelLocation{}});
    const Element texture{"ImageTexture",
                          {{{"containerField", role}, {"url", quoteStrings({image.url})}, {"scale", "false"}}}};
    writer_.open(texture);
    if (isSamplingDefined_)
      writer_.leaf({"TextureProperties", {{{"USE", samplingName_}}}});
    else
      writer_.leaf(
          {"TextureProperties",
           {{{"DEF", samplingName_},
             {"boundaryModeS", "CLAMP_TO_EDGE"},
             {"boundaryModeT", "CLAMP_TO_EDGE"},
             {"boundaryModeR", "CLAMP_TO_EDGE"}},
            {{"magnificationFilter", "NEAREST"}, {"minificationFilter", "NEAREST"}, {"generateMipMaps", "false"}}}});
    isSamplingDefined_ = true;
    writer_.close(texture);
  }

  /// Url with the stride as a query, since some hosts decode a '+' in a path as a space.
  static std::string stridedUrl(const Reference& file) {
    const ByteLocation& location = std::get<ByteLocation>(file.location);
    assert(location.byteOffset == 0);
    return file.url + (location.byteStride == 0 ? "" : "?+" + std::to_string(location.byteStride));
  }

  /// Url with offset and stride of an attribute in interleaved records: X3DOM then reads all attributes from the
  /// coordinates' file.
  static std::string interleavedUrl(const Reference& file) {
    const ByteLocation& location = std::get<ByteLocation>(file.location);
    return file.url + "#" + std::to_string(location.byteOffset) + "+" + std::to_string(location.byteStride);
  }

  static Element binaryGeometry(const GeometryDescription& geometry, const PatchDescription& patch, bool solid) {
    const Reference& coord = patch.coord.at(0);
    const bool areNormalsInCoords = hasNormalsInCoords(geometry);
    const bool isInterleaved = std::ranges::any_of(vertexRoles, [&](VertexRole role) {
      const std::optional<Reference>& file = patch.vertexAttributes[role];
      return file && file->url == coord.url && (role != VertexRole::normal || !areNormalsInCoords);
    });
    Attributes types, urls;
    const auto add = [&](const char* role, const std::string& typeField, ElementType type,
                         const std::optional<Reference>& file) {
      if (!file)
        return;
      types.push_back({typeField, nameOf(type)});
      urls.push_back({role, isInterleaved && role != std::string("index") ? interleavedUrl(*file) : stridedUrl(*file)});
    };
    add("index", "indexType", geometry.indexType, patch.index);
    add("coord", "coordType", geometry.coordType, patch.coord.at(0));
    for (const VertexRole role : vertexRoles)
      if (role == VertexRole::normal && areNormalsInCoords)
        types.push_back({"normalAsSphericalCoordinates", "true"});
      else
        add(nameOf(role), typeFieldOf(role), geometry.attributeTypes[role], patch.vertexAttributes[role]);
    if (geometry.colorComponents == 4)
      types.push_back({"rgbaColors", "true"});
    return {"BinaryGeometry", {geometryFields(geometry, solid), drawFields(patch), types, urls}};
  }

  std::string samplingName_; ///< DEF of the TextureProperties that all images use
  bool isSamplingDefined_ = false;
  ElementNames emissiveNames_; ///< names of the variants of appearances with emissive colour
  Vec2<std::uint32_t> implicitMeshSize_;
};

} // namespace

std::string x3domElement(const SceneDocument& document, std::size_t level, DocumentKind kind,
                         std::optional<std::size_t> inlineNode) {
  return X3domWriter(document, level, kind, inlineNode).write();
}

} // namespace imgeo
