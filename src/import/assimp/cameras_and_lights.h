#pragma once
// Turns the cameras and lights of an aiScene into X3D's nodes.

#include "scene/scene.h"

#include <assimp/scene.h>
#include <cstddef>
#include <map>
#include <string>

namespace imgeo {

class AssimpCamerasAndLights {
public:
  /// Both arguments must outlive this.
  AssimpCamerasAndLights(const aiScene& source, SceneGraph& graph);

  /// Adds the camera and the light that have the name of a node as children of `node`.
  void addTo(const aiNode& source, Node& node);

  std::size_t otherLights = 0; ///< left out: of kinds that X3D lacks

private:
  void addCamera(const aiNode& source, Node& node);
  void addLight(const aiNode& source, Node& node);

  SceneGraph& graph_;
  std::map<std::string, const aiCamera*> cameras_; ///< by name
  std::map<std::string, const aiLight*> lights_;   ///< by name
};

} // namespace imgeo
