#include "import/assimp/assimp.h"
#include "import/archive/zip.h"
#include "import/assimp/animations.h"
#include "import/assimp/deformation.h"
#include "import/assimp/files.h"
#include "import/assimp/library.h"
#include "import/assimp/materials.h"
#include "import/assimp/reported_errors.h"
#include "import/isolation/child_process.h"
#include "import/mesh/crease_normals.h"
#include "import/mesh/texcoord_mapping.h"
#include "import/mesh/triangulate.h"
#include "import/mesh/unit_normal.h"
#include "import/text/rounded_decimal.h"
#include "import/warnings.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <numbers>
#include <set>

namespace imgeo {

namespace {

constexpr std::size_t maxNodeDepth = 200;
/// The crease angle of meshes without normals. These formats mostly hold man-made objects, whose edges should be sharp.
constexpr double creaseAngle = 45 * std::numbers::pi / 180;

Vec3d vectorOf(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

Affine3d mapOf(const aiMatrix4x4& m) {
  return {{m.a1, m.b1, m.c1}, {m.a2, m.b2, m.c2}, {m.a3, m.b3, m.c3}, {m.a4, m.b4, m.c4}};
}

bool isFinite(const Affine3d& map) {
  return std::ranges::all_of(std::array{map.x, map.y, map.z, map.translation},
                             [](Vec3d v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); });
}

/// A node's name; empty for names that Assimp generates.
std::string nameOf(const aiString& name) {
  const std::string text = name.C_Str();
  const bool isGenerated = text.starts_with('$') || text.starts_with('<') || text == "ROOT" || text == "RootNode";
  return isGenerated ? "" : text;
}

/// A number of the file's metadata; nothing if the file has none of this name.
std::optional<double> metadataOf(const aiScene& scene, const char* name) {
  double number = 0;
  float single = 0;
  std::int32_t integer = 0;
  if (!scene.mMetaData)
    return std::nullopt;
  if (scene.mMetaData->Get(name, number))
    return number;
  if (scene.mMetaData->Get(name, single))
    return single;
  if (scene.mMetaData->Get(name, integer))
    return integer;
  return std::nullopt;
}

/// Formats without a convention, or whose files often disregard it. Assimp 5.2 passes their numbers on, except that it
/// takes 3DS files to be z up.
constexpr std::array<std::string_view, 8> formatsOfAnyAxis{"3ds", "amf", "cob", "nff", "off", "raw", "smd", "stl"};

/// Sets the direction that points up in what Assimp has read: it brings formats to y up, apart from these.
void addAxes(const aiScene& scene, std::string_view extension, Imported& imported) {
  imported.up = AxisDirection::y;
  if (extension == "blend" || extension == "3mf") {
    imported.up = AxisDirection::z;
    imported.metres = extension == "3mf" ? 0.001 : 1; // the default units of both
  } else if (extension == "fbx") {
    const bool isPositive = metadataOf(scene, "UpAxisSign").value_or(1) > 0;
    const double axis = metadataOf(scene, "UpAxis").value_or(1);
    imported.up = axis == 0   ? (isPositive ? AxisDirection::x : AxisDirection::minusX)
                  : axis == 2 ? (isPositive ? AxisDirection::z : AxisDirection::minusZ)
                              : (isPositive ? AxisDirection::y : AxisDirection::minusY);
    const double centimetres = metadataOf(scene, "UnitScaleFactor").value_or(1);
    if (centimetres > 0 && std::isfinite(centimetres))
      imported.metres = centimetres / 100;
  } else if (std::ranges::find(formatsOfAnyAxis, extension) != formatsOfAnyAxis.end()) {
    imported.up.reset();
  }
}

/// Reads one aiScene.
class SceneReader {
public:
  SceneReader(const aiScene& source, const std::string& name, const References& references,
              const ImportOptions& options, std::string_view extension)
      : source_(source), name_(name), choice_(options.attributes), isStrict_(options.strict),
        isFbx_(extension == "fbx"), materials_(source, imported_.scene.graph, references, extension) {}

  Imported read(std::string format) {
    imported_.format = std::move(format);
    joints_ = boneNames(source_);
    for (unsigned i = 0; i < source_.mNumMeshes; ++i)
      readMesh(i);
    for (unsigned i = 0; i < source_.mNumCameras; ++i)
      cameras_[source_.mCameras[i]->mName.C_Str()] = source_.mCameras[i];
    for (unsigned i = 0; i < source_.mNumLights; ++i)
      lights_[source_.mLights[i]->mName.C_Str()] = source_.mLights[i];
    for (unsigned i = 0; i < source_.mNumAnimations; ++i)
      for (unsigned c = 0; c < source_.mAnimations[i]->mNumChannels; ++c)
        moved_.insert(source_.mAnimations[i]->mChannels[c]->mNodeName.C_Str());
    if (source_.mRootNode)
      readRoot(*source_.mRootNode);
    addHumanoids();
    readAnimations();
    addWarnings();
    return std::move(imported_);
  }

private:
  SceneGraph& graph() { return imported_.scene.graph; }

