#include "transcode/encode/textures.h"

#include "base/error.h"
#include "base/parallel.h"
#include "containers/png/png.h"
#include "images/decode_image.h"
#include "images/encode_image.h"
#include "images/image_type.h"
#include "images/resize.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace {

constexpr int webpQuality = 80, avifQuality = 60, previewQuality = 60;

/// Smaller images load fast enough without a preview.
constexpr std::size_t minPreviewedBytes = std::size_t{16} << 10;

/// The role of a texture in an X3D source, by the field that contains it.
TextureRole roleOfField(std::string_view field) {
  static constexpr std::pair<std::string_view, TextureRole> data[] = {
      {"normalTexture", TextureRole::normal},
      {"clearcoatNormalTexture", TextureRole::clearcoatNormal},
      {"anisotropyTexture", TextureRole::anisotropy},
      {"clearcoatTexture", TextureRole::clearcoat},
      {"clearcoatRoughnessTexture", TextureRole::clearcoatRoughness},
      {"iridescenceTexture", TextureRole::iridescence},
      {"iridescenceThicknessTexture", TextureRole::iridescenceThickness},
      {"sheenRoughnessTexture", TextureRole::sheenRoughness},
      {"transmissionTexture", TextureRole::transmission},
      {"thicknessTexture", TextureRole::thickness},
      {"metallicRoughnessTexture", TextureRole::metallicRoughness},
      {"occlusionTexture", TextureRole::occlusion},
      {"shininessTexture", TextureRole::shininess}};
  for (const auto& [name, role] : data)
    if (name == field)
      return role;
  return TextureRole::color;
}

void addUse(ImageUse& use, TextureRole role) {
  use.isUsed = true;
  switch (role) {
  case TextureRole::color:
  case TextureRole::emissive:
  case TextureRole::ambient:
  case TextureRole::specular:
  case TextureRole::sheenColor:
  case TextureRole::specularColor:
    use.isColor = true;
    break;
  case TextureRole::normal:
  case TextureRole::anisotropy: // a direction and a strength in each texel
  case TextureRole::clearcoatNormal:
    use.isNormal = true;
    [[fallthrough]];
  case TextureRole::metallicRoughness:
  case TextureRole::occlusion:
  case TextureRole::shininess:
  case TextureRole::clearcoat:
  case TextureRole::clearcoatRoughness:
  case TextureRole::iridescence:
  case TextureRole::iridescenceThickness:
  case TextureRole::sheenRoughness:
  case TextureRole::specularStrength:
  case TextureRole::transmission:
  case TextureRole::thickness:
    use.isData = true;
    break;
  }
}

struct EncodedTexture {
  Bytes bytes;
  std::string extension;
};

EncodedTexture encodedPng(const Raster& raster, int effort) {
  const std::uint32_t channels = hasAlpha(raster) ? 4 : 3;
  Image image{raster.width, raster.height, channels, {}, {}};
  image.pixels.reserve(std::size_t{channels} * raster.width * raster.height);
  for (std::size_t at = 0; at < raster.pixels.size(); at += 4)
    image.pixels.insert(image.pixels.end(), &raster.pixels[at], &raster.pixels[at] + channels);
  return {encodePng(image, effort), ".png"};
}

/// An image as the site will contain it.
struct PreparedImage {
  EncodedTexture file;
  Bytes preview; ///< empty: no preview
  bool isResized = false, isReencoded = false;
  std::string failure; ///< why the image is left out; empty if it is not
  std::string warning; ///< why the image stays unchanged although options ask for another format
};

/// Decides what the site contains for one image, and makes it.
class ImagePreparation {
public:
  ImagePreparation(const ConvertOptions& options, const ImageFile& image, const ImageUse& use)
      : options_(options), image_(image), use_(use), type_(imageType(image.bytes)) {}

  PreparedImage prepared() const {
    PreparedImage result;
    if (!needsPixels()) {
      result.file = {image_.bytes, type_};
      return result;
    }
    try {
      fromPixels(decodeRaster(image_.bytes, image_.url.empty() ? "an embedded image" : image_.url,
                              asksForChange() ? maxAtlasPixels : maxRasterPixels),
                 result);
    } catch (const Error& error) {
      if (isWebImageType(type_)) {
        result.file = {image_.bytes, type_};
        result.warning = asksForChange() ? error.what() : "";
      } else {
        result.failure = error.what();
      }
    }
    return result;
  }

private:
  /// Whether the options ask for another format or size.
  bool asksForChange() const { return options_.textures.format != TextureFormat::keep || options_.textures.size != 0; }
  bool needsPreview() const {
    return options_.textures.previewEdge > 0 && options_.target == Target::web && use_.isColor && !use_.isData &&
           image_.bytes.size() >= minPreviewedBytes;
  }
  bool needsPixels() const {
    return !isWebImageType(type_) || asksForChange() || (isDecodable(type_) && needsPreview());
  }
  PixelContent content() const {
    return use_.isNormal ? PixelContent::directions : use_.isData ? PixelContent::numbers : PixelContent::color;
  }

