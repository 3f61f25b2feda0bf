#include "transcode/picture/draw_picture.h"

#include "scene/mesh.h"
#include "scene/viewpoint.h"
#include "transcode/default_scene/default_lighting.h"
#include "transcode/picture/generic_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace imgeo {

namespace {

constexpr std::uint32_t pictureWidth = 1200, pictureHeight = 630, iconEdge = 64;

/// Pixels that are drawn for each pixel of a picture, along an axis: edges become smooth.
constexpr std::uint32_t oversampling = 2;

/// No picture is drawn where a larger share of its pixels shows large squares: inside of a building, samples that are
/// near look like tiles.
constexpr double maxCoarseShare = 0.1;

/// Finds the first viewpoint and its pose in the world.
std::optional<PictureCamera> firstCamera(const SceneGraph& graph, std::size_t index, const Affine3d& worldFromParent) {
  const Node& node = graph.nodes[index];
  if (const std::optional<Viewpoint> viewpoint = viewpointOf(node)) {
    Affine3d pose = affineOf(viewpoint->orientation);
    pose.translation = viewpoint->position;
    return PictureCamera{worldFromParent * pose, viewpoint->fieldOfView};
  }
  const Transform* transform = std::get_if<Transform>(&node.content);
  const Affine3d worldFromNode = transform ? worldFromParent * affineOf(*transform) : worldFromParent;
  for (const std::size_t child : node.children)
    if (std::optional<PictureCamera> camera = firstCamera(graph, child, worldFromNode))
      return camera;
  return std::nullopt;
}

/// The unit vector to a viewer who is to the right, above and in front.
constexpr Vec3d threeQuarterFront{0.48, 0.36, 0.8};

PictureCamera cameraFraming(const std::vector<PictureSample>& samples) {
  Box3d box;
  for (const PictureSample& sample : samples)
    box.add({sample.position.x, sample.position.y, sample.position.z});
  const Viewpoint viewpoint = viewpointFrom(threeQuarterFront, box);
  Affine3d pose = affineOf(viewpoint.orientation);
  pose.translation = viewpoint.position;
  return {pose, viewpoint.fieldOfView};
}

/// A colour and a depth for each pixel, drawn from samples as squares that face the viewer.
class Canvas {
public:
  Canvas(std::uint32_t pixelsAcross, std::uint32_t pixelsDown)
      : width(pixelsAcross), height(pixelsDown), depths(std::size_t{width} * height, infinity), colors(depths.size()) {}

  void draw(const std::vector<PictureSample>& samples, const PictureCamera& camera) {
    const Affine3d& pose = camera.worldFromCamera;
    const Vec3d right = unit(pose.x), up = unit(pose.y), back = unit(pose.z);
    const double focal = std::min(width, height) / 2.0 / std::tan(std::clamp(camera.fieldOfView, 0.01, 3.1) / 2);
    for (const PictureSample& sample : samples) {
      const Vec3d offset = Vec3d{sample.position.x, sample.position.y, sample.position.z} - pose.translation;
      const double depth = -dot(offset, back);
      if (!(depth > 0))
        continue;
      const double x = width / 2.0 + focal * dot(offset, right) / depth;
      const double y = height / 2.0 - focal * dot(offset, up) / depth;
      // A little larger than the area for which the sample stands, so that there are no holes between squares.
      const double half = std::clamp(1.1 * sample.size * focal / depth, 0.5, 30.0);
      isCoarse_ = half > maxHalf;
      fill(x - half, x + half, y - half, y + half, static_cast<float>(depth), shade(sample, offset));
    }
  }

  static constexpr float infinity = std::numeric_limits<float>::infinity();
  std::uint32_t width, height;
  std::vector<float> depths;
  std::vector<std::array<std::uint8_t, 3>> colors;

  /// The share of the drawn pixels that belong to squares which are visible as such.
  double coarseShare() const {
    const std::size_t drawn = depths.size() - static_cast<std::size_t>(std::ranges::count(depths, infinity));
    const auto coarse = static_cast<double>(std::ranges::count(areCoarse_, true));
    return drawn == 0 ? 0 : coarse / static_cast<double>(drawn);
  }

private:
  /// Half the side of squares that are hardly visible as such.
  static constexpr double maxHalf = 2.5 * oversampling;

