#include "import/import.h"

#include "base/error.h"
#include "base/file_view.h"
#include "import/archive/gzip.h"
#include "import/complete_import.h"
#include "import/dem/dem.h"
#include "import/format.h"
#include "import/text/utf16.h"

#include <optional>
#include <utility>

namespace imgeo {

Imported importBytes(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  Bytes unpacked;
  if (isGzip(bytes)) {
    unpacked = gunzip(bytes, name);
    bytes = unpacked;
  }
  if (asText(bytes).starts_with("\xef\xbb\xbf"))
    bytes = bytes.subspan(3); // byte order mark
  const std::optional<Bytes> decoded = holdsRawNumbers(name) ? std::nullopt : utf8OfUtf16(bytes);
  if (decoded)
    bytes = *decoded;
  if (bytes.empty())
    throw Error(ErrorKind::truncated, name, "the file is empty");

  const Format& format = formatOf(bytes, name);
  Imported imported = format.read(bytes, name, options);
  completeImport(imported, format.isYUpInMetres, options, name);
  return imported;
}

Imported importFile(const std::filesystem::path& path, const ImportOptions& options) {
  ImportOptions fileOptions = options;
  fileOptions.folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code ignored;
  fileOptions.inlinedBy.push_back(std::filesystem::weakly_canonical(path, ignored));
  const FileView file(path);
  return importBytes(file.bytes(), path.string(), fileOptions);
}

} // namespace imgeo
