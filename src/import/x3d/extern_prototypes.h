#pragma once
// Reads the files that EXTERNPROTOs name.

#include "import/references.h"
#include "import/x3d/elements.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>

namespace imgeo::x3d {

/// Limit of the number of files with external prototypes.
inline constexpr std::size_t maxPrototypeFiles = 100;

/// Parses X3D in any encoding: XML, classic VRML, JSON. Throws Error{malformed, unsupported, limit} naming `name`.
Elements parseElements(std::string_view text, const std::string& name);

class ExternPrototypes {
public:
  explicit ExternPrototypes(References references) : references_(std::move(references)) {}

  /// A file with prototypes, whose relative URLs are those of the document that names it.
  struct File {
    Elements elements;
  };

  struct Named {
    File* file = nullptr;
    std::string prototype; ///< the part of the URL after #; "" for the first prototype of the file
  };

  /// The file of a URL such as "lib/doors.x3d#Door", each file read once. Throws what parseElements and References
  /// throw, and Error{limit} beyond the maximum number.
  Named find(const std::string& url);

private:
  References references_;
  std::map<std::filesystem::path, std::unique_ptr<File>> files_;
};

} // namespace imgeo::x3d
