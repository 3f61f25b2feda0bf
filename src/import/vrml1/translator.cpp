#include "import/vrml1/translator.h"

#include "import/vrml/elements.h"
#include "import/vrml1/accumulated_transform.h"
#include "import/vrml1/appearances.h"
#include "import/vrml1/indexed_sets.h"
#include "import/vrml1/info.h"
#include "import/vrml1/lights_and_cameras.h"
#include "import/vrml1/node_types.h"
#include "import/vrml1/shapes.h"
#include "import/vrml1/tree.h"
#include "import/warnings.h"
#include "scene/mf_string.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <set>
#include <utility>

namespace imgeo::vrml1 {

namespace {

using pugi::xml_node;

/// Limits of what nested USEs repeat: nodes beyond those that the text contains, and indices of shapes.
constexpr std::size_t maxRepeatedNodes = 250'000, maxRepeatedIndices = std::size_t{1} << 26;

class Translator {
public:
  Translator(const Tree& tree, const x3d::VrmlTokens& tokens, x3d::VrmlElements& elements, Report& report)
      : tree_(tree), tokens_(tokens), elements_(elements), report_(report), appearances_(elements, report),
        sets_(elements, tokens, appearances_, report), shapes_(elements, appearances_, report) {}

  void translate(xml_node scene) {
    for (const Node& node : tree_.nodes)
      nodesInText_ += node.children.size();
    group_ = scene;
    addSceneInfo(tree_, elements_, scene);
    for (const Node* child : tree_.root().children)
      visit(*child);
    if (isLit_)
      x3d::set(navigationInfoOf(elements_, scene, tree_.root().where), "headlight", "false");
  }

private:
  /// The state that a Separator restores, but for the properties.
  struct Frame {
    xml_node group;                 ///< the element that shapes are added to
    AccumulatedTransform transform; ///< of shapes in the coordinates of `group`
  };

  void visit(const Node& node) {
    countRepetition(node);
    if (const std::optional<Property> property = propertyOf(node.type)) {
      properties_.set(*property, node);
    } else if (isTransform(node.type)) {
      report_.projections += !transform_.apply(node);
    } else if (isShape(node.type)) {
      addShape(node);
    } else if (isLight(node.type)) {
      addLight(node);
    } else if (isCamera(node.type)) {
      addCamera(destination(), node, elements_);
    } else if (node.is("WWWInline")) {
      addInline(node);
    } else if (node.is("Switch")) {
      addSwitch(node);
    } else if (node.is("LOD")) {
      addChoices(node, destination());
    } else if (node.is("Group") || node.is("TransformSeparator")) {
      addGroup(node);
    } else if (node.draws) {
      addSeparator(node);
    }
  }

  /// Counts what USEs repeat, which may grow exponentially with the size of the file.
  void countRepetition(const Node& node) {
    const bool isRepeated = !visited_.insert(&node).second;
    if (isRepeated && isShape(node.type))
      for (const Field& field : node.fields)
        repeatedIndices_ += field.numbers.size();
    if (++visits_ > nodesInText_ + maxRepeatedNodes || repeatedIndices_ > maxRepeatedIndices)
      tokens_.fail(
          node.where, ErrorKind::limit,
          fmt::format("nested USEs repeat more than {} nodes or {} indices", maxRepeatedNodes, maxRepeatedIndices));
  }

  /// The element that nodes under the current transform are added to: a Transform, unless there is none.
  xml_node destination() {
    if (transform_.isIdentity())
      return group_;
    xml_node last = group_.last_child();
    if (const auto found = transforms_.find(last.internal_object());
        last && found != transforms_.end() && found->second == transform_.matrix())
      return last;
    xml_node element = elements_.add(group_, "Transform", tree_.root().where);
    const Transform transform = transform_.transform();
    const auto setRotation = [&](const char* field, const Rotation& rotation) {
      if (rotation.angle != 0)
        x3d::set(element, field, fmt::format("{} {}", textOf(rotation.axis), rotation.angle));
    };
    if (transform.translation != Vec3d{})
      x3d::set(element, "translation", textOf(transform.translation));
    setRotation("rotation", transform.rotation);
    if (transform.scale != Vec3d{1, 1, 1})
      x3d::set(element, "scale", textOf(transform.scale));
    setRotation("scaleOrientation", transform.scaleOrientation);
    if (transform.center != Vec3d{})
      x3d::set(element, "center", textOf(transform.center));
    transforms_[element.internal_object()] = transform_.matrix();
    return element;
  }

  void addShape(const Node& node) {
    if (node.is("IndexedFaceSet") || node.is("IndexedLineSet") || node.is("PointSet"))
      sets_.add(destination(), node, properties_);
    else
      shapes_.add(destination(), node, properties_);
  }

