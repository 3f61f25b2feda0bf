#include "transcode/picture/write_pictures.h"

#include "base/file.h"
#include "transcode/picture/draw_picture.h"
#include "transcode/picture/generic_fields.h"
#include "transcode/site/site_files.h"

namespace imgeo {

namespace {

/// Effort of PNG: higher ones save few bytes in pictures of this size.
constexpr int pictureEffort = 1;

/// The background of pages without one.
constexpr Vec3f defaultBackground{0.93f, 0.94f, 0.95f};

} // namespace

PagePictures writePictures(const SceneGraph& graph, const PictureSamples& samples, const std::filesystem::path& site) {
  std::optional<Image> icon;
  PagePictures pictures{.iconUrl = iconName, .pictureUrl = {}};
  if (samples.isWhole && !samples.samples.empty()) {
    const PictureCamera camera = pictureCameraOf(graph, samples.samples);
    icon = drawIcon(samples.samples, camera);
    const Vec3f background = skyColorOf(graph).value_or(defaultBackground);
    if (const std::optional<Image> picture = drawPicture(samples.samples, camera, background)) {
      writeFile(site / pictureName, encodePng(*picture, pictureEffort));
      pictures.pictureUrl = pictureName;
    }
  }
  writeFile(site / iconName, encodePng(icon ? *icon : drawCubeIcon(), pictureEffort));
  return pictures;
}

} // namespace imgeo
