#include "import/assimp/cameras_and_lights.h"

#include "import/assimp/conversions.h"

#include <algorithm>
#include <cmath>

namespace imgeo {

AssimpCamerasAndLights::AssimpCamerasAndLights(const aiScene& source, SceneGraph& graph) : graph_(graph) {
  for (unsigned i = 0; i < source.mNumCameras; ++i)
    cameras_[source.mCameras[i]->mName.C_Str()] = source.mCameras[i];
  for (unsigned i = 0; i < source.mNumLights; ++i)
    lights_[source.mLights[i]->mName.C_Str()] = source.mLights[i];
}

void AssimpCamerasAndLights::addTo(const aiNode& source, Node& node) {
  addCamera(source, node);
  addLight(source, node);
}

void AssimpCamerasAndLights::addCamera(const aiNode& source, Node& node) {
  const auto found = cameras_.find(source.mName.C_Str());
  if (found == cameras_.end())
    return;
  const aiCamera& camera = *found->second;
  Viewpoint viewpoint;
  viewpoint.description = nameOf(camera.mName);
  viewpoint.position = vectorOf(camera.mPosition);
  const Vec3d back = vectorOf(camera.mLookAt) * -1, right = cross(vectorOf(camera.mUp), back), up = cross(back, right);
  if (length(right) > 0 && length(up) > 0)
    viewpoint.orientation =
        transformOf({right * (1 / length(right)), up * (1 / length(up)), back * (1 / length(back)), {}}).rotation;
  const double horizontal = std::clamp<double>(camera.mHorizontalFOV, 0.01, 3);
  const double aspect = camera.mAspect > 1 ? camera.mAspect : 1;
  viewpoint.fieldOfView = 2 * std::atan(std::tan(horizontal / 2) / aspect);
  node.children.push_back(addNode(graph_, {"", viewpoint, {}, ""}));
}

void AssimpCamerasAndLights::addLight(const aiNode& source, Node& node) {
  const auto found = lights_.find(source.mName.C_Str());
  if (found == lights_.end())
    return;
  const aiLight& light = *found->second;
  const aiColor3D& c = light.mColorDiffuse;
  // Assimp has colours beyond 1; X3D has an intensity.
  const float intensity = std::max({c.r, c.g, c.b});
  if (!(intensity > 0) || !std::isfinite(intensity))
    return;
  const Vec3f color{std::max(c.r, 0.0f) / intensity, std::max(c.g, 0.0f) / intensity, std::max(c.b, 0.0f) / intensity};
  Vec3d attenuation{light.mAttenuationConstant, light.mAttenuationLinear, light.mAttenuationQuadratic};
  if (!(attenuation.x + attenuation.y + attenuation.z > 0))
    attenuation = {1, 0, 0};
  constexpr double unlimitedRadius = 1e6;
  const Vec3d position = vectorOf(light.mPosition), direction = vectorOf(light.mDirection);
  NodeContent content;
  if (light.mType == aiLightSource_DIRECTIONAL)
    content = DirectionalLight{direction, color, intensity, true};
  else if (light.mType == aiLightSource_POINT)
    content = PointLight{position, attenuation, unlimitedRadius, color, intensity, true};
  else if (light.mType == aiLightSource_SPOT)
    content = SpotLight{position,
                        direction,
                        light.mAngleInnerCone / 2.0,
                        light.mAngleOuterCone / 2.0,
                        attenuation,
                        unlimitedRadius,
                        color,
                        intensity,
                        true};
  else {
    ++otherLights;
    return;
  }
  node.children.push_back(addNode(graph_, {"", content, {}, ""}));
}

} // namespace imgeo