  /// Adds a light, in a group with what follows it where something precedes it: lights do not shine on what precedes
  /// them.
  void addLight(const Node& node) {
    const auto isDrawn = [](const xml_node& child) {
      const std::string_view name = child.name();
      return child.type() == pugi::node_element && !name.ends_with("Light") && !name.ends_with("Viewpoint") &&
             !name.ends_with("Info") && name != "Background";
    };
    if (!node.boolean("on", true))
      return;
    if (std::ranges::any_of(group_.children(), isDrawn))
      group_ = elements_.add(group_, "Group", node.where);
    vrml1::addLight(group_, node, transform_.matrix(), elements_);
    isLit_ = true;
  }

  void addInline(const Node& node) {
    xml_node element = elements_.add(destination(), "Inline", node.where);
    define(element, node);
    x3d::set(element, "url", quoteStrings({node.word("name", "")}));
    if (const Vec3d size = node.vector("bboxSize", {}); size != Vec3d{}) {
      x3d::set(element, "bboxSize", textOf(size));
      x3d::set(element, "bboxCenter", textOf(node.vector("bboxCenter", {})));
    }
  }

  void define(xml_node element, const Node& node) {
    if (!node.name.empty())
      x3d::set(element, "DEF", elements_.define(node.name, element.name()));
  }

  void visitChildren(const Node& node) {
    for (const Node* child : node.children)
      visit(*child);
  }

  /// Visits nodes with `group` as the origin of coordinates, and restores the state afterwards.
  template <typename Visit> void visitWithin(xml_node group, const Visit& visitNodes) {
    const Frame outer{group_, transform_};
    const PropertyNodes outerProperties = properties_.nodes();
    group_ = group;
    transform_ = {};
    visitNodes();
    group_ = outer.group;
    transform_ = outer.transform;
    properties_.restore(outerProperties);
  }

  /// Group and TransformSeparator: their properties and lights also apply to the nodes that follow.
  void addGroup(const Node& node) {
    const AccumulatedTransform outer = transform_;
    if (node.name.empty() || node.lightsSiblings || !node.draws) {
      visitChildren(node);
    } else {
      xml_node element = elements_.add(group_, "Group", node.where);
      const xml_node outerGroup = std::exchange(group_, element);
      define(element, node);
      visitChildren(node);
      group_ = outerGroup;
      simplified(element);
    }
    if (node.is("TransformSeparator"))
      transform_ = outer;
  }

  /// Separator, WWWAnchor, and nodes that VRML 1.0 does not have.
  void addSeparator(const Node& node) {
    xml_node parent = destination();
    if (!node.name.empty() && addUse(node, parent))
      return;
    const PropertyNodes before = properties_.nodes();
    properties_.beginRecord();
    const bool isAnchor = node.is("WWWAnchor");
    xml_node element = elements_.add(parent, isAnchor ? "Anchor" : "Group", node.where);
    define(element, node);
    if (isAnchor) {
      x3d::set(element, "url", quoteStrings({node.word("name", "")}));
      if (node.field("description"))
        x3d::set(element, "description", node.word("description", ""));
      report_.pointMaps += node.word("map", "NONE") == "POINT";
    }
    visitWithin(element, [&] { visitChildren(node); });
    if (!isAnchor)
      element = simplified(element);
    removeIfEmpty(parent);
    const PropertySet read = properties_.endRecord();
    if (!node.name.empty())
      translations_[&node].push_back({element, before, read});
  }

  /// Removes an element. Another element may get its address.
  void remove(xml_node element) {
    transforms_.erase(element.internal_object());
    element.parent().remove_child(element);
  }

  /// Removes an empty group, replaces a group that has no DEF and one child by the child, and merges a group that has a
  /// DEF with the Transform that is its only child. Returns the element that remains, null for none.
  xml_node simplified(xml_node group) {
    xml_node only = group.first_child();
    if (!only) {
      remove(group);
      return {};
    }
    if (only.next_sibling())
      return group;
    xml_node parent = group.parent();
    if (!group.attribute("DEF")) {
      parent.insert_move_before(only, group);
      remove(group);
      return only;
    }
    if (std::string_view(only.name()) == "Transform" && !only.attribute("DEF")) {
      group.set_name("Transform");
      for (const pugi::xml_attribute& attribute : only.attributes())
        group.append_copy(attribute);
      while (xml_node child = only.first_child())
        group.append_move(child);
      remove(only);
    }
    return group;
  }

  /// Removes a Transform whose nodes turned out to draw nothing.
  void removeIfEmpty(xml_node transform) {
    if (transform != group_ && !transform.first_child())
      remove(transform);
  }

