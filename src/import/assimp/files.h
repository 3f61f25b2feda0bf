#pragma once
// The files that Assimp may open: the source's own bytes, and what its folder holds.

#include "import/references.h"

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <set>
#include <string>

namespace imgeo {

class SourceFiles : public Assimp::IOSystem {
public:
  /// `bytes` are those of the file `name`; both outlive this.
  SourceFiles(ByteSpan bytes, const std::string& name, const References& references)
      : bytes_(bytes), name_(name), references_(references) {}

  bool Exists(const char* path) const override;
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char* mode) override;
  void Close(Assimp::IOStream* file) override { delete file; }

  /// What was asked for and not given, a sentence each.
  const std::set<std::string>& refused() const { return refused_; }

private:
  bool isSource(const std::string& path) const;

  ByteSpan bytes_;
  const std::string& name_;
  const References& references_;
  std::set<std::string> refused_;
};

} // namespace imgeo
