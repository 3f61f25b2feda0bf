#pragma once
// The files that a source refers to by url.

#include "base/bytes.h"
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

  /// The bytes that a url stands for: a data: url's own, or those of a file relative
  /// to the source's folder. Throws Error{unsupported} for other hosts and for files
  /// outside of that folder (symbolic links followed) where the options do not
  /// allow them, Error{io} for a file that cannot be read.
  Bytes fetch(std::string_view url) const;

  /// The file that a relative url names, under the same conditions; it may not be there.
  std::filesystem::path fileOf(std::string_view url) const;

private:
  std::filesystem::path folder_, within_; ///< where urls begin; what they may not lead out of
  bool allowsOutside_ = false;
  std::string sourceName_;
};

/// "a%20b" -> "a b"; what is no escape stays as it is.
std::string percentDecoded(std::string_view text);

/// RFC 4648, blanks and padding left out. Throws Error{malformed} naming `location`.
Bytes base64Decoded(std::string_view text, const std::string& location);

} // namespace imgeo