  void fromPixels(Raster raster, PreparedImage& result) const {
    const TextureOptions& requested = options_.textures;
    const RasterSize own{raster.width, raster.height};
    const RasterSize size = requested.size == 0 ? own : sizeWithin(own, requested.size);
    result.isResized = size.width != own.width || size.height != own.height;
    if (result.isResized)
      raster = downscaled(raster, size, content());
    const bool mustChange = result.isResized || !isWebImageType(type_);
    if (mustChange || requested.format != TextureFormat::keep) {
      result.file = encoded(raster);
      result.isReencoded = mustChange || result.file.bytes.size() < image_.bytes.size();
    }
    if (!result.isReencoded)
      result.file = {image_.bytes, type_};
    const RasterSize small = sizeWithin(size, requested.previewEdge);
    if (needsPreview() && result.file.bytes.size() >= minPreviewedBytes && small.width < size.width)
      result.preview = encodeWebp(downscaled(raster, small, PixelContent::color), previewQuality);
  }

  /// Encodes in the requested format; `keep` encodes a resized image in its own format or the nearest one.
  EncodedTexture encoded(const Raster& raster) const {
    const TextureOptions& requested = options_.textures;
    const bool isLossy = !use_.isData && (requested.format != TextureFormat::keep || type_ == ".jpg");
    if (requested.format == TextureFormat::png || (requested.format == TextureFormat::keep && type_ == ".png") ||
        std::max(raster.width, raster.height) > maxWebpEdge)
      return encodedPng(raster, options_.effort);
    if (isLossy && requested.format == TextureFormat::avif)
      return {encodeAvif(raster, requested.quality.value_or(avifQuality)), ".avif"};
    return {isLossy ? encodeWebp(raster, requested.quality.value_or(webpQuality)) : encodeLosslessWebp(raster),
            ".webp"};
  }

  const ConvertOptions& options_;
  const ImageFile& image_;
  const ImageUse& use_;
  std::string type_;
};

/// Removes all references to images that could not be decoded.
void removeFailedImages(SceneGraph& graph, const std::vector<bool>& hasFailed) {
  for (Appearance& appearance : graph.appearances)
    std::erase_if(appearance.textures,
                  [&](const TextureUse& use) { return hasFailed[graph.textures[use.texture].image]; });
  for (Node& node : graph.nodes)
    if (GenericNode* generic = std::get_if<GenericNode>(&node.content))
      std::erase_if(generic->images, [&](const FieldImage& each) { return hasFailed[each.image]; });
}

void add(TextureReport& report, const ImageFile& image, const PreparedImage& prepared) {
  report.files += 1;
  report.resized += prepared.isResized;
  report.reencoded += prepared.isReencoded;
  report.previews += !prepared.preview.empty();
  report.sourceBytes += image.bytes.size();
  report.bytes += prepared.file.bytes.size();
  report.previewBytes += prepared.preview.size();
}

} // namespace

std::vector<ImageUse> imageUses(const SceneGraph& graph) {
  std::vector<ImageUse> uses(graph.images.size());
  for (const std::size_t node : shapeNodes(graph))
    if (const auto& appearance = shapeOf(graph, node).appearance)
      for (const TextureUse& use : graph.appearances[*appearance].textures)
        addUse(uses[graph.textures[use.texture].image], use.role);
  for (const std::size_t index : nodesInOrder(graph)) {
    const Node& node = graph.nodes[index];
    const GenericNode* generic = std::get_if<GenericNode>(&node.content);
    if (!generic)
      continue;
    const auto field = std::ranges::find(node.fields, "containerField", &FieldText::name);
    for (const FieldImage& each : generic->images)
      addUse(uses[each.image], roleOfField(field == node.fields.end() ? std::string_view{} : field->value));
  }
  return uses;
}

TextureReport writeTextures(SceneGraph& graph, const ConvertOptions& options, ContentFiles& files,
                            std::vector<std::string>& warnings) {
  const std::vector<ImageUse> uses = imageUses(graph);
  std::vector<PreparedImage> all(graph.images.size());
  parallelFor(all.size(), [&](std::size_t i) {
    if (uses[i].isUsed)
      all[i] = ImagePreparation(options, graph.images[i], uses[i]).prepared();
  });
  TextureReport report;
  std::vector<bool> hasFailed(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!uses[i].isUsed)
      continue;
    ImageFile& image = graph.images[i];
    if (!all[i].failure.empty()) {
      if (options.strict)
        throw Error(ErrorKind::malformed, "", all[i].failure);
      warnings.push_back(fmt::format("A texture is left out: {}.", all[i].failure));
      hasFailed[i] = true;
      continue;
    }
    if (!all[i].warning.empty())
      warnings.push_back(fmt::format("A texture stays as it is: {}.", all[i].warning));
    add(report, image, all[i]);
    image.url = files.write(all[i].file.bytes, all[i].file.extension);
    if (!all[i].preview.empty())
      image.preview = files.write(all[i].preview, ".webp");
    image.bytes = {};
  }
  removeFailedImages(graph, hasFailed);
  return report;
}

} // namespace imgeo
