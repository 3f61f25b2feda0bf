#include "transcode/picture/picture_samples.h"

#include "base/error.h"
#include "images/decode_image.h"
#include "images/image_type.h"
#include "images/resize.h"
#include "scene/color.h"
#include "scene/surface_samples.h"
#include "scene/transform.h"
#include "transcode/default_scene/default_lighting.h"
#include "transcode/picture/generic_fields.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <span>

namespace imgeo {

namespace {

/// Scenes of more instances than a picture has samples get no picture.
constexpr std::size_t maxInstances = 200'000;
constexpr std::uint32_t textureEdge = 512;

bool isHidden(const Node& node) {
  return std::ranges::any_of(std::array{"visible", "render"}, [&](const char* name) {
    const std::string* value = fieldOf(node, name);
    return value && *value == "false";
  });
}

/// Lists the visible instances of shapes.
class VisibleShapes {
public:
  explicit VisibleShapes(const SceneGraph& graph) : graph_(graph) {
    for (const std::size_t root : graph.roots)
      visit(root, {});
  }

  std::vector<ShapeInstance> instances;
  bool isWhole = true;

private:
  void visit(std::size_t index, const Affine3d& worldFromParent) {
    const Node& node = graph_.nodes[index];
    if (isHidden(node))
      return;
    if (std::holds_alternative<Shape>(node.content)) {
      if (instances.size() == maxInstances)
        isWhole = false;
      else
        instances.push_back({index, worldFromParent});
      return;
    }
    const GenericNode* generic = std::get_if<GenericNode>(&node.content);
    if (generic && generic->element == "Shape") {
      isWhole = false;
      return;
    }
    const Transform* transform = std::get_if<Transform>(&node.content);
    const Affine3d worldFromNode = transform ? worldFromParent * affineOf(*transform) : worldFromParent;
    const std::optional<std::size_t> choice = generic ? visibleChildOf(node, *generic) : std::nullopt;
    std::size_t count = 0;
    for (const std::size_t child : node.children) {
      if (instances.size() > maxInstances || !isWhole)
        return;
      if (isChildNode(graph_.nodes[child]) && (!choice || *choice == count++))
        visit(child, worldFromNode);
    }
  }

  /// The only visible child of an LOD or Switch; beyond the children: none.
  static std::optional<std::size_t> visibleChildOf(const Node& node, const GenericNode& generic) {
    if (generic.element == "LOD")
      return 0;
    if (generic.element != "Switch")
      return std::nullopt;
    int choice = -1;
    if (const std::string* text = fieldOf(node, "whichChoice"))
      std::from_chars(text->data(), text->data() + text->size(), choice);
    return choice < 0 ? node.children.size() : static_cast<std::size_t>(choice);
  }

  const SceneGraph& graph_;
};

/// The colour of a material in sRGB, 0..1.
Vec3f colorOf(const AnyMaterial& material) {
  const auto srgbOf = [](float linear) { return static_cast<float>(srgbOfLinear(linear)); };
  if (const PhysicalMaterial* physical = std::get_if<PhysicalMaterial>(&material))
    return {srgbOf(physical->baseColor.x), srgbOf(physical->baseColor.y), srgbOf(physical->baseColor.z)};
  if (const UnlitMaterial* unlit = std::get_if<UnlitMaterial>(&material))
    return unlit->emissiveColor;
  const Material& phong = std::get<Material>(material);
  return {std::max(phong.diffuseColor.x, phong.emissiveColor.x), std::max(phong.diffuseColor.y, phong.emissiveColor.y),
          std::max(phong.diffuseColor.z, phong.emissiveColor.z)};
}

/// Small versions of the scene's images.
class TextureColors {
public:
  explicit TextureColors(const SceneGraph& graph) : graph_(graph) {}

