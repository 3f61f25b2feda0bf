#pragma once
// The fields of the nodes that a scene holds as structs, for the writer and the reader: their X3D names, in the order
// in which they are written. The default of a field is the default of the struct's member.
//
// A visitor is called with the name and the member, and whether the field is written even if it has its default. Its
// line() begins a new group of attributes (Element::groups).

#include "scene/scene.h"

#include <type_traits>

namespace imgeo {

enum class Written : std::uint8_t { unlessDefault, always };

template <typename Visit> void visitFieldsOf(const Transform*, auto& transform, Visit&& visit) {
  visit("translation", transform.translation);
  visit("rotation", transform.rotation);
  visit("scale", transform.scale);
  visit("scaleOrientation", transform.scaleOrientation);
  visit("center", transform.center);
}

template <typename Visit> void visitFieldsOf(const Viewpoint*, auto& viewpoint, Visit&& visit) {
  visit("description", viewpoint.description);
  visit.line();
  visit("position", viewpoint.position, Written::always);
  visit("orientation", viewpoint.orientation, Written::always);
  visit.line();
  visit("fieldOfView", viewpoint.fieldOfView, Written::always);
  visit("centerOfRotation", viewpoint.centerOfRotation, Written::always);
}

/// All fields except fieldOfView, which the struct holds as two members.
template <typename Visit> void visitFieldsOf(const OrthoViewpoint*, auto& viewpoint, Visit&& visit) {
  visit("description", viewpoint.description);
  visit.line();
  visit("position", viewpoint.position, Written::always);
  visit("orientation", viewpoint.orientation, Written::always);
  visit.line();
  visit("centerOfRotation", viewpoint.centerOfRotation, Written::always);
}

template <typename Visit> void visitFieldsOf(const DirectionalLight*, auto& light, Visit&& visit) {
  visit("direction", light.direction, Written::always);
  visit("color", light.color, Written::always);
  visit("intensity", light.intensity, Written::always);
  visit("ambientIntensity", light.ambientIntensity);
  visit("global", light.global);
}

template <typename Visit> void visitFieldsOf(const PointLight*, auto& light, Visit&& visit) {
  visit("location", light.location, Written::always);
  visit("color", light.color, Written::always);
  visit("intensity", light.intensity, Written::always);
  visit("ambientIntensity", light.ambientIntensity);
  visit("attenuation", light.attenuation);
  visit("radius", light.radius);
  visit("global", light.global);
}

template <typename Visit> void visitFieldsOf(const SpotLight*, auto& light, Visit&& visit) {
  visit("location", light.location, Written::always);
  visit("direction", light.direction, Written::always);
  visit("beamWidth", light.beamWidth);
  visit("cutOffAngle", light.cutOffAngle);
  visit("color", light.color, Written::always);
  visit("intensity", light.intensity, Written::always);
  visit("ambientIntensity", light.ambientIntensity);
  visit("attenuation", light.attenuation);
  visit("radius", light.radius);
  visit("global", light.global);
}

template <typename Visit> void visitFieldsOf(const TimeSensor*, auto& sensor, Visit&& visit) {
  visit("cycleInterval", sensor.cycleInterval, Written::always);
  visit("enabled", sensor.enabled);
  visit("loop", sensor.loop);
  visit("startTime", sensor.startTime);
  visit("stopTime", sensor.stopTime);
  visit("pauseTime", sensor.pauseTime);
  visit("resumeTime", sensor.resumeTime);
}

template <typename Visit> void visitFieldsOf(const Displacer*, auto& displacer, Visit&& visit) {
  visit("name", displacer.name);
  visit("weight", displacer.weight);
}

template <typename Visit> void visitFieldsOf(const Material*, auto& material, Visit&& visit) {
  visit("diffuseColor", material.diffuseColor, Written::always);
  visit("specularColor", material.specularColor);
  visit("emissiveColor", material.emissiveColor);
  visit("ambientIntensity", material.ambientIntensity);
  visit("shininess", material.shininess);
  visit("transparency", material.transparency);
}

template <typename Visit> void visitFieldsOf(const PhysicalMaterial*, auto& material, Visit&& visit) {
  visit("baseColor", material.baseColor, Written::always);
  visit("metallic", material.metallic, Written::always);
  visit("roughness", material.roughness, Written::always);
  visit("emissiveColor", material.emissiveColor);
  visit("normalScale", material.normalScale);
  visit("occlusionStrength", material.occlusionStrength);
  visit("transparency", material.transparency);
}

template <typename Visit> void visitFieldsOf(const AnisotropyMaterialExtension*, auto& extension, Visit&& visit) {
  visit("anisotropyStrength", extension.anisotropyStrength);
  visit("anisotropyRotation", extension.anisotropyRotation);
}

template <typename Visit> void visitFieldsOf(const ClearcoatMaterialExtension*, auto& extension, Visit&& visit) {
  visit("clearcoat", extension.clearcoat);
  visit("clearcoatRoughness", extension.clearcoatRoughness);
}

template <typename Visit> void visitFieldsOf(const DispersionMaterialExtension*, auto& extension, Visit&& visit) {
  visit("dispersion", extension.dispersion);
}

template <typename Visit> void visitFieldsOf(const EmissiveStrengthMaterialExtension*, auto& extension, Visit&& visit) {
  visit("emissiveStrength", extension.emissiveStrength);
}

template <typename Visit> void visitFieldsOf(const IORMaterialExtension*, auto& extension, Visit&& visit) {
  visit("indexOfRefraction", extension.indexOfRefraction);
}

template <typename Visit> void visitFieldsOf(const IridescenceMaterialExtension*, auto& extension, Visit&& visit) {
  visit("iridescence", extension.iridescence);
  visit("iridescenceIndexOfRefraction", extension.iridescenceIndexOfRefraction);
  visit("iridescenceThicknessMinimum", extension.iridescenceThicknessMinimum);
  visit("iridescenceThicknessMaximum", extension.iridescenceThicknessMaximum);
}

template <typename Visit> void visitFieldsOf(const SheenMaterialExtension*, auto& extension, Visit&& visit) {
  visit("sheenColor", extension.sheenColor);
  visit("sheenRoughness", extension.sheenRoughness);
}

template <typename Visit> void visitFieldsOf(const SpecularMaterialExtension*, auto& extension, Visit&& visit) {
  visit("specular", extension.specular);
  visit("specularColor", extension.specularColor);
}

template <typename Visit> void visitFieldsOf(const TransmissionMaterialExtension*, auto& extension, Visit&& visit) {
  visit("transmission", extension.transmission);
}

template <typename Visit> void visitFieldsOf(const VolumeMaterialExtension*, auto& extension, Visit&& visit) {
  visit("thickness", extension.thickness);
  visit("attenuationDistance", extension.attenuationDistance);
  visit("attenuationColor", extension.attenuationColor);
}

template <typename Visit> void visitFieldsOf(const UnlitMaterial*, auto& material, Visit&& visit) {
  visit("emissiveColor", material.emissiveColor, Written::always);
  visit("transparency", material.transparency);
}

template <typename Visit> void visitFieldsOf(const TextureTransform*, auto& transform, Visit&& visit) {
  visit("translation", transform.translation);
  visit("rotation", transform.rotation);
  visit("scale", transform.scale);
  visit("center", transform.center);
}

/// Visits the fields of `node`, which may be const.
template <typename Node, typename Visit> void visitFields(Node&& node, Visit&& visit) {
  visitFieldsOf(static_cast<const std::remove_cvref_t<Node>*>(nullptr), node, visit);
}

} // namespace imgeo
