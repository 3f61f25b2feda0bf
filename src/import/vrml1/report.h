#pragma once
// What a VRML 1.0 file contains that is left out or approximated.

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace imgeo::vrml1 {

struct Report {
  using Counts = std::map<std::string, std::size_t, std::less<>>;

  std::vector<std::string> omissions; ///< damaged content, with its location
  Counts unknownNodes, unknownFields; ///< "Node.field"
  std::size_t mixedMaterials = 0;     ///< shapes whose vertices differ in more than diffuse colour and transparency
  std::size_t projections = 0;        ///< MatrixTransforms that are not affine
  std::size_t shearedTextures = 0;    ///< Texture2Transforms that X3D's TextureTransform cannot express
  std::size_t pointMaps = 0;          ///< WWWAnchors that send the point of a click
  std::size_t textMaterials = 0;      ///< texts whose lines have materials of their own

  /// One sentence per kind of content, without the omissions.
  std::vector<std::string> warnings() const;
};

} // namespace imgeo::vrml1
