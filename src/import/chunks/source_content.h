#pragma once
// The bytes of a large source, which memory need not hold.

#include "base/file_view.h"
#include "base/scratch_file.h"

#include <filesystem>
#include <memory>
#include <string>

namespace imgeo {

/// The folder, or its nearest parent that exists: a work folder may not exist yet. Empty: the current one.
std::filesystem::path nearestFolder(const std::filesystem::path& path);

/// A file that is mapped into memory. A gzipped one is unpacked into a file without a name, which is mapped.
class SourceContent {
public:
  /// `scratch`: the folder on whose disk gzipped files are unpacked, or its nearest parent that exists. Safe for
  /// untrusted bytes. Throws Error{io} where a file cannot be read or the disk has no room, and as gunzip() does.
  SourceContent(const std::filesystem::path& path, const std::filesystem::path& scratch);

  ByteSpan bytes() const { return unpacked_ ? unpacked_->bytes() : file_->bytes(); }
  /// As the file is on the disk.
  std::uint64_t fileBytes() const { return file_->bytes().size(); }
  const std::string& name() const { return name_; }

private:
  std::string name_;
  std::unique_ptr<FileView> file_;
  std::unique_ptr<ScratchFile> unpacked_;
};

} // namespace imgeo
