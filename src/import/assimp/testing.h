#pragma once
// A document for tests of what Assimp reads.

#include <string>
#include <utility>
#include <vector>

namespace imgeo::testing {

/// A Collada document with two instances of a textured square, a camera and a light.
inline const std::string collada = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
  <library_cameras><camera id="cam" name="door"><optics><technique_common><perspective><xfov>60</xfov>
    <aspect_ratio>1.5</aspect_ratio><znear>0.1</znear><zfar>100</zfar></perspective></technique_common></optics></camera>
  </library_cameras>
  <library_lights><light id="lamp" name="lamp"><technique_common><point><color>1 0.5 0</color></point>
    </technique_common></light></library_lights>
  <library_images><image id="img" name="img"><init_from>wood.png</init_from></image></library_images>
  <library_effects><effect id="fx"><profile_COMMON>
    <newparam sid="s"><surface type="2D"><init_from>img</init_from></surface></newparam>
    <newparam sid="t"><sampler2D><source>s</source></sampler2D></newparam>
    <technique sid="common"><phong><emission><color>0 0 0.5 1</color></emission>
    <diffuse><texture texture="t" texcoord="UV"/></diffuse></phong></technique></profile_COMMON></effect></library_effects>
  <library_materials><material id="oak" name="oak"><instance_effect url="#fx"/></material></library_materials>
  <library_geometries><geometry id="square" name="square"><mesh>
    <source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array><technique_common>
      <accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
      <param name="Z" type="float"/></accessor></technique_common></source>
    <source id="u"><float_array id="ua" count="8">0 0 1 0 1 1 0 1</float_array><technique_common>
      <accessor source="#ua" count="4" stride="2"><param name="S" type="float"/><param name="T" type="float"/></accessor>
      </technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <polylist material="m" count="1"><input semantic="VERTEX" source="#v" offset="0"/>
      <input semantic="TEXCOORD" source="#u" offset="0" set="0"/><vcount>4</vcount><p>0 1 2 3</p></polylist>
    </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="scene" name="hall">
    <node id="a" name="left"><translate>-2 0 0</translate><instance_geometry url="#square"><bind_material>
      <technique_common><instance_material symbol="m" target="#oak"><bind_vertex_input semantic="UV"
      input_semantic="TEXCOORD" input_set="0"/></instance_material></technique_common></bind_material></instance_geometry></node>
    <node id="b" name="right"><translate>2 0 0</translate><instance_geometry url="#square"><bind_material>
      <technique_common><instance_material symbol="m" target="#oak"/></technique_common></bind_material></instance_geometry></node>
    <node id="c" name="eye"><translate>0 0 9</translate><instance_camera url="#cam"/></node>
    <node id="d" name="light"><instance_light url="#lamp"/></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>)";

/// `text` with each of `from` replaced.
inline std::string replaced(std::string text, const std::vector<std::pair<std::string, std::string>>& changes) {
  for (const auto& [from, to] : changes)
    text.replace(text.find(from), from.size(), to);
  return text;
}

} // namespace imgeo::testing
