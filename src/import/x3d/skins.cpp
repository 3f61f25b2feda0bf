#include "import/x3d/skins.h"

#include "import/x3d/element_edits.h"
#include "scene/transform.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <set>

namespace imgeo::x3d {

namespace {

constexpr std::size_t maxJointsOfPoint = 4 * maxJointSets;
/// Weights whose sum is nearer to one than this have lost the rest by rounding.
constexpr double weightTolerance = 1e-3;
constexpr double maxWeight = 1e6;

struct JointWeight {
  std::size_t joint;
  double weight;
};

bool isOfField(pugi::xml_node element, std::string_view field) {
  return element.attribute("containerField").value() == field;
}

class SkinReader {
public:
  SkinReader(pugi::xml_node humanoid, Definitions& definitions, Skins& skins)
      : humanoid_(humanoid), definitions_(definitions), skins_(skins) {}

  bool read() {
    for (const pugi::xml_node& child : elementsOf(humanoid_))
      if (isOfField(child, "skinCoord"))
        coordinate_ = resolved(child);
      else if (isOfField(child, "joints"))
        addJoint(resolved(child));
    const std::vector<pugi::xml_node> geometries = geometriesOfSkin();
    if (joints_.empty() || geometries.empty())
      return false;
    readWeights();
    if (std::ranges::all_of(points_, &std::vector<JointWeight>::empty))
      return false;
    Skin skin = bindings();
    addRest(skin);
    const std::vector<NamedAttribute> attributes = attributesOfPoints();
    for (const pugi::xml_node& geometry : geometries)
      skins_.pointAttributes[geometry.internal_object()] = attributes;
    skins_.groups[groupOfShapes().internal_object()] = std::move(skin);
    return true;
  }

private:
  pugi::xml_node resolved(pugi::xml_node element) const {
    const pugi::xml_attribute use = element.attribute("USE");
    if (!use)
      return element;
    const auto found = definitions_.find(std::string_view(use.value()));
    return found == definitions_.end() ? pugi::xml_node() : found->second;
  }

  void addJoint(pugi::xml_node joint) {
    if (joint && isJoint_.insert(joint.internal_object()).second)
      joints_.push_back(joint);
  }

  /// Geometries of the skin's shapes whose points are those of the humanoid.
  std::vector<pugi::xml_node> geometriesOfSkin() const {
    std::vector<pugi::xml_node> geometries;
    for (const pugi::xml_node& child : elementsOf(humanoid_))
      if (isOfField(child, "skin"))
        addGeometries(child, geometries);
    return geometries;
  }

  void addGeometries(pugi::xml_node element, std::vector<pugi::xml_node>& geometries) const {
    for (const pugi::xml_node& child : elementsOf(element)) {
      const bool isCoordinate = child.name() == std::string_view("Coordinate") && coordinate_;
      if (isCoordinate && resolved(child) == coordinate_)
        geometries.push_back(element);
      addGeometries(child, geometries);
    }
  }

  void fault(pugi::xml_node element, const std::string& message) {
    const std::string def = element.attribute("DEF").value();
    const std::string name = def.empty() ? "" : fmt::format(" \"{}\"", def);
    skins_.faults.push_back({element, fmt::format("{}{}: {}", element.name(), name, message)});
  }

  /// The numbers of a field; none, with a fault, where it holds anything else, which then has no effect.
  std::optional<std::vector<double>> numbersIn(pugi::xml_node element, const char* field) {
    std::optional<std::vector<double>> numbers = parseReals(element.attribute(field).value());
    if (numbers && std::ranges::all_of(*numbers, [](double number) { return std::isfinite(number); }))
      return numbers;
    fault(element, fmt::format("{} holds something that is no number and has no effect", field));
    return {};
  }

  void readWeights() {
    points_.resize(parseReals(coordinate_.attribute("point").value()).value_or(std::vector<double>()).size() / 3);
    for (std::size_t joint = 0; joint < joints_.size(); ++joint)
      readWeightsOf(joint);
    std::size_t trimmed = 0;
    for (std::vector<JointWeight>& point : points_)
      if (point.size() > maxJointsOfPoint) {
        std::ranges::stable_sort(point, std::ranges::greater(), &JointWeight::weight);
        point.resize(maxJointsOfPoint);
        ++trimmed;
      }
    if (trimmed > 0)
      fault(humanoid_, fmt::format("{} of its points have more than {} joints: the largest weights count", trimmed,
                                   maxJointsOfPoint));
  }

  void readWeightsOf(std::size_t joint) {
    pugi::xml_node element = joints_[joint];
    const auto readIndices = numbersIn(element, "skinCoordIndex"), readWeights = numbersIn(element, "skinCoordWeight");
    element.remove_attribute("skinCoordIndex");
    element.remove_attribute("skinCoordWeight");
    if (!readIndices || !readWeights)
      return;
    const std::vector<double>&indices = *readIndices, &weights = *readWeights;
    if (indices.size() != weights.size())
      fault(element,
            fmt::format("skinCoordIndex has {} numbers and skinCoordWeight {}: only the first {} of both count",
                        indices.size(), weights.size(), std::min(indices.size(), weights.size())));
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < std::min(indices.size(), weights.size()); ++i) {
      const bool isPoint =
          indices[i] >= 0 && indices[i] < static_cast<double>(points_.size()) && std::floor(indices[i]) == indices[i];
      if (!isPoint || weights[i] < 0 || weights[i] > maxWeight)
        ++wrong;
      else if (weights[i] > 0)
        addWeight(points_[static_cast<std::size_t>(indices[i])], {joint, weights[i]});
    }
    if (wrong > 0)
      fault(element,
            fmt::format("{} of its points are not among the {} of skinCoord, or have a weight below 0 or above {:.0f}",
                        wrong, points_.size(), maxWeight));
  }