  static Vec3d unit(Vec3d v) {
    const double size = length(v);
    return size > 0 ? v * (1 / size) : v;
  }

  void fill(double left, double right, double top, double bottom, float depth, std::array<std::uint8_t, 3> color) {
    const auto clamped = [](double value, std::uint32_t limit) {
      return static_cast<std::uint32_t>(std::clamp(std::round(value), 0.0, static_cast<double>(limit)));
    };
    const std::uint32_t x1 = clamped(right, width), y1 = clamped(bottom, height);
    for (std::uint32_t y = clamped(top, height); y < y1; ++y)
      for (std::uint32_t x = clamped(left, width); x < x1; ++x) {
        const std::size_t pixel = std::size_t{y} * width + x;
        if (depth >= depths[pixel])
          continue;
        depths[pixel] = depth;
        colors[pixel] = color;
        areCoarse_[pixel] = isCoarse_;
      }
  }

  /// Lit by the default lights and by a headlight, as in a page; both sides of a surface are lit.
  static std::array<std::uint8_t, 3> shade(const PictureSample& sample, Vec3d offset) {
    Vec3d normal{sample.normal.x, sample.normal.y, sample.normal.z};
    if (dot(normal, normal) == 0)
      return sample.color;
    const Vec3d toViewer = unit(offset * -1);
    if (dot(normal, toViewer) < 0)
      normal = normal * -1;
    const double headlight = dot(normal, toViewer);
    const Vec3f light = Vec3f{1, 1, 1} * static_cast<float>(headlight) + fillLight.color * ambientShare +
                        diffuseLight(keyLight, normal) + diffuseLight(fillLight, normal);
    const auto byteOf = [](std::uint8_t color, float factor) {
      return static_cast<std::uint8_t>(std::min(255.0f, color * factor + 0.5f));
    };
    return {byteOf(sample.color[0], light.x), byteOf(sample.color[1], light.y), byteOf(sample.color[2], light.z)};
  }

  static Vec3f diffuseLight(const DirectionalLight& light, Vec3d normal) {
    const double cosine = std::max(0.0, -dot(normal, unit(light.direction)));
    return light.color * (light.intensity * static_cast<float>(cosine));
  }

  bool isCoarse_ = false; ///< of the sample that is being drawn
  std::vector<bool> areCoarse_ = std::vector<bool>(depths.size());
};

/// The mean of the drawn pixels in a rectangle, and the share of the rectangle that is drawn, 0..1.
struct Mean {
  Vec3d color;
  double cover = 0;
};

Mean meanOf(const Canvas& canvas, std::uint32_t x0, std::uint32_t y0, std::uint32_t x1, std::uint32_t y1) {
  Mean mean;
  for (std::uint32_t y = y0; y < y1; ++y)
    for (std::uint32_t x = x0; x < x1; ++x) {
      const std::size_t pixel = std::size_t{y} * canvas.width + x;
      if (canvas.depths[pixel] == Canvas::infinity)
        continue;
      const auto& [red, green, blue] = canvas.colors[pixel];
      mean.color = mean.color + Vec3d{double(red), double(green), double(blue)};
      mean.cover += 1;
    }
  if (mean.cover > 0)
    mean.color = mean.color * (1 / mean.cover);
  mean.cover /= static_cast<double>(x1 - x0) * (y1 - y0);
  return mean;
}

std::uint8_t byteOf(double value) {
  return static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0));
}

/// The drawn part of a canvas; empty if nothing is drawn.
struct Drawn {
  std::uint32_t left = std::numeric_limits<std::uint32_t>::max(), right = 0, top = left, bottom = 0;
  bool isEmpty() const { return left > right; }
};

Drawn drawnPartOf(const Canvas& canvas) {
  Drawn drawn;
  for (std::uint32_t y = 0; y < canvas.height; ++y)
    for (std::uint32_t x = 0; x < canvas.width; ++x)
      if (canvas.depths[std::size_t{y} * canvas.width + x] != Canvas::infinity) {
        drawn.left = std::min(drawn.left, x), drawn.right = std::max(drawn.right, x);
        drawn.top = std::min(drawn.top, y), drawn.bottom = std::max(drawn.bottom, y);
      }
  return drawn;
}

} // namespace

