#pragma once
// The files that Assimp may open: the source's own bytes, and files that import/references.h allows.

#include "import/references.h"

#include <assimp/cfileio.h>
#include <map>
#include <string>
#include <vector>

namespace imgeo {

class SourceFiles {
public:
  /// `bytes` are those of the file `name`. All arguments must outlive this object.
  SourceFiles(ByteSpan bytes, const std::string& name, const References& references);
  SourceFiles(const SourceFiles&) = delete;
  SourceFiles& operator=(const SourceFiles&) = delete;

  /// The file interface for Assimp; valid as long as this object lives.
  aiFileIO& io() { return io_; }

  /// One sentence for each file that Assimp requested and did not get.
  std::vector<std::string> refused() const;

private:
  aiFile* open(const std::string& path, const std::string& mode);

  ByteSpan bytes_;
  const std::string& name_;
  const References& references_;
  aiFileIO io_{};
  /// Sentences by file name, since Assimp tries the same name in several folders.
  std::map<std::string, std::string> refused_;
};

} // namespace imgeo
