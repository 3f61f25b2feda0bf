#pragma once
// Shape Resource Containers (Limper, Thöner, Behr, Fellner: "SRC - a streamable format for generalized web-based 3D
// data transmission", 2014): the files of X3DOM's ExternalGeometry and ExternalShape. Up to X3DOM 1.6 they have a
// layout of their own, in 1.7 that of binary files of glTF 1.0 (KHR_binary_glTF, WEB3D_SRC).
// docs/formats/x3dom-geometry.md describes both.

#include "base/bytes.h"
#include "scene/appearance.h"
#include "scene/mesh.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace imgeo::gltf {

struct ResourceMaterial {
  std::string name;
  Material material;
  bool isSolid = true;
  std::map<TextureRole, Bytes> images; ///< files of images in the container
};

struct ResourceShape {
  Mesh mesh;
  std::optional<std::size_t> material; ///< index into ShapeResource::materials
};

struct ShapeResource {
  std::vector<ResourceShape> shapes;
  std::vector<ResourceMaterial> materials; ///< empty without `withMaterials`
};

/// Reads the mesh that is called `mesh`, or if that is empty the meshes of the container's scene; without a scene, all.
/// As in X3DOM, each mesh counts once, and the transforms of nodes do not count. There is a shape for each kind of
/// element and, `withMaterials`, for each material. Texture coordinates stay as they are stored, but with materials,
/// whose images are upside down in glTF, v becomes 1 - v.
/// `name` stands for the file in messages. Safe for untrusted bytes. Throws Error{truncated, malformed, unsupported},
/// and Error{limit} for views that repeat the file's bytes.
ShapeResource readShapeResource(ByteSpan bytes, const std::string& name, const std::string& mesh, bool withMaterials);

} // namespace imgeo::gltf