  /// Adds the root node, or its children where Assimp has generated the root.
  void readRoot(const aiNode& root) {
    const std::size_t node = readNode(root, 1);
    const Node& read = graph().nodes[node];
    const bool isGenerated = std::holds_alternative<Group>(read.content) && (read.name.empty() || root.mNumMeshes == 0);
    graph().roots = isGenerated ? read.children : std::vector{node};
  }

  std::size_t readNode(const aiNode& source, std::size_t depth) {
    if (depth > maxNodeDepth)
      throw Error(ErrorKind::limit, name_, "its nodes are nested too deeply");
    Node node;
    node.name = nameOf(source.mName);
    const Affine3d map = mapOf(source.mTransformation);
    const bool isJoint = joints_.contains(source.mName.C_Str());
    const bool isMoved = isJoint || moved_.contains(source.mName.C_Str());
    if (!isFinite(map))
      ++lostTransforms_;
    else if (isMoved)
      node.content = rounded(unskewedTransformOf(map));
    else if (map != Affine3d{})
      node.content = rounded(transformOf(map));
    if (isJoint) {
      if (!std::holds_alternative<Transform>(node.content))
        node.content = Transform{};
      std::get<Transform>(node.content).isJoint = true;
    }
    for (unsigned i = 0; i < source.mNumMeshes; ++i)
      if (const unsigned mesh = source.mMeshes[i]; isSkinned_.at(mesh))
        skinned_.insert(mesh);
      else
        node.children.insert(node.children.end(), shapesOf_[mesh].begin(), shapesOf_[mesh].end());
    for (unsigned i = 0; i < source.mNumMeshes; ++i)
      if (const std::vector<std::size_t>& displacers = displacersOf_.at(source.mMeshes[i]); !displacers.empty())
        displacers_[source.mName.C_Str()].insert(displacers);
    addCamera(source, node);
    addLight(source, node);
    for (unsigned i = 0; i < source.mNumChildren; ++i)
      node.children.push_back(readNode(*source.mChildren[i], depth + 1));
    const bool isTransform = std::holds_alternative<Transform>(node.content);
    const std::size_t index = addNode(graph(), std::move(node));
    if (isMoved && isTransform)
      movedNodes_.emplace(source.mName.C_Str(), index);
    return index;
  }

  /// Adds a humanoid for each mesh with bones, behind all joints. As in glTF the transform of its node does not count.
  void addHumanoids() {
    for (const unsigned mesh : skinned_) {
      Humanoid humanoid = humanoidOf(*source_.mMeshes[mesh], movedNodes_);
      if (humanoid.joints.empty()) {
        ++damagedSkins_;
        for (const std::size_t shape : shapesOf_[mesh])
          graph().roots.push_back(shape);
        continue;
      }
      addRoot(graph(), {nameOf(source_.mMeshes[mesh]->mName), std::move(humanoid), shapesOf_[mesh], ""});
    }
  }

  void readAnimations() {
    AssimpAnimations animations(source_, graph(), movedNodes_, displacers_);
    animations.read();
    otherChannels_ = animations.otherChannels;
    malformedChannels_ = animations.malformedChannels;
  }

  /// Adds one shape per kind of element; all nodes with the mesh share it.
  void readMesh(unsigned index) {
    const aiMesh& source = *source_.mMeshes[index];
    std::vector<std::size_t>& shapes = shapesOf_.emplace_back();
    const std::optional<std::size_t> appearance = materials_.appearance(source.mMaterialIndex);
    const std::vector<unsigned> texCoordSets = keptTexCoordSets(source, appearance);
    std::vector<std::size_t> displacers; ///< shared by the shapes
    for (const Topology topology : allTopologies) {
      Mesh mesh;
      mesh.topology = topology;
      addCorners(source, mesh);
      if (mesh.corners.empty())
        continue;
      addVertices(source, texCoordSets, mesh);
      if (topology == Topology::triangles && mesh.normals.empty() && !isDeformed(mesh))
        mesh = withCreaseNormals(mesh, creaseAngle);
      Shape shape;
      shape.mesh = imported_.scene.meshes.size();
      shape.appearance = appearance;
      shape.solid = materials_.isSolid(source.mMaterialIndex);
      imported_.scene.meshes.push_back(std::move(mesh));
      const std::size_t targets = displacementCount(imported_.scene.meshes.back());
      while (displacers.size() < targets)
        displacers.push_back(displacerNode(*source.mAnimMeshes[displacers.size()]));
      std::vector<std::size_t> own(displacers.begin(), displacers.begin() + static_cast<std::ptrdiff_t>(targets));
      shapes.push_back(addNode(graph(), {nameOf(source.mName), shape, std::move(own), ""}));
    }
    if (!displacers.empty())
      displacers_[source.mName.C_Str()].insert(displacers);
    displacersOf_.push_back(std::move(displacers));
    isSkinned_.push_back(std::ranges::any_of(shapes, [&](std::size_t shape) {
      return jointSetCount(imported_.scene.meshes[shapeOf(graph(), shape).mesh]) > 0;
    }));
    furtherColors_ += source.GetNumColorChannels() > 1;
  }

