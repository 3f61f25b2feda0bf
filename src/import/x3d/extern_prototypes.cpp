#include "import/x3d/extern_prototypes.h"

#include "base/error.h"
#include "base/file.h"
#include "import/archive/gzip.h"
#include "import/vrml/parser.h"
#include "import/vrml/vrml.h"
#include "import/x3d/x3d.h"
#include "import/x3d_json/parser.h"
#include "import/x3d_json/x3d_json.h"
#include "scene/mf_string.h"

#include <fmt/format.h>

namespace imgeo::x3d {

namespace {

bool isUrlField(std::string_view name) {
  return name == "url" || name.ends_with("Url");
}

/// Makes relative URLs of a file in `folder` relative to the folder above.
std::string rebased(const std::string& text, const std::string& folder) {
  std::vector<std::string> urls = parseStrings(text);
  for (std::string& url : urls)
    if (!url.empty() && url[0] != '/' && url[0] != '#' && url.substr(0, url.find('/')).find(':') == url.npos)
      url.insert(0, folder);
  return quoteStrings(urls);
}

/// Rebases the URLs of all elements, and of values that instances and declarations give to URL fields.
class UrlRebaser : public pugi::xml_tree_walker {
public:
  explicit UrlRebaser(std::string folder) : folder_(std::move(folder)) {}

  bool for_each(pugi::xml_node& element) override {
    const bool isValue = isUrlField(element.attribute("name").value());
    for (pugi::xml_attribute field : element.attributes())
      if (isUrlField(field.name()) || (isValue && std::string_view(field.name()) == "value"))
        field.set_value(rebased(field.value(), folder_).c_str());
    return true;
  }

private:
  std::string folder_; ///< ends in "/"
};

} // namespace

Elements parseElements(std::string_view text, const std::string& name) {
  if (text.starts_with("\xef\xbb\xbf"))
    text.remove_prefix(3); // byte order mark
  if (isX3d(asBytes(text)))
    return parseXml(text, name);
  if (isVrml(asBytes(text)))
    return parseVrml(text, name);
  if (isX3dJson(asBytes(text)))
    return parseX3dJson(text, name);
  throw Error(ErrorKind::unsupported, name, "is no X3D or VRML file, and so has no prototypes");
}

ExternPrototypes::Named ExternPrototypes::find(const std::string& url) {
  const std::size_t hash = std::min(url.find('#'), url.size());
  const std::string fileUrl = url.substr(0, hash), prototype = hash < url.size() ? url.substr(hash + 1) : "";
  const std::filesystem::path path = references_.fileOf(fileUrl);
  std::error_code ignored;
  const auto [found, isNew] = files_.try_emplace(std::filesystem::weakly_canonical(path, ignored));
  if (isNew) {
    if (files_.size() > maxPrototypeFiles)
      throw Error(ErrorKind::limit, path.string(),
                  fmt::format("external prototypes are in more than {} files", maxPrototypeFiles));
    Bytes bytes = readFile(path);
    if (isGzip(bytes))
      bytes = gunzip(bytes, path.string());
    auto file = std::make_unique<File>();
    file->elements = parseElements(asText(bytes), path.string());
    if (const std::size_t slash = fileUrl.rfind('/'); slash != fileUrl.npos) {
      UrlRebaser rebaser(fileUrl.substr(0, slash + 1));
      file->elements.document.traverse(rebaser);
    }
    found->second = std::move(file);
  }
  if (!found->second)
    throw Error(ErrorKind::malformed, path.string(), "could not be read before");
  return {found->second.get(), prototype};
}

} // namespace imgeo::x3d
