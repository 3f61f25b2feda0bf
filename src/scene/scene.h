#pragma once
// The scene: X3D's scene graph (ISO/IEC 19775-1) as plain data, with X3D's defaults. Importers produce it, and
// documents store it.
//
// Nodes refer to one another by index. A node may be the child of several others (instancing): documents write it once
// with a DEF, and a USE for each further parent. The graph has no cycles.

#include "scene/animation.h"
#include "scene/appearance.h"
#include "scene/lights.h"
#include "scene/mesh.h"
#include "scene/skin.h"
#include "scene/transform.h"
#include "scene/viewpoint.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace imgeo {

/// X3D Group: children without fields.
struct Group {
  friend bool operator==(const Group&, const Group&) = default;
};

/// X3D Shape: a mesh with an appearance.
struct Shape {
  std::size_t mesh = 0;                  ///< index into Scene::meshes
  std::optional<std::size_t> appearance; ///< index into SceneGraph::appearances; absent: the source has none
  bool solid = true;                     ///< false: its triangles are visible from both sides
  /// For a shape whose vertices move: a box around it in all animations; empty for other shapes.
  Box3d movingBox = {};
  friend bool operator==(const Shape&, const Shape&) = default;
};

/// An attribute of an X3D element, as text.
struct FieldText {
  std::string name, value;
  friend bool operator==(const FieldText&, const FieldText&) = default;
};

/// Value of GenericNode::element for a comment.
inline constexpr const char* commentElement = "#comment";

/// The image that a field of a generic node names.
struct FieldImage {
  std::string field;     ///< one of imageFieldsOf() the element
  std::size_t image = 0; ///< index into SceneGraph::images
  friend bool operator==(const FieldImage&, const FieldImage&) = default;
};

/// An X3D element that is written as it was read, without interpretation: its attributes are Node::fields, its child
/// elements are Node::children. A comment has commentElement as its element, and otherwise only a text.
struct GenericNode {
  std::string element;
  std::string text;               ///< its character data, such as the source code of a Script
  std::vector<FieldImage> images; ///< the images that belong to the scene, at most one for each field
  /// For an Inline, index into SceneGraph::inlined: the document at its url, whose top nodes are Node::children.
  std::optional<std::size_t> document = {};
  friend bool operator==(const GenericNode&, const GenericNode&) = default;
};

using NodeContent = std::variant<Group, Transform, Shape, Viewpoint, OrthoViewpoint, DirectionalLight, PointLight,
                                 SpotLight, TimeSensor, Interpolator, Humanoid, Displacer, GenericNode>;

struct Node {
  std::string name; ///< becomes its DEF; if several nodes have the same name, a number is appended to the later ones
  NodeContent content;
  std::vector<std::size_t> children;  ///< indices into SceneGraph::nodes; Shapes of X3D sources may have some
  std::string extras;                 ///< the source author's own data (glTF's extras), as JSON; may be empty
  std::vector<FieldText> fields = {}; ///< further attributes of its element in an X3D source
  friend bool operator==(const Node&, const Node&) = default;
};

/// X3D Background: one colour.
struct Background {
  Vec3f skyColor;
  friend bool operator==(const Background&, const Background&) = default;
};

/// Attributes of the X3D element, and the content of its head.
struct DocumentHead {
  std::vector<FieldText> fields;   ///< of <X3D>, such as profile and version
  std::vector<std::size_t> header; ///< the nodes of its <head>: indices into SceneGraph::nodes
  friend bool operator==(const DocumentHead&, const DocumentHead&) = default;
};

/// A document that Inlines of another document refer to.
struct InlinedDocument {
  std::string url; ///< of the written file; empty until it is written
  DocumentHead head;
  friend bool operator==(const InlinedDocument&, const InlinedDocument&) = default;
};

/// A scene without its meshes.
struct SceneGraph {
  std::string title;
  std::vector<std::string> info; ///< X3D WorldInfo: author and rights of the source
  std::vector<Node> nodes;
  std::vector<std::size_t> roots;       ///< indices into `nodes`, in document order
  std::vector<Route> routes;            ///< in the order in which documents write them
  DocumentHead head;                    ///< for X3D sources
  std::vector<InlinedDocument> inlined; ///< each is referred to by Inlines of one document only
  std::vector<Appearance> appearances;
  std::vector<Texture> textures;
  std::vector<ImageFile> images;
  std::optional<Background> background;
  bool headlight = true; ///< X3D NavigationInfo
  /// True for X3D sources: no default viewpoint, light or material is added.
  bool isComplete = false;
  friend bool operator==(const SceneGraph&, const SceneGraph&) = default;
};

struct Scene {
  SceneGraph graph;
  std::vector<Mesh> meshes;
};

/// The fields of an X3D element whose URLs name images: `url` of an ImageTexture, `frontUrl` of a Background ...
std::span<const std::string_view> imageFieldsOf(std::string_view element);

/// Whether a node is an interpolator that has the frames of a sequence.
bool hasFrames(const Node& node);

/// Appends a node and returns its index. No node refers to it yet.
std::size_t addNode(SceneGraph& graph, Node node);
/// Appends a root node and returns its index.
std::size_t addRoot(SceneGraph& graph, Node node);

/// Whether a node is an Inline whose document is in the scene.
bool inlinesDocument(const Node& node);
/// The document of a node for which inlinesDocument() is true.
const InlinedDocument& inlinedDocumentOf(const SceneGraph& graph, std::size_t node);

/// All nodes that are reachable from the roots, each once, in document order (depth first, parents before children).
std::vector<std::size_t> nodesInOrder(const SceneGraph& graph);

/// All nodes that are reachable from `roots`, the top nodes of a document, in the same order, without the documents of
/// its Inlines.
std::vector<std::size_t> nodesOfDocument(const SceneGraph& graph, const std::vector<std::size_t>& roots);

/// Appends the nodes, appearances, textures, images and inlined documents of `more` to those of `graph`, and adds
/// `firstMesh` to the mesh indices of the appended shapes. Returns the new indices of the roots of `more`, which have
/// no parent yet. Leaves its head in `more`, with new indices, for the caller to store.
std::vector<std::size_t> append(SceneGraph& graph, SceneGraph&& more, std::size_t firstMesh);

/// The number of nodes of a kind that are reachable from the roots, each counted once.
template <typename Content> std::size_t countNodes(const SceneGraph& graph) {
  std::size_t count = 0;
  for (const std::size_t node : nodesInOrder(graph))
    count += std::holds_alternative<Content>(graph.nodes[node].content);
  return count;
}

/// The indices of all Shape nodes in document order.
std::vector<std::size_t> shapeNodes(const SceneGraph& graph);

/// The Shape of a Shape node.
const Shape& shapeOf(const SceneGraph& graph, std::size_t node);

/// Removes Shape nodes from their parents if `isLeftOut`, which is indexed by mesh, is true for their mesh.
void removeShapes(SceneGraph& graph, const std::vector<bool>& isLeftOut);

} // namespace imgeo