  std::size_t displacerNode(const aiAnimMesh& target) {
    const std::string name = nameOf(target.mName);
    unknownWeights_ += isFbx_;
    const double weight = isFbx_ ? 0 : target.mWeight; // of FBX Assimp 5.2 reports 1, whatever the file states
    return addNode(graph(), {name.empty() ? "displacer" : name, Displacer{name, weight}, {}, ""});
  }

  /// The sets of texture coordinates that textures use, the first where none uses any, and those that the user named.
  std::vector<unsigned> keptTexCoordSets(const aiMesh& source, std::optional<std::size_t> appearance) {
    std::set<std::string> used;
    if (appearance)
      for (const TextureUse& texture : graph().appearances[*appearance].textures)
        used.insert(texture.mapping);
    std::vector<unsigned> kept;
    unsigned present = 0;
    for (unsigned set = 0; set < AI_MAX_NUMBER_OF_TEXTURECOORDS; ++set) {
      if (!source.HasTextureCoords(set))
        continue;
      ++present;
      const bool isUsed = used.empty() ? present == 1 : used.contains(mappingOf(set));
      if (kept.size() < maxTexCoordSets && (isUsed || choice_.has(fmt::format("TEXCOORD_{}", set))))
        kept.push_back(set);
    }
    if (kept.empty() && source.HasTextureCoords(0)) // textures whose set is missing use the first
      kept.push_back(0);
    furtherTexCoords_ += present > kept.size();
    return kept;
  }

  void addCorners(const aiMesh& source, Mesh& mesh) {
    const std::uint32_t cornerCount = cornersPerElement(mesh.topology);
    std::vector<Vec3f> ring;
    std::vector<std::uint32_t> triangles;
    for (unsigned i = 0; i < source.mNumFaces; ++i) {
      const aiFace& face = source.mFaces[i];
      const bool isPolygon = mesh.topology == Topology::triangles && face.mNumIndices > 3;
      if (face.mNumIndices != cornerCount && !isPolygon)
        continue;
      for (unsigned c = 0; c < face.mNumIndices; ++c)
        if (face.mIndices[c] >= source.mNumVertices)
          throw Error(ErrorKind::malformed, name_,
                      fmt::format("face {} of a mesh names vertex {} of {}", i, face.mIndices[c], source.mNumVertices));
      if (!isPolygon) {
        mesh.corners.insert(mesh.corners.end(), face.mIndices, face.mIndices + face.mNumIndices);
        continue;
      }
      ring.clear(), triangles.clear();
      for (unsigned c = 0; c < face.mNumIndices; ++c)
        ring.push_back(Vec3f(vectorOf(source.mVertices[face.mIndices[c]])));
      fans_ += !triangulate(ring, triangles);
      for (const std::uint32_t corner : triangles)
        mesh.corners.push_back(face.mIndices[corner]);
    }
  }

  /// Adds the vertices that the corners use, in the order of first use.
  void addVertices(const aiMesh& source, const std::vector<unsigned>& texCoordSets, Mesh& mesh) {
    std::vector<std::uint32_t> local(source.mNumVertices, ~0u), vertices;
    for (std::uint32_t& corner : mesh.corners) {
      std::uint32_t& index = local[corner];
      if (index == ~0u) {
        index = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.wedgePositions.push_back(index);
        vertices.push_back(corner);
        addVertex(source, corner, texCoordSets, mesh);
      }
      corner = index;
    }
    const bool isOpaque = std::ranges::all_of(mesh.colors, [](const Rgba& color) { return color.a == 1; });
    mesh.colorComponents = isOpaque ? 3 : 4;
    if (texCoordSets.size() > 1) // a single set serves all textures
      for (const unsigned set : texCoordSets)
        mesh.texCoordMappings.push_back(mappingOf(set));
    if (source.mNumBones > 0)
      damagedSkins_ += !addBones(source, vertices, mesh);
    if (source.mNumAnimMeshes > 0)
      damagedTargets_ += !addTargets(source, vertices, mesh);
  }

