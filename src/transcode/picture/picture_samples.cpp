#include "transcode/picture/picture_samples.h"

#include "base/error.h"
#include "images/decode_image.h"
#include "images/image_type.h"
#include "images/resize.h"
#include "scene/transform.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

namespace imgeo {

namespace {

/// Instances and triangles beyond these numbers are left out or thinned out: a picture has fewer pixels.
constexpr std::size_t maxInstances = 200'000, maxVisitedElements = 20'000'000;
constexpr std::uint32_t textureEdge = 512;

struct Instance {
  std::size_t node = 0;
  Affine3d worldFromShape;
};

const std::string* fieldOf(const Node& node, const char* name) {
  const auto field = std::ranges::find(node.fields, name, &FieldText::name);
  return field == node.fields.end() ? nullptr : &field->value;
}

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

  std::vector<Instance> instances;
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
    const std::optional<std::size_t> choice = generic ? choiceOf(node, *generic) : std::nullopt;
    for (std::size_t child = 0; child < node.children.size() && instances.size() <= maxInstances && isWhole; ++child)
      if (!choice || *choice == child)
        visit(node.children[child], worldFromNode);
  }

  /// The only visible child of an LOD or Switch; beyond the children: none.
  static std::optional<std::size_t> choiceOf(const Node& node, const GenericNode& generic) {
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

float srgbOf(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

/// The colour of a material in sRGB, 0..1.
Vec3f colorOf(const AnyMaterial& material) {
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
  Surface(const Mesh& mesh, const Appearance* appearance, TextureColors& textures, const SceneGraph& graph)
      : mesh_(mesh) {
    if (!appearance)
      return;
    color_ = colorOf(appearance->material);
    isLit = !std::holds_alternative<UnlitMaterial>(appearance->material);
    if (mesh.texCoords.empty())
      return;
    for (const TextureUse& use : appearance->textures)
      if (use.role == TextureRole::color) {
        transform_ = use.transform;
        raster_ = textures.rasterOf(graph.textures[use.texture]);
      }
  }

  bool isLit = true;

  /// The colour at a point of an element: `weights` of its corners, which begin at `first`.
  std::array<std::uint8_t, 3> colorAt(std::size_t first, std::span<const float> weights) const {
    Vec3f color = color_;
    if (!mesh_.colors.empty())
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
      const Rgba8& corner = mesh_.colors[mesh_.corners[first + i]];
      color = color + Vec3f{float(corner.r), float(corner.g), float(corner.b)} * (weights[i] / 255);
    }
    return color;
  }

  Vec3f texel(std::size_t first, std::span<const float> weights) const {
    float s = transform_.translation.x + transform_.center.x, t = transform_.translation.y + transform_.center.y;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      s += weights[i] * mesh_.texCoords[mesh_.corners[first + i]].x;
      t += weights[i] * mesh_.texCoords[mesh_.corners[first + i]].y;
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

  const Mesh& mesh_;
  Vec3f color_{0.8f, 0.8f, 0.8f};
  const Raster* raster_ = nullptr;
  TextureTransform transform_;
};

Vec3d cornerOf(const Mesh& mesh, const Affine3d& worldFromShape, std::size_t corner) {
  const Vec3f& position = mesh.cornerPosition(corner);
  return worldFromShape.point({position.x, position.y, position.z});
}

Vec3f singleOf(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Samples all instances.
class Sampler {
public:
  Sampler(const Scene& scene, const std::vector<Instance>& instances, std::size_t maxSamples)
      : scene_(scene), instances_(instances), maxSamples_(static_cast<double>(maxSamples)) {
    std::size_t elements = 0;
    for (const Instance& instance : instances)
      elements += meshOf(instance).elementCount();
    stride_ = elements / maxVisitedElements + 1;
    for (const Instance& instance : instances)
      measure(instance);
  }

  std::vector<PictureSample> sample() {
    TextureColors textures(scene_.graph);
    for (const Instance& instance : instances_) {
      const Shape& shape = shapeOf(scene_.graph, instance.node);
      const Appearance* appearance = shape.appearance ? &scene_.graph.appearances[*shape.appearance] : nullptr;
      const Surface surface(meshOf(instance), appearance, textures, scene_.graph);
      add(instance, surface);
    }
    return std::move(samples_);
  }

private:
  const Mesh& meshOf(const Instance& instance) const {
    return scene_.meshes[shapeOf(scene_.graph, instance.node).mesh];
  }

  template <typename Visit> void forEachElement(const Instance& instance, Visit visit) const {
    const Mesh& mesh = meshOf(instance);
    const std::size_t corners = cornersPerElement(mesh.topology);
    for (std::size_t element = 0; element < mesh.elementCount(); element += stride_)
      visit(mesh, element * corners);
  }

  /// Adds the instance to the total area, length and number of points.
  void measure(const Instance& instance) {
    forEachElement(instance, [&](const Mesh& mesh, std::size_t first) {
      const Vec3d a = cornerOf(mesh, instance.worldFromShape, first);
      box_.add(a);
      if (mesh.topology == Topology::points) {
        points_ += 1;
        return;
      }
      const Vec3d b = cornerOf(mesh, instance.worldFromShape, first + 1);
      if (mesh.topology == Topology::lines)
        length_ += length(b - a);
      else
        area_ += length(cross(b - a, cornerOf(mesh, instance.worldFromShape, first + 2) - a)) / 2;
    });
  }

  void add(const Instance& instance, const Surface& surface) {
    const double diagonal = length(box_.size());
    if (!(diagonal > 0) || !std::isfinite(diagonal))
      return;
    // Points stand for a surface as large as a side of the box.
    const float pointSize = static_cast<float>(diagonal / std::sqrt(std::max(2 * points_, 1e4)));
    const float lineSize = static_cast<float>(diagonal / 1000);
    const float surfaceSize = static_cast<float>(std::sqrt(area_ / maxSamples_));
    forEachElement(instance, [&](const Mesh& mesh, std::size_t first) {
      const Vec3d a = cornerOf(mesh, instance.worldFromShape, first);
      if (mesh.topology == Topology::points) {
        if (takes(std::min(1.0, maxSamples_ / points_)) > 0)
          samples_.push_back({singleOf(a), {0, 0, 0}, pointSize, surface.colorAt(first, std::array{1.0f})});
        return;
      }
      const Vec3d ab = cornerOf(mesh, instance.worldFromShape, first + 1) - a;
      if (mesh.topology == Topology::lines) {
        for (std::size_t left = takes(std::min(length(ab) / lineSize, maxSamples_ * length(ab) / length_)); left > 0;
             --left) {
          const auto [u, unused] = nextPoint();
          samples_.push_back({singleOf(a + ab * u),
                              {0, 0, 0},
                              lineSize,
                              surface.colorAt(first, std::array{static_cast<float>(1 - u), static_cast<float>(u)})});
        }
        return;
      }
      const Vec3d ac = cornerOf(mesh, instance.worldFromShape, first + 2) - a, normal = cross(ab, ac);
      const double doubleArea = length(normal);
      for (std::size_t left = doubleArea > 0 ? takes(maxSamples_ * doubleArea / 2 / area_) : 0; left > 0; --left) {
        auto [u, v] = nextPoint();
        if (u + v > 1)
          u = 1 - u, v = 1 - v;
        const std::array weights{static_cast<float>(1 - u - v), static_cast<float>(u), static_cast<float>(v)};
        samples_.push_back({singleOf(a + ab * u + ac * v),
                            surface.isLit ? singleOf(normal * (1 / doubleArea)) : Vec3f{0, 0, 0}, surfaceSize,
                            surface.colorAt(first, weights)});
      }
    });
  }

  /// How many samples an element gets that should get `share` of one on average: the remainder goes to later elements.
  std::size_t takes(double share) {
    carried_ += share;
    const double whole = std::floor(carried_);
    carried_ -= whole;
    return static_cast<std::size_t>(whole);
  }

  /// The next point of the R2 sequence (Roberts, 2018), which covers the unit square evenly.
  std::array<double, 2> nextPoint() {
    next_[0] += 0.7548776662466927;
    next_[1] += 0.5698402909980532;
    for (double& coordinate : next_)
      coordinate -= std::floor(coordinate);
    return next_;
  }

  const Scene& scene_;
  const std::vector<Instance>& instances_;
  double maxSamples_;
  std::size_t stride_ = 1;
  Box3d box_;
  double area_ = 0, length_ = 0, points_ = 0;
  double carried_ = 0.5;
  std::array<double, 2> next_{0.5, 0.5};
  std::vector<PictureSample> samples_;
};

} // namespace

PictureSamples pictureSamplesOf(const Scene& scene, std::size_t maxSamples) {
  const VisibleShapes visible(scene.graph);
  if (!visible.isWhole)
    return {{}, false};
  return {Sampler(scene, visible.instances, maxSamples).sample(), true};
}

} // namespace imgeo