  /// The raster of a texture's image; null if there is none.
  const Raster* rasterOf(const Texture& texture) {
    const auto [known, isNew] = rasters_.try_emplace(texture.image);
    if (isNew)
      known->second = decode(graph_.images[texture.image]);
    return known->second ? &*known->second : nullptr;
  }

private:
  std::optional<Raster> decode(const ImageFile& image) {
    if (image.bytes.empty() || pixelsLeft_ == 0)
      return std::nullopt;
    try {
      const Raster raster = decodeRaster(image.bytes, image.url, pixelsLeft_);
      pixelsLeft_ -= std::min(pixelsLeft_, std::uint64_t{raster.width} * raster.height);
      return downscaled(raster, sizeWithin({raster.width, raster.height}, textureEdge), PixelContent::color);
    } catch (const Error&) {
      return std::nullopt; // the image is reported where textures are written
    }
  }

  const SceneGraph& graph_;
  std::map<std::size_t, std::optional<Raster>> rasters_;
  std::uint64_t pixelsLeft_ = maxRasterPixels;
};

/// The colours of one shape.
class Surface {
public:
  Surface(MeshHandle mesh, const Appearance* appearance, TextureColors& textures, const SceneGraph& graph)
      : mesh_(std::move(mesh)) {
    if (!appearance)
      return;
    color_ = colorOf(appearance->material);
    isLit = !std::holds_alternative<UnlitMaterial>(appearance->material);
    for (const TextureUse& use : appearance->textures)
      if (use.role == TextureRole::color) {
        texCoords_ = texCoordsOf(*mesh_, texCoordSetNamed(use.mapping, *mesh_));
        transform_ = use.transform;
        raster_ = texCoords_.empty() ? nullptr : textures.rasterOf(graph.textures[use.texture]);
      }
  }

  bool isLit = true;

  /// The colour at a point of an element: `weights` of its corners, which begin at `first`.
  std::array<std::uint8_t, 3> colorAt(std::size_t first, std::span<const float> weights) const {
    Vec3f color = color_;
    if (!mesh_->colors.empty())
      color = product(color, vertexColor(first, weights));
    if (raster_)
      color = product(color, texel(first, weights));
    const auto byteOf = [](float value) {
      return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255 + 0.5f);
    };
    return {byteOf(color.x), byteOf(color.y), byteOf(color.z)};
  }

private:
  static Vec3f product(Vec3f a, Vec3f b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

  Vec3f vertexColor(std::size_t first, std::span<const float> weights) const {
    Vec3f color{0, 0, 0};
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const Rgba& corner = mesh_->colors[mesh_->corners[first + i]];
      color = color + Vec3f{corner.r, corner.g, corner.b} * weights[i];
    }
    return color;
  }

  Vec3f texel(std::size_t first, std::span<const float> weights) const {
    float s = transform_.translation.x + transform_.center.x, t = transform_.translation.y + transform_.center.y;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      s += weights[i] * texCoords_[mesh_->corners[first + i]].x;
      t += weights[i] * texCoords_[mesh_->corners[first + i]].y;
    }
    const float sine = std::sin(transform_.rotation), cosine = std::cos(transform_.rotation);
    const float u = transform_.scale.x * (cosine * s - sine * t) - transform_.center.x;
    const float v = transform_.scale.y * (sine * s + cosine * t) - transform_.center.y;
    if (!std::isfinite(u) || !std::isfinite(v))
      return {1, 1, 1};
    // Every boundary mode counts as repetition. Rows of the raster go down, t goes up.
    const auto at = [](float coordinate, std::uint32_t count) {
      return std::min(static_cast<std::uint32_t>((coordinate - std::floor(coordinate)) * float(count)), count - 1);
    };
    const std::size_t pixel = 4 * (std::size_t{at(1 - v, raster_->height)} * raster_->width + at(u, raster_->width));
    return Vec3f{float(raster_->pixels[pixel]), float(raster_->pixels[pixel + 1]), float(raster_->pixels[pixel + 2])} *
           (1.0f / 255);
  }

  MeshHandle mesh_;
  Vec3f color_ = stone.diffuseColor;
  const Raster* raster_ = nullptr;
  std::span<const Vec2f> texCoords_; ///< those of the texture
  TextureTransform transform_;
};