  void addVertex(const aiMesh& source, std::uint32_t vertex, const std::vector<unsigned>& texCoordSets, Mesh& mesh) {
    const aiVector3D& p = source.mVertices[vertex];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw Error(ErrorKind::malformed, name_, fmt::format("vertex {} of a mesh is not a number", vertex));
    mesh.positions.push_back(Vec3f(vectorOf(p)));
    if (source.HasNormals() && mesh.topology == Topology::triangles) {
      mesh.normals.push_back(Vec3f(vectorOf(source.mNormals[vertex])));
      unusableNormals_ += !makeUnit(mesh.normals.back());
    }
    for (std::size_t i = 0; i < texCoordSets.size(); ++i) {
      const aiVector3D& t = source.mTextureCoords[texCoordSets[i]][vertex];
      texCoordsOf(mesh, i).push_back(std::isfinite(t.x) && std::isfinite(t.y) ? Vec2f{t.x, t.y} : Vec2f{});
    }
    if (source.HasVertexColors(0)) {
      const aiColor4D& color = source.mColors[0][vertex];
      mesh.colors.emplace_back(channelOf(color.r), channelOf(color.g), channelOf(color.b), channelOf(color.a));
    }
  }

  void addCamera(const aiNode& source, Node& node) {
    const auto found = cameras_.find(source.mName.C_Str());
    if (found == cameras_.end())
      return;
    const aiCamera& camera = *found->second;
    Viewpoint viewpoint;
    viewpoint.description = nameOf(camera.mName);
    viewpoint.position = vectorOf(camera.mPosition);
    const Vec3d back = vectorOf(camera.mLookAt) * -1, right = cross(vectorOf(camera.mUp), back),
                up = cross(back, right);
    if (length(right) > 0 && length(up) > 0)
      viewpoint.orientation =
          transformOf({right * (1 / length(right)), up * (1 / length(up)), back * (1 / length(back)), {}}).rotation;
    const double horizontal = std::clamp<double>(camera.mHorizontalFOV, 0.01, 3);
    const double aspect = camera.mAspect > 1 ? camera.mAspect : 1;
    viewpoint.fieldOfView = 2 * std::atan(std::tan(horizontal / 2) / aspect);
    node.children.push_back(addNode(graph(), {"", viewpoint, {}, ""}));
  }

  void addLight(const aiNode& source, Node& node) {
    const auto found = lights_.find(source.mName.C_Str());
    if (found == lights_.end())
      return;
    const aiLight& light = *found->second;
    const aiColor3D& c = light.mColorDiffuse;
    // Assimp has colours beyond 1; X3D has an intensity.
    const float intensity = std::max({c.r, c.g, c.b});
    if (!(intensity > 0) || !std::isfinite(intensity))
      return;
    const Vec3f color{std::max(c.r, 0.0f) / intensity, std::max(c.g, 0.0f) / intensity,
                      std::max(c.b, 0.0f) / intensity};
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
      ++otherLights_;
      return;
    }
    node.children.push_back(addNode(graph(), {"", content, {}, ""}));
  }

  void addWarnings() {
    std::vector<std::string>& warnings = imported_.warnings;
    const auto add = [&](std::size_t count, const char* singular, const char* plural) {
      if (count > 0)
        warnings.push_back(fmt::format("{} not carried over.", counted(count, singular, plural)));
    };
    add(otherChannels_, "animation of morph targets that no mesh has, or of a whole mesh, is",
        "animations of morph targets that no mesh has, or of whole meshes, are");
    add(malformedChannels_, "animation of a node, whose keys are not in order or not finite, is",
        "animations of nodes, whose keys are not in order or not finite, are");
    add(damagedSkins_, "skin with damaged weights, or bones that are not in the scene, is",
        "skins with damaged weights, or bones that are not in the scene, are");
    add(damagedTargets_, "mesh has damaged or too many morph targets, which are",
        "meshes have damaged or too many morph targets, which are");
    if (unknownWeights_ > 0)
      warnings.push_back(fmt::format("The weights at rest of {} are 0: Assimp does not report those of FBX files.",
                                     counted(unknownWeights_, "morph target", "morph targets")));
    add(furtherTexCoords_, "mesh has texture coordinates that no texture uses, which are",
        "meshes have texture coordinates that no texture uses, which are");
    add(furtherColors_, "mesh has further colours, which are", "meshes have further colours, which are");
    add(otherLights_, "light of a kind that X3D lacks is", "lights of kinds that X3D lacks are");
    add(lostTransforms_, "transform that is not finite is", "transforms that are not finite are");
    warnOfNormals(warnings, unusableNormals_);
    warnOfFans(warnings, fans_);
    addOmissions(warnings, materials_.omissions(), isStrict_, name_);
    materials_.addWarnings(warnings);
  }

