#include "import/x3d/event_fields.h"

#include "scene/animation.h"

#include <algorithm>
#include <array>
#include <span>

namespace imgeo::x3d {

namespace {

using enum FieldAccess;

struct Row {
  std::string_view element; ///< "": of every node that has no row of its own for the name
  std::string_view field;
  EventField event;
};

/// Nodes all of whose routed fields have rows below.
constexpr std::array<std::string_view, 18> completeNodes{
    "BooleanFilter",  "BooleanSequencer", "BooleanToggle",    "BooleanTrigger", "CylinderSensor", "IntegerSequencer",
    "IntegerTrigger", "PlaneSensor",      "ProximitySensor",  "SphereSensor",   "TimeSensor",     "TimeTrigger",
    "TouchSensor",    "TransformSensor",  "VisibilitySensor", "LoadSensor",     "KeySensor",      "StringSensor"};

/// Fields that nodes of completeNodes, and interpolators, share.
constexpr Row commonRows[] = {
    {"", "metadata", {"SFNode"}},
    {"", "description", {"SFString"}},
    {"", "enabled", {"SFBool"}},
    {"", "isActive", {"SFBool", outputOnly}},
    {"", "isOver", {"SFBool", outputOnly}},
};

constexpr Row fieldRows[] = {
    {"BooleanFilter", "set_boolean", {"SFBool", inputOnly}},
    {"BooleanFilter", "inputFalse", {"SFBool", outputOnly}},
    {"BooleanFilter", "inputNegate", {"SFBool", outputOnly}},
    {"BooleanFilter", "inputTrue", {"SFBool", outputOnly}},
    {"BooleanSequencer", "next", {"SFBool", inputOnly}},
    {"BooleanSequencer", "previous", {"SFBool", inputOnly}},
    {"BooleanSequencer", "set_fraction", {"SFFloat", inputOnly}},
    {"BooleanSequencer", "key", {"MFFloat"}},
    {"BooleanSequencer", "keyValue", {"MFBool"}},
    {"BooleanSequencer", "value_changed", {"SFBool", outputOnly}},
    {"BooleanToggle", "set_boolean", {"SFBool", inputOnly}},
    {"BooleanToggle", "toggle", {"SFBool"}},
    {"BooleanTrigger", "set_triggerTime", {"SFTime", inputOnly}},
    {"BooleanTrigger", "triggerTrue", {"SFBool", outputOnly}},
    {"Coordinate", "point", {"MFVec3f"}},
    {"Color", "color", {"MFColor"}},
    {"ColorRGBA", "color", {"MFColorRGBA"}},
    {"CylinderSensor", "autoOffset", {"SFBool"}},
    {"CylinderSensor", "axisRotation", {"SFRotation"}},
    {"CylinderSensor", "diskAngle", {"SFFloat"}},
    {"CylinderSensor", "maxAngle", {"SFFloat"}},
    {"CylinderSensor", "minAngle", {"SFFloat"}},
    {"CylinderSensor", "offset", {"SFFloat"}},
    {"CylinderSensor", "rotation_changed", {"SFRotation", outputOnly}},
    {"CylinderSensor", "trackPoint_changed", {"SFVec3f", outputOnly}},
    {"IntegerSequencer", "next", {"SFBool", inputOnly}},
    {"IntegerSequencer", "previous", {"SFBool", inputOnly}},
    {"IntegerSequencer", "set_fraction", {"SFFloat", inputOnly}},
    {"IntegerSequencer", "key", {"MFFloat"}},
    {"IntegerSequencer", "keyValue", {"MFInt32"}},
    {"IntegerSequencer", "value_changed", {"SFInt32", outputOnly}},
    {"IntegerTrigger", "set_boolean", {"SFBool", inputOnly}},
    {"IntegerTrigger", "integerKey", {"SFInt32"}},
    {"IntegerTrigger", "triggerValue", {"SFInt32", outputOnly}},
    {"KeySensor", "actionKeyPress", {"SFInt32", outputOnly}},
    {"KeySensor", "actionKeyRelease", {"SFInt32", outputOnly}},
    {"KeySensor", "altKey", {"SFBool", outputOnly}},
    {"KeySensor", "controlKey", {"SFBool", outputOnly}},
    {"KeySensor", "keyPress", {"SFString", outputOnly}},
    {"KeySensor", "keyRelease", {"SFString", outputOnly}},
    {"KeySensor", "shiftKey", {"SFBool", outputOnly}},
    {"LoadSensor", "children", {"MFNode"}},
    {"LoadSensor", "timeOut", {"SFTime"}},
    {"LoadSensor", "isLoaded", {"SFBool", outputOnly}},
    {"LoadSensor", "loadTime", {"SFTime", outputOnly}},
    {"LoadSensor", "progress", {"SFFloat", outputOnly}},
    {"Normal", "vector", {"MFVec3f"}},
    {"OrthoViewpoint", "fieldOfView", {"MFFloat"}},
    {"PlaneSensor", "autoOffset", {"SFBool"}},
    {"PlaneSensor", "axisRotation", {"SFRotation"}},
    {"PlaneSensor", "maxPosition", {"SFVec2f"}},
    {"PlaneSensor", "minPosition", {"SFVec2f"}},
    {"PlaneSensor", "offset", {"SFVec3f"}},
    {"PlaneSensor", "trackPoint_changed", {"SFVec3f", outputOnly}},
    {"PlaneSensor", "translation_changed", {"SFVec3f", outputOnly}},
    {"ProximitySensor", "center", {"SFVec3f"}},
    {"ProximitySensor", "size", {"SFVec3f"}},
    {"ProximitySensor", "centerOfRotation_changed", {"SFVec3f", outputOnly}},
    {"ProximitySensor", "enterTime", {"SFTime", outputOnly}},
    {"ProximitySensor", "exitTime", {"SFTime", outputOnly}},
    {"ProximitySensor", "orientation_changed", {"SFRotation", outputOnly}},
    {"ProximitySensor", "position_changed", {"SFVec3f", outputOnly}},
    {"SphereSensor", "autoOffset", {"SFBool"}},
    {"SphereSensor", "offset", {"SFRotation"}},
    {"SphereSensor", "rotation_changed", {"SFRotation", outputOnly}},
    {"SphereSensor", "trackPoint_changed", {"SFVec3f", outputOnly}},
    {"StringSensor", "deletionAllowed", {"SFBool"}},
    {"StringSensor", "enteredText", {"SFString", outputOnly}},
    {"StringSensor", "finalText", {"SFString", outputOnly}},
    {"TextureCoordinate", "point", {"MFVec2f"}},
    {"TextureTransform", "center", {"SFVec2f"}},
    {"TextureTransform", "rotation", {"SFFloat"}},
    {"TextureTransform", "scale", {"SFVec2f"}},
    {"TextureTransform", "translation", {"SFVec2f"}},
    {"TimeSensor", "cycleInterval", {"SFTime"}},
    {"TimeSensor", "loop", {"SFBool"}},
    {"TimeSensor", "pauseTime", {"SFTime"}},
    {"TimeSensor", "resumeTime", {"SFTime"}},
    {"TimeSensor", "startTime", {"SFTime"}},
    {"TimeSensor", "stopTime", {"SFTime"}},
    {"TimeSensor", "cycleTime", {"SFTime", outputOnly}},
    {"TimeSensor", "elapsedTime", {"SFTime", outputOnly}},
    {"TimeSensor", "fraction_changed", {"SFFloat", outputOnly}},
    {"TimeSensor", "isPaused", {"SFBool", outputOnly}},
    {"TimeSensor", "set_fraction", {"SFFloat", inputOnly}}, // ours, as X3DOM has it
    {"TimeSensor", "time", {"SFTime", outputOnly}},
    {"TimeTrigger", "set_boolean", {"SFBool", inputOnly}},
    {"TimeTrigger", "triggerTime", {"SFTime", outputOnly}},
    {"TouchSensor", "hitNormal_changed", {"SFVec3f", outputOnly}},
    {"TouchSensor", "hitPoint_changed", {"SFVec3f", outputOnly}},
    {"TouchSensor", "hitTexCoord_changed", {"SFVec2f", outputOnly}},
    {"TouchSensor", "touchTime", {"SFTime", outputOnly}},
    {"TransformSensor", "center", {"SFVec3f"}},
    {"TransformSensor", "size", {"SFVec3f"}},
    {"TransformSensor", "targetObject", {"SFNode"}},
    {"TransformSensor", "enterTime", {"SFTime", outputOnly}},
    {"TransformSensor", "exitTime", {"SFTime", outputOnly}},
    {"TransformSensor", "orientation_changed", {"SFRotation", outputOnly}},
    {"TransformSensor", "position_changed", {"SFVec3f", outputOnly}},
    {"VisibilitySensor", "center", {"SFVec3f"}},
    {"VisibilitySensor", "size", {"SFVec3f"}},
    {"VisibilitySensor", "enterTime", {"SFTime", outputOnly}},
    {"VisibilitySensor", "exitTime", {"SFTime", outputOnly}},
};

/// Fields whose type is the same in all nodes without a row of their own.
constexpr Row otherRows[] = {
    {"", "ambientIntensity", {"SFFloat"}},
    {"", "attenuation", {"SFVec3f"}},
    {"", "baseColor", {"SFColor"}},
    {"", "beamWidth", {"SFFloat"}},
    {"", "bindTime", {"SFTime", outputOnly}},
    {"", "center", {"SFVec3f"}},
    {"", "centerOfRotation", {"SFVec3f"}},
    {"", "cutOffAngle", {"SFFloat"}},
    {"", "diffuseColor", {"SFColor"}},
    {"", "direction", {"SFVec3f"}},
    {"", "emissiveColor", {"SFColor"}},
    {"", "fieldOfView", {"SFFloat"}},
    {"", "intensity", {"SFFloat"}},
    {"", "isBound", {"SFBool", outputOnly}},
    {"", "location", {"SFVec3f"}},
    {"", "metallic", {"SFFloat"}},
    {"", "on", {"SFBool"}},
    {"", "orientation", {"SFRotation"}},
    {"", "position", {"SFVec3f"}},
    {"", "rotation", {"SFRotation"}},
    {"", "roughness", {"SFFloat"}},
    {"", "scale", {"SFVec3f"}},
    {"", "scaleOrientation", {"SFRotation"}},
    {"", "set_bind", {"SFBool", inputOnly}},
    {"", "shininess", {"SFFloat"}},
    {"", "specularColor", {"SFColor"}},
    {"", "translation", {"SFVec3f"}},
    {"", "transparency", {"SFFloat"}},
    {"", "visible", {"SFBool"}},
    {"", "whichChoice", {"SFInt32"}},
};

std::optional<EventField> find(std::span<const Row> rows, std::string_view element, std::string_view field) {
  for (const Row& row : rows) {
    if (row.element != element)
      continue;
    if (row.field == field)
      return row.event;
    const bool isSet = field.starts_with("set_") && field.substr(4) == row.field,
               isChanged = field.ends_with("_changed") && field.substr(0, field.size() - 8) == row.field;
    if (row.event.access == inputOutput && (isSet || isChanged))
      return EventField{row.event.type, isSet ? inputOnly : outputOnly};
  }
  return std::nullopt;
}

/// The type of an interpolator's events.
std::string_view valueTypeOf(InterpolatorKind kind) {
  switch (kind) {
  case InterpolatorKind::color:
    return "SFColor";
  case InterpolatorKind::coordinate:
  case InterpolatorKind::normal:
    return "MFVec3f";
  case InterpolatorKind::coordinate2D:
    return "MFVec2f";
  case InterpolatorKind::orientation:
    return "SFRotation";
  case InterpolatorKind::position:
    return "SFVec3f";
  case InterpolatorKind::position2D:
    return "SFVec2f";
  case InterpolatorKind::scalar:
    break;
  }
  return "SFFloat";
}

std::optional<EventField> interpolatorField(InterpolatorKind kind, std::string_view field) {
  if (field == "set_fraction")
    return EventField{"SFFloat", inputOnly};
  if (field == "value_changed")
    return EventField{valueTypeOf(kind), outputOnly};
  if (field.find("key") != field.npos) // key and keyValue, with set_ and _changed
    return EventField{};
  return std::nullopt;
}

} // namespace

std::optional<EventField> eventField(std::string_view element, std::string_view field) {
  if (const std::optional<InterpolatorKind> kind = interpolatorKindOf(element))
    if (const std::optional<EventField> found = interpolatorField(*kind, field))
      return found;
  if (const std::optional<EventField> found = find(fieldRows, element, field))
    return found;
  if (interpolatorKindOf(element) || std::ranges::find(completeNodes, element) != completeNodes.end())
    return find(commonRows, "", field);
  const std::optional<EventField> found = find(otherRows, "", field);
  return found ? found : EventField{};
}

} // namespace imgeo::x3d