  /// Adds a USE of an earlier translation of a node that read the same properties as are current. Returns false where
  /// there is none.
  bool addUse(const Node& node, xml_node parent) {
    const PropertyNodes& now = properties_.nodes();
    for (const Translation& earlier : translations_[&node]) {
      bool isEqual = true;
      for (std::size_t i = 0; i < propertyCount; ++i)
        isEqual &= !earlier.read[i] || earlier.before[i] == now[i];
      if (!isEqual)
        continue;
      properties_.read(earlier.read);
      if (earlier.element)
        x3d::set(elements_.add(parent, earlier.element.name(), node.where), "USE",
                 earlier.element.attribute("DEF").value());
      removeIfEmpty(parent);
      return true;
    }
    return false;
  }

  void addSwitch(const Node& node) {
    const double which = node.real("whichChild", -1);
    const auto count = static_cast<double>(node.children.size());
    const Node* const chosen = which >= 0 && which < count ? node.children[static_cast<std::size_t>(which)] : nullptr;
    const auto isProperty = [](const Node* child) { return !child->draws || isLight(child->type); };
    if (which == -3) {
      addGroup(node);
    } else if (std::ranges::all_of(node.children, isProperty)) {
      if (chosen)
        visit(*chosen);
    } else if (std::ranges::all_of(node.children, [](const Node* child) { return isCamera(child->type); })) {
      if (chosen) // the first is bound
        visit(*chosen);
      for (const Node* child : node.children)
        if (child != chosen)
          visit(*child);
    } else {
      addChoices(node, group_);
    }
  }

  /// Switch and LOD: each child is a choice of its own. The state after a Switch is that after its chosen child.
  void addChoices(const Node& node, xml_node parent) {
    const bool isSwitch = node.is("Switch");
    xml_node element = elements_.add(parent, isSwitch ? "Switch" : "LOD", node.where);
    define(element, node);
    const double which = node.real("whichChild", -1);
    if (isSwitch) {
      x3d::set(element, "whichChoice", fmt::format("{}", static_cast<int>(std::clamp(which, -1.0, 1e9))));
    } else {
      x3d::set(element, "range", fmt::format("{}", fmt::join(node.numbers("range"), " ")));
      if (node.field("center"))
        x3d::set(element, "center", textOf(node.vector("center", {})));
    }
    const Frame outer{group_, transform_};
    const PropertyNodes before = properties_.nodes();
    PropertyNodes after = before;
    AccumulatedTransform transformAfter = transform_;
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      xml_node choice = elements_.add(element, "Group", node.children[i]->where);
      group_ = choice;
      transform_ = isSwitch ? outer.transform : AccumulatedTransform();
      visit(*node.children[i]);
      if (choice.first_child())
        simplified(choice);
      if (isSwitch && static_cast<double>(i) == which) {
        after = properties_.nodes();
        transformAfter = transform_;
      }
      properties_.restore(before);
    }
    group_ = outer.group;
    transform_ = transformAfter;
    properties_.restore(after);
  }

  struct Translation {
    xml_node element;     ///< null where nothing is drawn
    PropertyNodes before; ///< the properties at its beginning
    PropertySet read;     ///< those of them that it reads
  };

  const Tree& tree_;
  const x3d::VrmlTokens& tokens_;
  x3d::VrmlElements& elements_;
  Report& report_;
  Appearances appearances_;
  IndexedSets sets_;
  Shapes shapes_;

  xml_node group_;
  AccumulatedTransform transform_;
  Properties properties_;
  bool isLit_ = false;
  std::map<pugi::xml_node_struct*, Affine3d> transforms_;        ///< the matrices of Transform elements
  std::map<const Node*, std::vector<Translation>> translations_; ///< of named Separators
  std::set<const Node*> visited_;
  std::size_t visits_ = 0, repeatedIndices_ = 0;
  std::size_t nodesInText_ = 0; ///< USEs included
};

} // namespace

x3d::Elements readVrml1(std::string_view text, const std::string& name, bool isStrict) {
  x3d::VrmlTokens tokens(text, name);
  x3d::VrmlElements elements(tokens);
  elements.setFormat("VRML 1.0");
  xml_node x3d = elements.add(elements.top(), "X3D", {});
  x3d::set(x3d, "profile", "Immersive");
  x3d::set(x3d, "version", "4.0");
  xml_node scene = x3d.append_child("Scene");
  std::vector<std::string_view> comments = tokens.takeComments();
  if (!comments.empty()) // the first is the header
    x3d::addComments(scene, {comments.begin() + 1, comments.end()});
  Report report;
  const Tree tree = parseTree(tokens, report);
  Translator(tree, tokens, elements, report).translate(scene);
  x3d::Elements result = elements.take();
  addOmissions(result.warnings, report.omissions, isStrict, name);
  std::ranges::move(report.warnings(), std::back_inserter(result.warnings));
  return result;
}

} // namespace imgeo::vrml1
