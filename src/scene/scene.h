#pragma once
// A scene: what import makes and documents write. Plain data after X3D's scene
// graph (ISO/IEC 19775-1), with X3D's defaults.
//
// Nodes refer to one another by index. A node may be the child of several others:
// it then stands in several places, and documents write it once and USE it
// elsewhere. The graph has no cycles.

#include "scene/appearance.h"
#include "scene/lights.h"
#include "scene/mesh.h"
#include "scene/transform.h"
#include "scene/viewpoint.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace imgeo {

/// X3D Group: children, and nothing else.
struct Group {
  friend bool operator==(const Group&, const Group&) = default;
};

/// One visible thing: a mesh and what it looks like.
struct Shape {
  std::size_t mesh = 0;                  ///< index into Scene::meshes
  std::optional<std::size_t> appearance; ///< index into SceneGraph::appearances; absent: the source says nothing
  bool solid = true;                     ///< false: its triangles are seen from both sides
  friend bool operator==(const Shape&, const Shape&) = default;
};

/// An attribute of an element of X3D, as its source has it.
struct FieldText {
  std::string name, value;
  friend bool operator==(const FieldText&, const FieldText&) = default;
};

/// GenericNode::element of a comment.
inline constexpr const char* commentElement = "#comment";

/// An element of X3D that goes through as it is: its attributes are Node::fields,
/// what stands in it is Node::children. A comment likewise, which is its text alone.
struct GenericNode {
  std::string element;
  std::string text;                 ///< its character data: a Script's
  std::optional<std::size_t> image; ///< index into SceneGraph::images: what its url leads to
  /// Of an Inline, index into SceneGraph::inlined: the document that its url leads to,
  /// whose top nodes are Node::children.
  std::optional<std::size_t> document = {};
  friend bool operator==(const GenericNode&, const GenericNode&) = default;
};

using NodeContent = std::variant<Group, Transform, Shape, Viewpoint, OrthoViewpoint, DirectionalLight, PointLight,
                                 SpotLight, GenericNode>;

struct Node {
  std::string name; ///< becomes its DEF; of several nodes of one name the later get a number
  NodeContent content;
  std::vector<std::size_t> children;  ///< indices into SceneGraph::nodes; of Shapes those of X3D sources
  std::string extras;                 ///< what the source's author has added, as JSON; may be empty
  std::vector<FieldText> fields = {}; ///< further attributes of its element in an X3D source
  friend bool operator==(const Node&, const Node&) = default;
};

/// X3D Background: one colour.
struct Background {
  Vec3f skyColor;
  friend bool operator==(const Background&, const Background&) = default;
};

/// What an X3D document says of itself.
struct DocumentHead {
  std::vector<FieldText> fields;   ///< of <X3D>: its profile, its version
  std::vector<std::size_t> header; ///< the nodes of its <head>: indices into SceneGraph::nodes
  friend bool operator==(const DocumentHead&, const DocumentHead&) = default;
};

/// A document that Inlines of another show.
struct InlinedDocument {
  std::string url; ///< where it is written; empty until it is
  DocumentHead head;
  friend bool operator==(const InlinedDocument&, const InlinedDocument&) = default;
};

/// Everything of a scene but its meshes.
struct SceneGraph {
  std::string title;
  std::vector<std::string> info; ///< X3D WorldInfo: who made the source, whose it is
  std::vector<Node> nodes;
  std::vector<std::size_t> roots;       ///< indices into `nodes`, in document order
  DocumentHead head;                    ///< of an X3D source
  std::vector<InlinedDocument> inlined; ///< each shown by Inlines of one document alone
  std::vector<Appearance> appearances;
  std::vector<Texture> textures;
  std::vector<ImageFile> images;
  std::optional<Background> background;
  bool headlight = true; ///< X3D NavigationInfo
  /// An X3D document: what it lacks it lacks on purpose, and nothing is added to it.
  bool isComplete = false;
  friend bool operator==(const SceneGraph&, const SceneGraph&) = default;
};

struct Scene {
  SceneGraph graph;
  std::vector<Mesh> meshes;
};

/// Appends a node and returns its index; nothing refers to it yet.
std::size_t addNode(SceneGraph& graph, Node node);
/// The same for a node that stands at the top.
std::size_t addRoot(SceneGraph& graph, Node node);

/// Whether a node is an Inline whose document is part of the scene.
bool inlinesDocument(const Node& node);
/// The document of one that is.
const InlinedDocument& inlinedDocumentOf(const SceneGraph& graph, std::size_t node);

/// The nodes below the roots, each once, parents before children, in the order in
/// which a document first mentions them.
std::vector<std::size_t> nodesInOrder(const SceneGraph& graph);

/// The same of one document whose top nodes are `roots`, without what its Inlines show.
std::vector<std::size_t> nodesOfDocument(const SceneGraph& graph, const std::vector<std::size_t>& roots);

/// Moves the nodes, looks, images and inlined documents of `more` behind those of
/// `graph`, and adds `meshesBefore` to the meshes of its shapes. Returns its roots,
/// which stand nowhere yet.
std::vector<std::size_t> append(SceneGraph& graph, SceneGraph&& more, std::size_t meshesBefore);

/// The indices of all Shape nodes in that order.
std::vector<std::size_t> shapeNodes(const SceneGraph& graph);

/// The Shape of a node that is one.
const Shape& shapeOf(const SceneGraph& graph, std::size_t node);

/// Takes the Shape nodes of some meshes out of the graph; `isLeftOut` is by mesh.
void removeShapes(SceneGraph& graph, const std::vector<bool>& isLeftOut);

} // namespace imgeo
