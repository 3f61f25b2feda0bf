#include "documents/x3dom_element.h"

#include "containers/normals.h"
#include "containers/stored_coords.h"
#include "documents/text.h"
#include "documents/x3d_element.h"

#include <algorithm>
#include <cassert>
#include <set>

namespace imgeo {

namespace {

/// Names for elements of ours that no shape of the document has.
class Names {
public:
  explicit Names(const std::vector<std::string>& taken) : taken_(taken.begin(), taken.end()) {}

  std::string unused(const std::string& wish) {
    std::string name = wish;
    for (int n = 2; !taken_.insert(name).second; ++n)
      name = wish + std::to_string(n);
    return name;
  }

private:
  std::set<std::string> taken_;
};

/// The one implicit mesh that X3DOM keeps for a page: as wide as every image
/// that is counted through, and enough rows for the patch that needs most.
Vec2<std::uint32_t> implicitMeshSizeOf(const SceneDocument& document) {
  Vec2<std::uint32_t> size{0, 0};
  for (const GeometryDescription& geometry : document.geometries)
    for (const PatchDescription& patch : geometry.patches) {
      assert(geometry.container == Container::bg || size.x == 0 || size.x == patch.implicitMeshSize.x);
      size = {patch.implicitMeshSize.x, std::max(size.y, patch.implicitMeshSize.y)};
    }
  return size;
}

Attributes defOf(const std::string& name) {
  return name.empty() ? Attributes{} : Attributes{{"DEF", name}};
}

class ShapeWriter {
public:
  ShapeWriter(const SceneDocument& document, const std::vector<std::string>& defs)
      : names_(defs), sampling_(names_.unused("exactTexels")),
        implicitMeshSize_(implicitMeshSizeOf(document)) {}

  void write(ElementWriter& writer, const Shape& shape, const std::string& def,
             const GeometryDescription& geometry) {
    if (geometry.patches.size() == 1) {
      writePatch(writer, defOf(def), appearanceOf(shape, geometry, ""), geometry, geometry.patches[0]);
      return;
    }
    const std::string shared = names_.unused(def.empty() ? "look" : def + "-look");
    const Element group{"Group", {defOf(def), boxAttributes(geometry.box)}};
    writer.open(group);
    for (const PatchDescription& patch : geometry.patches) {
      const bool isFirst = &patch == &geometry.patches.front();
      writePatch(writer, {}, isFirst ? appearanceOf(shape, geometry, shared) : Look{{{"USE", shared}}, {}},
                 geometry, patch);
    }
    writer.close(group);
  }

private:
  struct Look {
    Attributes attributes;
    std::optional<Material> material;
  };

  /// X3DOM lights triangles alone; other elements shine in their emissive colour.
  static Look appearanceOf(const Shape& shape, const GeometryDescription& geometry, const std::string& def) {
    Look look{defOf(def), shape.material};
    const PatchDescription& patch = geometry.patches.front();
    if (!isLit(patch) && !patch.color)
      look.material->emissiveColor = shape.material.diffuseColor;
    return look;
  }

  /// Without normals X3DOM would light by what it finds in other textures.
  static bool isLit(const PatchDescription& patch) {
    const auto isTriangles = [](const Draw& draw) {
      return draw.primitive == Primitive::triangles || draw.primitive == Primitive::triangleStrip;
    };
    return patch.normal && std::ranges::all_of(patch.draws, isTriangles);
  }

  void writePatch(ElementWriter& writer, Attributes names, const Look& look,
                  const GeometryDescription& geometry, const PatchDescription& patch) {
    const bool isSig = geometry.container == Container::sig;
    if (isSig)
      names.push_back({"isPickable", "false"}); // the shader that picks images does not compile
    const Element element{"Shape", {names, boxAttributes(patch.box)}},
        appearance{"Appearance", {look.attributes}};
    writer.open(element);
    if (look.material) {
      writer.open(appearance);
      writer.leaf(materialElement(*look.material));
      writer.close(appearance);
    } else {
      writer.leaf(appearance);
    }
    if (isSig)
      writeImages(writer, geometry, patch);
    else
      writer.leaf(binaryGeometry(geometry, patch));
    writer.close(element);
  }

  static Attributes boxFields(const GeometryDescription& geometry) {
    const DecodeFields decode = decodeFields(geometry);
    Attributes fields{{"position", numbers(decode.position)}, {"size", numbers(decode.size)}};
    const std::uint32_t bits = geometry.lattice.bits;
    const std::uint32_t stored = geometry.container == Container::sig ? 8 * coordBytes(Container::sig, bits)
                                 : geometry.coordType == ElementType::float32
                                     ? sourceBits
                                     : 8 * byteSizeOf(geometry.coordType);
    if (bits != stored)
      fields.push_back({"positionBits", std::to_string(bits)});
    return fields;
  }

