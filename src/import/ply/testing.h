#pragma once
// A small PLY writer for tests: any encoding, any types and names.

#include "base/bytes.h"
#include "scene/testing.h"

#include <fmt/format.h>
#include <string>

namespace imgeo::testing {

struct PlyStyle {
  std::string encoding = "binary_little_endian"; ///< or "ascii", "binary_big_endian"
  std::string real = "float";                    ///< type of coordinates: any of PLY's
  std::string count = "uchar", index = "int";    ///< types of the list of corners
  std::string listName = "vertex_indices";
  std::string u = "s", v = "t";
  std::string colorPrefix = ""; ///< "diffuse_"
  std::string lineEnd = "\n";
};

/// Appends values in the encoding of a style.
class PlyValues {
public:
  explicit PlyValues(const PlyStyle& style) : style_(style) {}

  template <typename T> void add(const std::string& type, T value) {
    if (style_.encoding == "ascii") {
      if (type == "float" || type == "float32")
        addText(fmt::format("{}", static_cast<float>(value)));
      else
        addText(fmt::format("{}", static_cast<double>(value)));
    } else if (type == "char" || type == "int8")
      addBinary(static_cast<std::int8_t>(value));
    else if (type == "uchar" || type == "uint8")
      addBinary(static_cast<std::uint8_t>(value));
    else if (type == "short" || type == "int16")
      addBinary(static_cast<std::int16_t>(value));
    else if (type == "ushort" || type == "uint16")
      addBinary(static_cast<std::uint16_t>(value));
    else if (type == "int" || type == "int32")
      addBinary(static_cast<std::int32_t>(value));
    else if (type == "uint" || type == "uint32")
      addBinary(static_cast<std::uint32_t>(value));
    else if (type == "float" || type == "float32")
      addBinary(static_cast<float>(value));
    else
      addBinary(static_cast<double>(value));
  }
  void endRecord() {
    if (style_.encoding != "ascii")
      return;
    append(style_.lineEnd);
    atLineStart_ = true;
  }
  void append(const std::string& text) { bytes.insert(bytes.end(), text.begin(), text.end()); }

  Bytes bytes;

private:
  void addText(const std::string& text) {
    if (!atLineStart_)
      append(" ");
    append(text);
    atLineStart_ = false;
  }
  template <typename T> void addBinary(T value) {
    style_.encoding == "binary_big_endian" ? appendBig(bytes, value) : appendLittle(bytes, value);
  }

  const PlyStyle& style_;
  bool atLineStart_ = true;
};

/// "ply", the format, `elements` (its lines end with a line feed) and "end_header".
inline std::string plyHeader(const PlyStyle& style, const std::string& elements) {
  std::string header = "ply\nformat " + style.encoding + " 1.0\ncomment for a test\n" + elements + "end_header\n",
              ended;
  for (const char c : header)
    ended += c == '\n' ? style.lineEnd : std::string(1, c);
  return ended;
}

/// The file of a mesh; every wedge becomes a vertex.
inline Bytes plyBytes(const Mesh& mesh, const PlyStyle& style) {
  const auto property = [](const std::string& type, const std::string& name) {
    return "property " + type + " " + name + "\n";
  };
  std::string elements = fmt::format("element vertex {}\n", mesh.wedgeCount());
  for (const char* name : {"x", "y", "z"})
    elements += property(style.real, name);
  if (!mesh.normals.empty())
    for (const char* name : {"nx", "ny", "nz"})
      elements += property("float", name);
  if (!mesh.texCoords.empty())
    elements += property("float32", style.u) + property("float32", style.v);
  if (!mesh.colors.empty())
    for (const char* name : {"red", "green", "blue", "alpha"})
      elements += property("uchar", style.colorPrefix + name);
  if (mesh.topology == Topology::triangles)
    elements += fmt::format("element face {}\nproperty list {} {} {}\n", mesh.elementCount(), style.count, style.index,
                            style.listName);
  if (mesh.topology == Topology::lines)
    elements += fmt::format("element edge {}\n", mesh.elementCount()) + property(style.index, "vertex1") +
                property(style.index, "vertex2");

  PlyValues values(style);
  values.append(plyHeader(style, elements));
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
    for (int axis = 0; axis < 3; ++axis)
      values.add(style.real, mesh.positions[mesh.wedgePositions[wedge]][axis]);
    if (!mesh.normals.empty())
      for (int axis = 0; axis < 3; ++axis)
        values.add("float", mesh.normals[wedge][axis]);
    if (!mesh.texCoords.empty()) {
      values.add("float", mesh.texCoords[wedge].x);
      values.add("float", mesh.texCoords[wedge].y);
    }
    if (!mesh.colors.empty()) {
      const Rgba8 c = asRgba8(mesh.colors[wedge]);
      for (const std::uint8_t value : {c.r, c.g, c.b, c.a})
        values.add("uchar", value);
    }
    values.endRecord();
  }
  if (mesh.topology == Topology::triangles)
    for (std::size_t corner = 0; corner < mesh.corners.size(); corner += 3) {
      values.add(style.count, 3);
      for (std::size_t k = 0; k < 3; ++k)
        values.add(style.index, mesh.corners[corner + k]);
      values.endRecord();
    }
  if (mesh.topology == Topology::lines)
    for (std::size_t corner = 0; corner < mesh.corners.size(); corner += 2) {
      values.add(style.index, mesh.corners[corner]), values.add(style.index, mesh.corners[corner + 1]);
      values.endRecord();
    }
  return values.bytes;
}

} // namespace imgeo::testing
