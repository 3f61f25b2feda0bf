#pragma once
/// @file
/// How geometry is stored in the files of a site.

#include <cstdint>

namespace imgeo {

/// How the patches of a geometry are stored.
enum class Encoding : std::uint8_t {
  compact, ///< SIG, profile compact: one entropy-coded PNG image a patch, behind a coarse base mesh
  classic, ///< SIG, profile classic: PNG images of byte planes, which X3DOM 1.7 reads as well
  bg,      ///< BG: typed arrays
};

/// The runtime that shows a site.
enum class Target : std::uint8_t {
  web,   ///< imgeo's own runtime, which the site contains
  x3dom, ///< X3DOM, which reads fewer encodings
};

/// Order of the attributes in BG files. Indices are always in a file of their own.
enum class Layout : std::uint8_t {
  separate,    ///< a file for each attribute
  interleaved, ///< records that hold all attributes of a vertex
};

/// How unit normals are stored.
enum class NormalEncoding : std::uint8_t {
  rgb,        ///< three components
  octahedral, ///< two coordinates on an octahedron
  spherical,  ///< two angles
  palette,    ///< an index into the palette of a classic image
  derived,    ///< not at all: a compact reader computes them from the triangles
};

/// Element type of a BG attribute.
enum class ElementType : std::uint8_t {
  int8,    ///< "Int8"
  uint8,   ///< "Uint8"
  int16,   ///< "Int16"
  uint16,  ///< "Uint16"
  int32,   ///< "Int32"
  uint32,  ///< "Uint32"
  float32, ///< "Float32"
};

/// File format of the images of SIG classic. Both are lossless.
enum class ImageFormat : std::uint8_t {
  png,  ///< PNG, which X3DOM's tools write
  webp, ///< lossless WebP where it is smaller, otherwise PNG
};

/// "compact", "classic", "bg".
const char* nameOf(Encoding encoding);
/// "rgb", "octahedral", "spherical", "palette", "derived".
const char* nameOf(NormalEncoding encoding);
/// "png", "webp".
const char* nameOf(ImageFormat format);
/// The name of a type in X3D's BinaryGeometry: "Uint16" ...
const char* nameOf(ElementType type);

} // namespace imgeo