Vec3f singleOf(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// The colours of the surfaces of all shapes.
class Surfaces {
public:
  Surfaces(const Scene& scene, const StoredMeshes* stored)
      : scene_(scene), meshes_(scene.meshes, stored), textures_(scene.graph) {}

  /// Valid until the next call. Samples of a shape follow one another.
  const Surface& operator[](std::size_t shapeNode) {
    if (last_ && lastNode_ == shapeNode)
      return *last_;
    const Shape& shape = shapeOf(scene_.graph, shapeNode);
    const Appearance* appearance = shape.appearance ? &scene_.graph.appearances[*shape.appearance] : nullptr;
    lastNode_ = shapeNode;
    return last_.emplace(meshes_[shape.mesh], appearance, textures_, scene_.graph);
  }

private:
  const Scene& scene_;
  SceneMeshes meshes_;
  TextureColors textures_;
  std::size_t lastNode_ = 0;
  std::optional<Surface> last_; ///< of that Shape node
};

/// The length of the side of the square that a sample stands for.
double squareSideOf(Topology topology, const TopologySamples& samples, double diagonal) {
  switch (topology) {
  case Topology::triangles:
    return std::sqrt(samples.size / static_cast<double>(samples.samples.size()));
  case Topology::lines:
    return diagonal / 1000;
  case Topology::points: // they stand for a surface as large as a side of the scene's box
    return diagonal / std::sqrt(std::max(2 * samples.size, 1e4));
  }
  return 0;
}

/// Samples that a picture of the whole scene takes of an area as large as the square over the diagonal of its box: few
/// squares are then visible as such (draw_picture.cpp).
constexpr double samplesOfSquaredDiagonal = 150'000;

/// How many samples of the triangles a picture of the whole scene takes: as many as there are, or more where the
/// surface is large for its box, as that of a cube or of what has an inside. Where that would be more than
/// `maxSamples`, no more are taken: with `maxSamples` a picture was drawn of one of ten such files.
std::size_t triangleSampleCount(const TopologySamples& samples, double diagonal, std::size_t maxSamples) {
  const double count = samplesOfSquaredDiagonal * samples.size / (diagonal * diagonal);
  const bool areMore = count > static_cast<double>(minPictureSamples) && count <= static_cast<double>(maxSamples);
  return areMore ? static_cast<std::size_t>(count) : samples.samples.size();
}

} // namespace

PictureSamples pictureSamplesOf(const Scene& scene, std::size_t maxSamples, const StoredMeshes* stored) {
  const VisibleShapes visible(scene.graph);
  if (!visible.isWhole)
    return {{}, false};
  const auto sampled = [&](Topology topology, std::size_t count) {
    return surfaceSamples(scene, visible.instances, topology, count, stored);
  };
  std::map<Topology, TopologySamples> samplesByTopology;
  Box3d box;
  for (const Topology topology : allTopologies) {
    TopologySamples& samples = samplesByTopology[topology];
    samples = sampled(topology, std::min(maxSamples, minPictureSamples));
    for (const SurfaceSample& sample : samples.samples)
      box.add(sample.point);
  }
  TopologySamples& triangles = samplesByTopology[Topology::triangles];
  if (const std::size_t count = triangleSampleCount(triangles, length(box.size()), maxSamples);
      count != triangles.samples.size())
    triangles = sampled(Topology::triangles, count);
  PictureSamples picture;
  Surfaces surfaces(scene, stored);
  for (const auto& [topology, samples] : samplesByTopology) {
    const auto side = static_cast<float>(squareSideOf(topology, samples, length(box.size())));
    const std::size_t cornerCount = cornersPerElement(topology);
    for (const SurfaceSample& sample : samples.samples) {
      const Surface& surface = surfaces[sample.shape];
      picture.samples.push_back({singleOf(sample.point), surface.isLit ? sample.normal : Vec3f{0, 0, 0}, side,
                                 surface.colorAt(sample.firstCorner, std::span(sample.weights).first(cornerCount))});
    }
  }
  return picture;
}

} // namespace imgeo
