#pragma once
// The elements of nodes that are structs of the scene (NodeContent), without their children.

#include "documents/element_writer.h"
#include "documents/field_reader.h"
#include "scene/scene.h"

#include <optional>

namespace imgeo {

/// `names`: its DEF, if any. An element without a name for a GenericNode.
Element contentElement(const NodeContent& content, const Attributes& names);

/// Reads a viewpoint, a light, a TimeSensor or an interpolator. Nothing for a light that is off.
std::optional<NodeContent> readContent(const FieldReader& fields);

} // namespace imgeo
