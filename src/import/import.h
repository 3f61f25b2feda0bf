#pragma once
// import: the bytes of a file -> Scene. One file per format; this header is all
// that other folders see.
//
// PLY: ASCII and binary of both byte orders, every scalar type; vertices with
// x y z, and where they are there nx ny nz, s t (u v, texture_u texture_v), red
// green blue alpha (diffuse_red ...); `face` with vertex_indices (vertex_index)
// and texcoord; `tristrips`; `edge` with vertex1 and vertex2, a shape of lines.
// Without any of these: a point cloud. Other numbers of a vertex are further
// attributes for those who ask for them (as single precision; they must be
// finite): NAME, or NAME_0 .. NAME_3 that follow one another for one of two to
// four components.
// OBJ: v (with colours), vt, vn, f, l; each `o` is a shape, or two where it has
// faces and lines; groups are none. Without faces and lines: a point cloud.
// STL: binary and ASCII; each ASCII solid is a shape, each corner has a position
// of its own (weld joins them), facet normals are left to the winding.
// glTF 2.0 and GLB: nodes, meshes (one that several nodes show once), materials,
// textures, cameras, punctual lights, the authors' extras; compressed by Draco or
// meshopt, quantised, sparse, instanced. Attributes _NAME are further attributes NAME.
// What is damaged is left out, with a warning, unless the options are strict.
// X3D in XML and in classic VRML, VRML97: the sets of faces, triangles, lines and points and elevation grids
// are meshes; everything else is a node that goes through as it is. Prototypes are written out where they
// stand, and files that an Inline names are read too: what they hold are the Inline's children. Collada, FBX,
// 3DS and whatever else Assimp reads: nodes, meshes, materials, textures, cameras and lights, read in a
// process of its own. Polygons are cut into triangles. Normals are brought to unit length; (0, 0, 1) stands
// for those without a direction. Everything else is named in a warning. Limits: 2^32 - 1 vertices and
// corners; OBJ files of 8 GiB; gzipped files, see gzip.h.

#include "base/bytes.h"
#include "scene/scene.h"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace imgeo {

struct Imported {
  Scene scene;                         ///< normals only where the file has them
  std::vector<std::string> attributes; ///< names of all further attributes of the source, kept or not
  std::string format;                  ///< "PLY", "OBJ", "GLB" ...: for reports
  std::vector<std::string> warnings;   ///< one sentence per kind of thing not carried over
};

/// Which further attributes of vertices are carried over, by name.
struct AttributeChoice {
  bool all = false;
  std::set<std::string> names; ///< where not all

  bool has(const std::string& name) const { return all || names.contains(name); }
};

struct ImportOptions {
  AttributeChoice attributes;     ///< none where nothing is said
  std::filesystem::path folder{}; ///< where relative urls lead; empty: nowhere
  bool outside = false;           ///< urls may lead out of the folder
  /// Geometry of an X3D document whose text is no longer than this stays in it; where there
  /// is much of that, only what is as short as a box.
  std::size_t inlineBytes = 0;
  bool strict = false;            ///< damage is an Error, even where the rest could be read
  std::filesystem::path within{}; ///< the folder that urls may not lead out of; empty: `folder`
  /// The files on whose account this one is read, outermost first: it is inlined by the last.
  std::vector<std::filesystem::path> inlinedBy{};
};

/// Reads a file of any known format; the format is told from the content first,
/// the name's ending second. A gzipped file (magic 1f 8b) is unpacked first.
/// Safe for untrusted bytes: counts are checked against the bytes that are left
/// before anything is allocated; NaN and infinite coordinates are refused.
/// Throws Error (io, truncated, malformed, unsupported, limit) with file and
/// line (text) or byte (binary).
Imported importFile(const std::filesystem::path& path, const ImportOptions& options = {});

/// The same for bytes at hand, whose relative urls lead to options.folder; `name` stands for the file in
/// messages and its ending helps to tell the format.
Imported importBytes(ByteSpan bytes, const std::string& name, const ImportOptions& options = {});

} // namespace imgeo