PictureCamera pictureCameraOf(const SceneGraph& graph, const std::vector<PictureSample>& samples) {
  for (const std::size_t root : graph.roots)
    if (const std::optional<PictureCamera> camera = firstCamera(graph, root, {}))
      return *camera;
  return cameraFraming(samples);
}

std::optional<Image> drawPicture(const std::vector<PictureSample>& samples, const PictureCamera& camera,
                                 Vec3f background) {
  Canvas canvas(pictureWidth * oversampling, pictureHeight * oversampling);
  canvas.draw(samples, camera);
  if (drawnPartOf(canvas).isEmpty() || canvas.coarseShare() > maxCoarseShare)
    return std::nullopt;
  Image image{pictureWidth, pictureHeight, 3, {}, {}};
  const std::array behind{byteOf(255 * background.x), byteOf(255 * background.y), byteOf(255 * background.z)};
  image.pixels.reserve(std::size_t{3} * pictureWidth * pictureHeight);
  for (std::uint32_t y = 0; y < pictureHeight; ++y)
    for (std::uint32_t x = 0; x < pictureWidth; ++x) {
      const Mean mean =
          meanOf(canvas, x * oversampling, y * oversampling, (x + 1) * oversampling, (y + 1) * oversampling);
      for (int i = 0; i < 3; ++i)
        image.pixels.push_back(mean.cover == 0 ? behind[static_cast<std::size_t>(i)]
                                               : byteOf(mean.color[i] * mean.cover +
                                                        behind[static_cast<std::size_t>(i)] * (1 - mean.cover)));
    }
  return image;
}

std::optional<Image> drawIcon(const std::vector<PictureSample>& samples, const PictureCamera& camera) {
  constexpr std::uint32_t edge = iconEdge * 4;
  Canvas canvas(edge, edge);
  canvas.draw(samples, camera);
  const Drawn drawn = drawnPartOf(canvas);
  if (drawn.isEmpty())
    return std::nullopt;
  // The smallest square around what is drawn; it may be partly outside of the canvas.
  const double size = std::max(drawn.right - drawn.left, drawn.bottom - drawn.top) + 1.0;
  const double left = (drawn.left + drawn.right + 1 - size) / 2, top = (drawn.top + drawn.bottom + 1 - size) / 2;
  const auto pixelAt = [&](double start, std::uint32_t i) {
    return static_cast<std::uint32_t>(std::clamp(start + size * i / iconEdge, 0.0, double(edge)));
  };
  Image image{iconEdge, iconEdge, 4, {}, {}};
  for (std::uint32_t y = 0; y < iconEdge; ++y)
    for (std::uint32_t x = 0; x < iconEdge; ++x) {
      const std::uint32_t x0 = pixelAt(left, x), x1 = pixelAt(left, x + 1), y0 = pixelAt(top, y),
                          y1 = pixelAt(top, y + 1);
      // Where the square has fewer than 64 pixels along an edge, several pixels of the icon show the same one.
      const Mean mean =
          meanOf(canvas, x0, y0, std::min(std::max(x1, x0 + 1), edge), std::min(std::max(y1, y0 + 1), edge));
      const bool isInside = x0 < edge && y0 < edge;
      image.pixels.push_back(isInside ? byteOf(mean.color.x) : 0);
      image.pixels.push_back(isInside ? byteOf(mean.color.y) : 0);
      image.pixels.push_back(isInside ? byteOf(mean.color.z) : 0);
      image.pixels.push_back(isInside ? byteOf(255 * mean.cover) : 0);
    }
  return image;
}

Image drawCubeIcon() {
  std::vector<PictureSample> samples;
  constexpr int steps = 200;
  constexpr float size = 2.0f / steps;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const float u = (static_cast<float>(i) + 0.5f) * size - 1, v = (static_cast<float>(j) + 0.5f) * size - 1;
      constexpr std::array<std::uint8_t, 3> blue{59, 130, 246};
      samples.push_back({{1, u, v}, {1, 0, 0}, size, blue});
      samples.push_back({{u, 1, v}, {0, 1, 0}, size, blue});
      samples.push_back({{u, v, 1}, {0, 0, 1}, size, blue});
    }
  return *drawIcon(samples, cameraFraming(samples));
}

} // namespace imgeo
