#pragma once
// The files that Assimp may open: the source's own bytes, and what its folder holds.

#include "import/references.h"

#include <assimp/cfileio.h>
#include <map>
#include <string>
#include <vector>

namespace imgeo {

class SourceFiles {
public:
  /// `bytes` are those of the file `name`; both outlive this.
  SourceFiles(ByteSpan bytes, const std::string& name, const References& references);
  SourceFiles(const SourceFiles&) = delete;
  SourceFiles& operator=(const SourceFiles&) = delete;

  /// What Assimp opens and closes them with, as long as this lives.
  aiFileIO& io() { return io_; }

  /// What was asked for and given nowhere, a sentence each.
  std::vector<std::string> refused() const;

private:
  aiFile* open(const std::string& path, const std::string& mode);

  ByteSpan bytes_;
  const std::string& name_;
  const References& references_;
  aiFileIO io_{};
  /// By the file's name: the same may be sought in several folders.
  std::map<std::string, std::string> refused_;
};

} // namespace imgeo