  static void addWeight(std::vector<JointWeight>& point, JointWeight added) {
    if (!point.empty() && point.back().joint == added.joint)
      point.back().weight += added.weight;
    else
      point.push_back(added);
  }

  /// X3D 4: jointBindingPositions, -Rotations and -Scales map the points to each joint. Without them the points were
  /// modelled with all joints at rest.
  Skin bindings() {
    const auto valuesIn = [&](const char* field) {
      return numbersIn(humanoid_, field).value_or(std::vector<double>());
    };
    const std::vector<double> positions = valuesIn("jointBindingPositions"),
                              rotations = valuesIn("jointBindingRotations"), scales = valuesIn("jointBindingScales");
    Skin skin;
    for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
      Transform binding;
      if (const std::size_t i = 3 * joint; i + 3 <= positions.size())
        binding.translation = {positions[i], positions[i + 1], positions[i + 2]};
      if (const std::size_t i = 4 * joint; i + 4 <= rotations.size())
        binding.rotation = {{rotations[i], rotations[i + 1], rotations[i + 2]}, rotations[i + 3]};
      if (const std::size_t i = 3 * joint; i + 3 <= scales.size())
        binding.scale = {scales[i], scales[i + 1], scales[i + 2]};
      skin.joints.push_back(nameOf(joints_[joint]));
      skin.inverseBindings.push_back(affineOf(binding));
    }
    for (const char* field : {"jointBindingPositions", "jointBindingRotations", "jointBindingScales"})
      humanoid_.remove_attribute(field);
    return skin;
  }

  std::string nameOf(pugi::xml_node element) {
    skins_.joints.insert(element.internal_object());
    if (!element.attribute("DEF")) {
      const std::string humanoid = humanoid_.attribute("DEF").as_string("humanoid");
      std::string name;
      for (std::size_t i = 0; name.empty() || definitions_.contains(name); ++i)
        name = fmt::format("{}-joint-{}", humanoid, i);
      element.append_attribute("DEF") = name.c_str();
      definitions_.emplace(name, element);
    }
    return element.attribute("DEF").value();
  }

  /// Adds a joint that stays with the humanoid for points, or parts of their weight, that follow no joint.
  void addRest(Skin& skin) {
    std::optional<std::size_t> rest;
    for (std::vector<JointWeight>& point : points_) {
      double sum = 0;
      for (const JointWeight& each : point)
        sum += each.weight;
      if (sum > 1 - weightTolerance)
        continue;
      if (!rest) {
        rest = skin.joints.size();
        pugi::xml_node joint = humanoid_.append_child("HAnimJoint");
        skin.joints.push_back(nameOf(joint));
        skin.inverseBindings.emplace_back();
      }
      if (point.size() == maxJointsOfPoint) {
        const auto smallest = std::ranges::min_element(point, {}, &JointWeight::weight);
        sum -= smallest->weight;
        point.erase(smallest);
      }
      point.push_back({*rest, 1 - sum});
    }
  }

  std::vector<NamedAttribute> attributesOfPoints() const {
    std::size_t largest = 0;
    for (const std::vector<JointWeight>& point : points_)
      largest = std::max(largest, point.size());
    std::vector<NamedAttribute> attributes;
    for (std::size_t set = 0; 4 * set < largest; ++set) {
      NamedAttribute joints{jointsName(set), 4, {}}, weights{jointWeightsName(set), 4, {}};
      for (const std::vector<JointWeight>& point : points_)
        for (std::size_t i = 4 * set; i < 4 * set + 4; ++i) {
          joints.values.push_back(i < point.size() ? static_cast<float>(point[i].joint) : 0);
          weights.values.push_back(i < point.size() ? static_cast<float>(point[i].weight) : 0);
        }
      attributes.push_back(std::move(joints));
      attributes.push_back(std::move(weights));
    }
    return attributes;
  }

  pugi::xml_node groupOfShapes() {
    pugi::xml_node group = humanoid_.append_child("Group");
    for (pugi::xml_node& child : elementsOf(humanoid_))
      if (isOfField(child, "skin")) {
        group.append_move(child);
        group.last_child().remove_attribute("containerField");
      }
    return group;
  }

  pugi::xml_node humanoid_, coordinate_;
  Definitions& definitions_;
  Skins& skins_;
  std::vector<pugi::xml_node> joints_;
  std::set<pugi::xml_node_struct*> isJoint_;
  std::vector<std::vector<JointWeight>> points_; ///< for each point of the skin its joints
};

} // namespace

bool readSkin(pugi::xml_node humanoid, Definitions& definitions, Skins& skins) {
  return SkinReader(humanoid, definitions, skins).read();
}

} // namespace imgeo::x3d
