#pragma once
// The table of input formats. Everything that depends on the set of formats (choice of the reader, messages, command
// line help) asks this table, so that a format is a folder of import/ and a row in formats.cpp.

#include "import/import.h"

#include <span>
#include <string>
#include <string_view>

namespace imgeo {

/// How reliable a positive answer of a format's `sniff` is.
enum class Sniffing {
  signature, ///< the bytes are of this format, whatever the file's name
  heuristic, ///< the bytes resemble this format; a row whose `readsExtension` knows the name's extension precedes it
  extension, ///< the bytes resemble this format if the name has one of its extensions, which other formats have, too
};

struct Format {
  std::string_view name;                          ///< "PLY": in messages
  std::string_view help{};                        ///< names in the command line help; empty: the help does not name it
  std::span<const std::string_view> extensions{}; ///< in lower case, with their dot; a final ".gz" is not part of them
  bool (*sniff)(ByteSpan bytes) = nullptr;        ///< recognises the format by its content; null: it has no such mark
  Sniffing sniffing = Sniffing::signature;
  /// Whether the name's extension is one of the format's, where `extensions` cannot list these; null: it lists them.
  bool (*readsExtension)(const std::string& name) = nullptr;
  bool isYUpInMetres = false; ///< the format states the axes and the unit; false: `read` tells what is known of them
  bool isX3d = false;         ///< its files are documents of X3D's nodes, which sites keep
  /// Reads bytes that are unpacked, not empty and without a byte order mark. `name` stands for the file in messages.
  /// Does all that import.h promises, except what importBytes adds: unique names, a title, the limit of shape
  /// instances.
  Imported (*read)(ByteSpan bytes, const std::string& name, const ImportOptions& options) = nullptr;
};

/// All formats, in the order in which they are sniffed and listed.
std::span<const Format> formats();

/// The row whose reader takes these bytes: the first whose signature they have; else the first that has the extension
/// and whose bytes they resemble (Sniffing::extension); else the one whose `readsExtension` knows the extension, unless
/// that is in some row's `extensions`; else the first whose heuristic they meet; else the first that has the extension.
/// Throws Error{unsupported} naming `name` where there is none.
const Format& formatOf(ByteSpan bytes, const std::string& name);

/// Whether a file has the extension of a format of X3D's nodes.
bool hasX3dExtension(const std::string& name);

/// "X3D, HTML, VRML, glTF, GLB, PLY, OBJ or STL", for the command line help.
std::string formatHelp();

} // namespace imgeo
