#pragma once
// Draws the picture that previews of links show, and the icon of the page.

#include "containers/png/png.h"
#include "transcode/picture/picture_samples.h"

#include <optional>

namespace imgeo {

/// Where a picture is taken from: the first viewpoint of a scene in document order.
struct PictureCamera {
  Affine3d worldFromCamera;    ///< looks along -z
  double fieldOfView = 0.7854; ///< radians, along the shorter side
};

/// The camera of the first viewpoint; without one, a camera that shows all samples.
PictureCamera pictureCameraOf(const SceneGraph& graph, const std::vector<PictureSample>& samples);

/// RGB, 1200 x 630 pixels, which is what social networks display whole. Empty if the camera sees nothing, or is so near
/// that single samples would be visible.
std::optional<Image> drawPicture(const std::vector<PictureSample>& samples, const PictureCamera& camera,
                                 Vec3f background);

/// RGBA, 64 x 64 pixels: what the camera sees of the scene fills a transparent square. Empty if it sees nothing.
std::optional<Image> drawIcon(const std::vector<PictureSample>& samples, const PictureCamera& camera);

/// An icon for scenes of which there is no picture: a cube.
Image drawCubeIcon();

} // namespace imgeo