  const aiScene& source_;
  const std::string& name_;
  const AttributeChoice& choice_;
  bool isStrict_;
  bool isFbx_;
  Imported imported_;
  AssimpMaterials materials_;
  std::vector<std::vector<std::size_t>> shapesOf_; ///< shape nodes by mesh
  std::map<std::string, const aiCamera*> cameras_;
  std::map<std::string, const aiLight*> lights_;
  std::set<std::string> moved_; ///< names of the nodes that animations move
  std::map<std::string, std::size_t> movedNodes_;
  std::vector<std::vector<std::size_t>> displacersOf_; ///< by mesh
  DisplacersByName displacers_;
  std::size_t otherChannels_ = 0, malformedChannels_ = 0;
  std::set<std::string> joints_; ///< names of the nodes that are bones
  std::vector<bool> isSkinned_;  ///< by mesh
  std::set<unsigned> skinned_;   ///< meshes of nodes, with bones
  std::size_t damagedSkins_ = 0, damagedTargets_ = 0, unknownWeights_ = 0, furtherTexCoords_ = 0, furtherColors_ = 0,
              otherLights_ = 0, lostTransforms_ = 0, fans_ = 0, unusableNormals_ = 0;
};

/// The last extension in lower case, with its dot. Unlike for extensionOf, that may be ".gz": Assimp reads no gzipped
/// files.
std::string lastExtensionOf(const std::string& name) {
  std::string extension = std::filesystem::path(name).extension().string();
  std::ranges::transform(extension, extension.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  return extension;
}

struct Release {
  void operator()(const aiScene* scene) const { assimp().releaseImport(scene); }
  void operator()(aiPropertyStore* properties) const { assimp().releasePropertyStore(properties); }
};

/// `dottedExtension`, in lower case, is that of the bytes' format.
Imported readInThisProcess(ByteSpan bytes, const std::string& name, const ImportOptions& options,
                           const std::string& dottedExtension) {
  const References references(options, name);
  const std::string assimpName = std::filesystem::path(name).replace_extension(dottedExtension);
  SourceFiles files(bytes, assimpName, references);
  const std::unique_ptr<aiPropertyStore, Release> properties(assimp().createPropertyStore());
  assimp().setImportPropertyInteger(properties.get(), AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS,
                                    false); // otherwise Assimp splits each node into several
  assimp().setImportPropertyInteger(properties.get(), AI_CONFIG_IMPORT_NO_SKELETON_MESHES,
                                    true); // otherwise Assimp draws the nodes of a scene without meshes as bones
  const ReportedErrors errors;
  const std::unique_ptr<const aiScene, Release> scene(
      assimp().importFile(assimpName.c_str(), aiProcess_ValidateDataStructure, &files.io(), properties.get()));
  const std::string extension = dottedExtension.substr(1);
  std::string format = extension;
  std::ranges::transform(format, format.begin(), [](char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : c; });
  if (!scene) {
    std::string reason = assimp().getErrorString();
    std::ranges::replace(reason, '\n', ' ');
    throw Error(ErrorKind::malformed, name,
                fmt::format("is damaged or no {} file; Assimp, which reads the format, says: {}", format, reason));
  }
  Imported imported = SceneReader(*scene, name, references, options, extension).read(format);
  addAxes(*scene, extension, imported);
  std::vector<std::string> omissions = errors.sentences();
  for (const std::string& refused : files.refused())
    omissions.push_back(fmt::format("Not read: {}.", refused));
  addOmissions(imported.warnings, omissions, options.strict, name);
  return imported;
}

} // namespace

bool isReadByAssimp(const std::string& name) {
  const std::string extension = lastExtensionOf(name);
  return !extension.empty() && assimp().isExtensionSupported(extension.c_str()) == AI_TRUE;
}

Imported readByAssimp(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  return readByAssimp(bytes, name, options, lastExtensionOf(name));
}

Imported readByAssimp(ByteSpan bytes, const std::string& name, const ImportOptions& options,
                      const std::string& extension) {
  refuseZipBomb(bytes, name);
  return readInChildProcess([&] { return readInThisProcess(bytes, name, options, extension); }, name);
}

} // namespace imgeo
