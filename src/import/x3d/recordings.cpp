#include "import/x3d/recordings.h"

#include "import/x3d/node_faces.h"

#include <algorithm>
#include <string_view>

namespace imgeo::x3d {

namespace {

/// With more frames for each key, which are mixtures of two keys, text is shorter than a sequence.
constexpr double maxFramesPerKey = 3;

std::string plainField(std::string_view field) {
  if (field.starts_with("set_"))
    field.remove_prefix(4);
  if (field.ends_with("_changed"))
    field.remove_suffix(8);
  return std::string(field);
}

using Names = std::set<std::string, std::less<>>;

void addDefs(Names& defs, pugi::xml_node element) {
  if (const pugi::xml_attribute def = element.attribute("DEF"))
    defs.insert(def.value());
  for (const pugi::xml_node& child : element.children())
    addDefs(defs, child);
}

/// The DEFs of a geometry, of its children or what they USE, and of what is in these.
Names defsIn(const Source& source, pugi::xml_node geometry) {
  Names defs;
  addDefs(defs, geometry);
  for (const pugi::xml_node& child : geometry.children())
    if (child.attribute("USE"))
      addDefs(defs, source.resolved(child));
  return defs;
}

std::size_t keyValueBytesOf(pugi::xml_node interpolator) {
  return std::string_view(interpolator.attribute("keyValue").value()).size();
}

/// An interpolator of the document; without keys where there is none, or where it is malformed: then reading its
/// element gives a warning.
Interpolator interpolatorOf(const Source& source, InterpolatorKind kind, pugi::xml_node element) {
  Interpolator read{kind, {}, {}};
  try {
    const std::vector<double> keys = source.reals(element, "key"), values = source.reals(element, "keyValue");
    read.keys.assign(keys.begin(), keys.end());
    read.values.assign(values.begin(), values.end());
  } catch (const Error&) {
    return {kind, {}, {}};
  }
  return faultOf(read).empty() ? read : Interpolator{kind, {}, {}};
}

} // namespace

Recordings::Recordings(const Source& source, const RecordingChoice& choice) : source_(source), choice_(choice) {
  struct Walker : pugi::xml_tree_walker {
    explicit Walker(Recordings& into) : recordings(into) {}
    bool for_each(pugi::xml_node& node) override {
      const auto end = [&](const char* name, const char* field) {
        return End{node.attribute(name).value(), plainField(node.attribute(field).value())};
      };
      if (std::string_view(node.name()) == "ROUTE")
        recordings.connections_.push_back({end("fromNode", "fromField"), end("toNode", "toField")});
      else if (std::string_view(node.name()) == "EXPORT")
        recordings.exported_.insert(node.attribute("localDEF").value());
      return true;
    }
    Recordings& recordings;
  };
  if (!choice.all && choice.minBytes == RecordingChoice{}.minBytes)
    return;
  Walker walker(*this);
  source.root().traverse(walker);
}

/// The cycle of the TimeSensor that drives an interpolator. Without one a frame is a key.
double Recordings::secondsOf(const std::string& interpolator, const std::vector<float>& keys) const {
  for (const Connection& connection : connections_)
    if (connection.to.node == interpolator && connection.to.field == "fraction")
      if (const pugi::xml_node sensor = source_.defined(connection.from.node);
          std::string_view(sensor.name()) == "TimeSensor") {
        const double seconds = sensor.attribute("cycleInterval").as_double(1);
        return seconds > 0 ? seconds : 1;
      }
  return static_cast<double>(std::max<std::size_t>(keys.size(), 2) - 1) / choice_.rate;
}

bool Recordings::isChosen(const Connection& connection, const Interpolator& interpolator, std::size_t textBytes) const {
  if (choice_.all)
    return true;
  const double steps =
      recordedSteps(interpolator.keys, secondsOf(connection.from.node, interpolator.keys), choice_.rate);
  return textBytes > choice_.minBytes && steps <= maxFramesPerKey * static_cast<double>(interpolator.keys.size());
}

std::optional<MovingVertices> Recordings::of(pugi::xml_node geometry) const {
  const pugi::xml_node coordinate = source_.resolved(geometry.child("Coordinate")),
                       normal = source_.resolved(geometry.child("Normal"));
  const std::string coordinateDef = coordinate.attribute("DEF").value(), normalDef = normal.attribute("DEF").value();
  if (connections_.empty() || coordinateDef.empty() || !becomesMesh(geometry.name()) ||
      source_.pointAttributesOf(geometry) || geometry.attribute("operators"))
    return {};
  const Connection *ofCoordinates = nullptr, *ofNormals = nullptr;
  const Names defs = defsIn(source_, geometry);
  const auto isInside = [&](const std::string& name) { return !name.empty() && defs.contains(name); };
  if (std::ranges::any_of(exported_, isInside))
    return {};
  for (const Connection& connection : connections_) {
    const auto& [from, to] = connection;
    if (isInside(from.node))
      return {};
    if (!isInside(to.node))
      continue;
    const pugi::xml_node sender = source_.defined(from.node);
    const auto kind = from.field == "value" ? interpolatorKindOf(sender.name()) : std::nullopt;
    const Connection*& known = to.node == coordinateDef ? ofCoordinates : ofNormals;
    const bool isCoordinate = kind == InterpolatorKind::coordinate && to.node == coordinateDef && to.field == "point",
               isNormal = kind == InterpolatorKind::normal && to.node == normalDef && to.field == "vector";
    if (!(isCoordinate || isNormal) || (known && known->from.node != from.node))
      return {};
    known = &connection;
  }
  if (!ofCoordinates)
    return {};
  const pugi::xml_node sender = source_.defined(ofCoordinates->from.node),
                       normalSender = ofNormals ? source_.defined(ofNormals->from.node) : pugi::xml_node();
  const std::size_t textBytes = keyValueBytesOf(sender) + keyValueBytesOf(normalSender);
  if (!choice_.all && textBytes <= choice_.minBytes)
    return {};
  MovingVertices moving{ofCoordinates->from.node, ofNormals ? ofNormals->from.node : "",
                        interpolatorOf(source_, InterpolatorKind::coordinate, sender),
                        interpolatorOf(source_, InterpolatorKind::normal, normalSender)};
  const bool isUsable = !moving.coordinates.keys.empty() && (!ofNormals || !moving.normals.keys.empty());
  if (!isUsable || !isChosen(*ofCoordinates, moving.coordinates, textBytes))
    return {};
  return moving;
}

} // namespace imgeo::x3d
