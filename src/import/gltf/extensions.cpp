#include "import/gltf/extensions.h"

#include <algorithm>
#include <array>

namespace imgeo::gltf {

namespace {

using enum ExtensionTreatment;
using enum ExtensionStatus;

// Clauses that several extensions share.
constexpr std::string_view noAnimation = "only transforms of nodes are animated", noSound = "pages play no sound",
                           noPhysics = "pages simulate no physics", noBehaviour = "pages run no behaviour of the file",
                           noVideo = "pages play no media that change with time",
                           noSurroundings = "surroundings that light the model are left out",
                           noProcedures = "textures that are computed are left out",
                           noSplats = "the splats are drawn as points",
                           otherMaterial = "the material is drawn without it";

constexpr ExtensionRow rows[] = {
    {"KHR_accessor_float64", draft, refused, "imgeo does not read numbers of 64 bits"},
    {"KHR_animation_pointer", ratified, approximated, noAnimation},
    {"KHR_audio_emitter", draft, metadata, noSound},
    {"KHR_audio_graph", draft, metadata, noSound},
    {"KHR_binary_glTF", archived, refused, "belongs to glTF 1.0"},
    {"KHR_collision_shapes", draft, metadata, "shapes for physics are not drawn"},
    {"KHR_draco_mesh_compression", ratified, drawn, "decoded by the Draco library"},
    {"KHR_gaussian_splatting", ratified, approximated, noSplats},
    {"KHR_gaussian_splatting_compression_spz", draft, refused, "imgeo has no decoder for SPZ"},
    {"KHR_gaussian_splatting_compression_spz_2", draft, refused, "imgeo has no decoder for SPZ"},
    {"KHR_implicit_shapes", draft, metadata, "shapes for physics are not drawn"},
    {"KHR_interactivity", ratified, metadata, noBehaviour},
    {"KHR_lights_environment", draft, approximated, noSurroundings},
    {"KHR_lights_punctual", ratified, drawn, "DirectionalLight, PointLight, SpotLight"},
    {"KHR_materials_anisotropy", ratified, drawn, "AnisotropyMaterialExtension"},
    {"KHR_materials_clearcoat", ratified, drawn, "ClearcoatMaterialExtension"},
    {"KHR_materials_common", archived, refused, "belongs to glTF 1.0"},
    {"KHR_materials_diffuse_transmission", draft, approximated, otherMaterial},
    {"KHR_materials_dispersion", ratified, drawn, "DispersionMaterialExtension"},
    {"KHR_materials_emissive_strength", ratified, drawn, "EmissiveStrengthMaterialExtension"},
    {"KHR_materials_ior", ratified, drawn, "IORMaterialExtension"},
    {"KHR_materials_iridescence", ratified, drawn, "IridescenceMaterialExtension"},
    {"KHR_materials_pbrSpecularGlossiness", archived, drawn,
     "converted to PhysicalMaterial with SpecularMaterialExtension"},
    {"KHR_materials_sheen", ratified, drawn, "SheenMaterialExtension"},
    {"KHR_materials_specular", ratified, drawn, "SpecularMaterialExtension"},
    {"KHR_materials_subsurface", draft, approximated, otherMaterial},
    {"KHR_materials_transmission", ratified, drawn, "TransmissionMaterialExtension"},
    {"KHR_materials_unlit", ratified, drawn, "UnlitMaterial"},
    {"KHR_materials_variants", ratified, drawn, "Switch; its first child has the materials that the file shows first"},
    {"KHR_materials_volume", ratified, drawn, "VolumeMaterialExtension"},
    {"KHR_materials_volume_scatter", draft, approximated, otherMaterial},
    {"KHR_mesh_quantization", ratified, drawn, ""},
    {"KHR_meshopt_compression", draft, drawn, "what meshoptimizer 0.18 decodes; the rest is refused"},
    {"KHR_node_hoverability", ratified, metadata, noBehaviour},
    {"KHR_node_selectability", ratified, metadata, noBehaviour},
    {"KHR_node_visibility", ratified, drawn, "the field visible of Group and Transform"},
    {"KHR_physics_rigid_bodies", draft, metadata, noPhysics},
    {"KHR_techniques_webgl", archived, approximated,
     "pages run no shaders of others; the material is drawn without them"},
    {"KHR_texture_basisu", ratified, refused,
     "imgeo has no decoder for KTX 2; textures that also have a PNG, JPEG or WebP image are drawn with it"},
    {"KHR_texture_procedurals", draft, approximated, noProcedures},
    {"KHR_texture_transform", ratified, drawn, "TextureTransform"},
    {"KHR_texture_video", draft, approximated, noVideo},
    {"KHR_xmp", archived, metadata, ""},
    {"KHR_xmp_json_ld", ratified, metadata, ""},

    {"EXT_feature_metadata", multiVendor, metadata, ""},
    {"EXT_instance_features", multiVendor, metadata, ""},
    {"EXT_lights_ies", multiVendor, approximated, "lights with photometric profiles are left out"},
    {"EXT_lights_image_based", multiVendor, approximated, noSurroundings},
    {"EXT_mesh_features", multiVendor, metadata, ""},
    {"EXT_mesh_gpu_instancing", ratified, drawn, "a Transform for each instance"},
    {"EXT_mesh_manifold", multiVendor, metadata, "the triangles that it describes are drawn"},
    {"EXT_mesh_primitive_edge_visibility", multiVendor, approximated, "edges of triangles are not drawn"},
    {"EXT_mesh_primitive_restart", multiVendor, drawn, "by the separate primitives that the file also has"},
    {"EXT_meshopt_compression", ratified, drawn, "decoded by meshoptimizer"},
    {"EXT_property_animation", multiVendor, approximated, noAnimation},
    {"EXT_structural_metadata", multiVendor, metadata, ""},
    {"EXT_texture_avif", multiVendor, drawn, ""},
    {"EXT_texture_procedurals_mx_1_39", multiVendor, approximated, noProcedures},
    {"EXT_texture_video", multiVendor, approximated, noVideo},
    {"EXT_texture_webp", ratified, drawn, ""},
    {"EXT_textureInfo_constant_lod", multiVendor, approximated, "textures do not depend on the distance"},

    {"ADOBE_materials_clearcoat_specular", vendor, approximated, otherMaterial},
    {"ADOBE_materials_clearcoat_tint", vendor, approximated, otherMaterial},
    {"ADOBE_materials_thin_transparency", vendor, approximated, otherMaterial},
    {"AGI_articulations", vendor, metadata, ""},
    {"AGI_stk_metadata", vendor, metadata, ""},
    {"BENTLEY_materials_line_style", vendor, approximated, otherMaterial},
    {"BENTLEY_materials_planar_fill", vendor, approximated, otherMaterial},
    {"BENTLEY_materials_point_style", vendor, approximated, otherMaterial},
    {"CESIUM_primitive_outline", vendor, approximated, "outlines are not drawn"},
    {"FB_geometry_metadata", vendor, metadata, ""},
    {"FB_ngon_encoding", vendor, metadata, ""},
    {"GODOT_single_root", vendor, metadata, ""},
    {"GOOGLE_backgrounds", vendor, approximated, "backgrounds are left out"},
    {"GOOGLE_camera_settings", vendor, metadata, ""},
    {"GRIFFEL_bim_data", vendor, metadata, ""},
    {"KHR_technique_webgl", vendor, approximated, "pages run no shaders of others; the material is drawn without them"},
    {"MPEG_accessor_timed", vendor, refused, noVideo},
    {"MPEG_animation_timing", vendor, approximated, noAnimation},
    {"MPEG_audio_spatial", vendor, metadata, noSound},
    {"MPEG_buffer_circular", vendor, refused, noVideo},
    {"MPEG_media", vendor, approximated, noVideo},
    {"MPEG_mesh_linking", vendor, metadata, ""},
    {"MPEG_scene_dynamic", vendor, approximated, noVideo},
    {"MPEG_texture_video", vendor, approximated, noVideo},
    {"MPEG_viewport_recommended", vendor, metadata, ""},
    {"MSFT_lod", vendor, approximated, "the most detailed level is drawn at every distance"},
    {"MSFT_packing_normalRoughnessMetallic", vendor, metadata, "the file's other textures are drawn"},
    {"MSFT_packing_occlusionRoughnessMetallic", vendor, metadata, "the file's other textures are drawn"},
    {"MSFT_texture_dds", vendor, refused,
     "browsers show no DDS; textures that also have a PNG, JPEG or WebP image are drawn with it"},
    {"NV_materials_mdl", vendor, approximated, otherMaterial},
    {"OMI_physics_body", vendor, metadata, noPhysics},
    {"OMI_physics_shape", vendor, metadata, noPhysics},
    {"SPB_vegetation", vendor, metadata, ""},
    {"VRM", vendor, approximated, "the avatar stands as it was modelled"},
    {"VRMC_materials_hdr_emissiveMultiplier", vendor, approximated, otherMaterial},
    {"VRMC_materials_mtoon", vendor, approximated, otherMaterial},
    {"VRMC_node_constraint", vendor, metadata, noBehaviour},
    {"VRMC_springBone", vendor, metadata, noBehaviour},
    {"VRMC_vrm", vendor, approximated, "the avatar stands as it was modelled"},
    {"VRMC_vrm_animation", vendor, approximated, noAnimation},
    {"WEB3D_quantized_attributes", archived, refused, "belongs to glTF 1.0"},
};

} // namespace

std::span<const ExtensionRow> extensionTable() {
  return rows;
}

const ExtensionRow* extensionRow(std::string_view name) {
  const auto row = std::ranges::find(rows, name, &ExtensionRow::name);
  return row == std::end(rows) ? nullptr : &*row;
}

std::string_view nameOf(ExtensionTreatment treatment) {
  static constexpr std::array names{"drawn", "approximated", "refused", "metadata"};
  return names.at(static_cast<std::size_t>(treatment));
}

std::string_view nameOf(ExtensionStatus status) {
  static constexpr std::array names{"ratified", "several vendors", "draft", "archived", "vendor"};
  return names.at(static_cast<std::size_t>(status));
}

} // namespace imgeo::gltf
