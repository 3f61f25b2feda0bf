#pragma once
// Resolves the URLs in a source: to local files, or to the bytes of data: URLs.

#include "base/bytes.h"
#include "base/data_url.h"
#include "base/error.h"
#include "import/import.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace imgeo {

class References {
public:
  /// `sourceName` stands for the source in messages.
  References(const ImportOptions& options, std::string sourceName)
      : folder_(options.folder), within_(options.within.empty() ? options.folder : options.within),
        allowsOutside_(options.outside), sourceName_(std::move(sourceName)) {}

  /// The bytes of a data: URL, or of a file relative to the source's folder. Throws Error{unsupported} for URLs of
  /// other hosts, and for files outside of that folder (symbolic links resolved) unless the options allow them;
  /// Error{io} for a file that cannot be read.
  Bytes fetch(std::string_view url) const;

  /// The path of the file that a relative URL names, under the same conditions; the file need not exist.
  std::filesystem::path fileOf(std::string_view url) const;

private:
  std::filesystem::path folder_, within_; ///< the base of relative URLs; the folder that they must stay in
  bool allowsOutside_ = false;
  std::string sourceName_;
};

/// What a strict reader throws for an Error of a file that the source names: a missing file is a fault of the source,
/// not of the disk, so Error{io} becomes Error{malformed}.
Error faultOfSource(const Error& error);

} // namespace imgeo
