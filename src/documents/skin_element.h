#pragma once
// The elements of skins: HAnimHumanoid with its joints.

#include "documents/element_writer.h"
#include "documents/field_reader.h"
#include "scene/skin.h"

namespace imgeo {

/// The field of ours that holds Humanoid::inverseBindings: 16 numbers for each joint, column by column.
inline constexpr const char* inverseBindingsField = "inverseBindMatrices";

/// `names`: its DEF, if any.
Element humanoidElement(const Humanoid& humanoid, const Attributes& names);

/// The element that makes a node a joint of the HAnimHumanoid around it.
Element jointElement(const std::string& name);

/// Whether a child of an HAnimHumanoid is such an element.
bool isJointElement(const FieldReader& fields);

/// Reads the matrices. Throws Error{malformed} unless there is one for each joint.
std::vector<Affine3d> readInverseBindings(const FieldReader& fields, std::size_t jointCount);

} // namespace imgeo