  static Attributes drawFields(const PatchDescription& patch) {
    Attributes fields{{"primType", primTypes(patch.draws)},
                      {"vertexCount", counts(patch.draws)},
                      {"recordCount", std::to_string(patch.vertexCount)}};
    if (!isLit(patch))
      fields.push_back({"lit", "false"});
    return fields;
  }

  void writeImages(ElementWriter& writer, const GeometryDescription& geometry,
                   const PatchDescription& patch) {
    assert(geometry.texCoordMin == Vec2f{} && geometry.texCoordSize == (Vec2f{1, 1}));
    assert(!isPair(geometry.normalEncoding) && geometry.indexType == ElementType::uint16);
    Attributes draws = drawFields(patch);
    draws.push_back({"implicitMeshSize",
                     std::to_string(implicitMeshSize_.x) + " " + std::to_string(implicitMeshSize_.y)});
    draws.push_back({"numColorComponents", std::to_string(geometry.colorComponents)});
    if (geometry.normalEncoding == NormalEncoding::palette)
      draws.push_back({"normalEncoding", nameOf(geometry.normalEncoding)});
    const Element node{"ImageGeometry", {boxFields(geometry), draws}};
    writer.open(node);
    const auto write = [&](const char* role, const std::optional<Reference>& image) {
      if (image)
        writeTexture(writer, role, *image);
    };
    write("index", patch.index);
    for (const Reference& plane : patch.coord)
      write("coord", plane);
    write("normal", patch.normal);
    write("texCoord", patch.texCoord);
    write("color", patch.color);
    writer.close(node);
  }

  /// Texels must arrive as they are: not resized, not filtered, not repeated.
  void writeTexture(ElementWriter& writer, const char* role, const Reference& image) {
    assert(image.first == 0);
    const Element texture{"ImageTexture",
                          {{{"containerField", role}, {"url", strings({image.url})}, {"scale", "false"}}}};
    writer.open(texture);
    if (samplingIsDefined_)
      writer.leaf({"TextureProperties", {{{"USE", sampling_}}}});
    else
      writer.leaf({"TextureProperties",
                   {{{"DEF", sampling_},
                     {"boundaryModeS", "CLAMP_TO_EDGE"},
                     {"boundaryModeT", "CLAMP_TO_EDGE"},
                     {"boundaryModeR", "CLAMP_TO_EDGE"}},
                    {{"magnificationFilter", "NEAREST"},
                     {"minificationFilter", "NEAREST"},
                     {"generateMipMaps", "false"}}}});
    samplingIsDefined_ = true;
    writer.close(texture);
  }

  /// The stride as a query: a '+' in a file's name is a blank to some hosts.
  static std::string strided(const Reference& file) {
    assert(file.first == 0);
    return file.url + (file.stride == 0 ? "" : "?+" + std::to_string(file.stride));
  }

  /// Part of a record: X3DOM then takes all attributes from the coordinates' file.
  static std::string placed(const Reference& file) {
    return file.url + "#" + std::to_string(file.first) + "+" + std::to_string(file.stride);
  }

  static Element binaryGeometry(const GeometryDescription& geometry, const PatchDescription& patch) {
    const Reference& coord = patch.coord.at(0);
    const auto isBeside = [&](const std::optional<Reference>& file) {
      return file && file->url == coord.url;
    };
    const bool isInterleaved = (isBeside(patch.normal) && !hasNormalsInCoords(geometry)) ||
                               isBeside(patch.texCoord) || isBeside(patch.color);
    Attributes types, urls;
    const auto add = [&](const char* role, const char* typeField, ElementType type,
                         const std::optional<Reference>& file) {
      if (!file)
        return;
      types.push_back({typeField, nameOf(type)});
      urls.push_back({role, isInterleaved && role != std::string("index") ? placed(*file) : strided(*file)});
    };
    add("index", "indexType", geometry.indexType, patch.index);
    add("coord", "coordType", geometry.coordType, patch.coord.at(0));
    if (hasNormalsInCoords(geometry))
      types.push_back({"normalAsSphericalCoordinates", "true"});
    else
      add("normal", "normalType", geometry.normalType, patch.normal);
    add("texCoord", "texCoordType", geometry.texCoordType, patch.texCoord);
    add("color", "colorType", geometry.colorType, patch.color);
    if (geometry.colorComponents == 4)
      types.push_back({"rgbaColors", "true"});
    return {"BinaryGeometry", {boxFields(geometry), drawFields(patch), types, urls}};
  }

  Names names_;
  std::string sampling_; ///< DEF of the TextureProperties that all images use
  bool samplingIsDefined_ = false;
  Vec2<std::uint32_t> implicitMeshSize_;
};

} // namespace

std::string x3domElement(const SceneDocument& document, std::size_t level) {
  ShapeWriter shapes(document, defNames(document.shapes));
  return x3dElement(document, level,
                    [&](ElementWriter& writer, const Shape& shape, const std::string& def,
                        const GeometryDescription& geometry) { shapes.write(writer, shape, def, geometry); });
}

} // namespace imgeo
