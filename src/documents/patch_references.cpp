#include "documents/patch_references.h"

#include "base/data_url.h"
#include "containers/encodings.h"
#include "documents/animation_element.h"
#include "documents/field_messages.h"
#include "markup/find_x3d.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace imgeo {

namespace {

bool parseInteger(std::string_view text, std::uint32_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

/// Parses the ending "+S" of a url, X3DOM's stride. The ending is part of the file's name unless a '?' separates them.
/// Any other '+' is an ordinary character, as it is in the base64 of a data: URL.
Reference stridedReference(const std::string& url) {
  const std::size_t plus = url.rfind('+');
  ByteLocation location;
  if (plus == std::string::npos || !parseInteger(std::string_view(url).substr(plus + 1), location.byteStride))
    return {url, ByteLocation{}};
  const bool isQuery = plus > 0 && url[plus - 1] == '?';
  if (isDataUrl(url))
    return {url, ByteLocation{}};
  return {isQuery ? url.substr(0, plus - 1) : url, location};
}

/// Reads the fragment of a url; returns false if it is malformed.
bool parseFragment(std::string_view fragment, TexelLocation& location) {
  return parseInteger(fragment, location.firstTexel);
}
bool parseFragment(std::string_view fragment, PatchLocation& location) {
  return parseInteger(fragment, location.patchIndex);
}
bool parseFragment(std::string_view fragment, ByteLocation& location) {
  const std::size_t plus = fragment.find('+');
  return parseInteger(fragment.substr(0, plus), location.byteOffset) &&
         (plus == std::string_view::npos || parseInteger(fragment.substr(plus + 1), location.byteStride));
}

} // namespace

Reference referenceOf(const FieldReader& fields, const std::string& url, Encoding encoding) {
  Reference reference{url, rowOf(encoding).location};
  const std::size_t hash = url.rfind('#'); // base64 has none
  if (hash == std::string::npos && std::holds_alternative<ByteLocation>(reference.location))
    return stridedReference(url);
  reference.url = url.substr(0, hash);
  if (reference.url.empty())
    fields.fail(ErrorKind::malformed, "a reference has no url");
  if (reference.url.find('#') != std::string::npos)
    fields.fail(ErrorKind::malformed, "a reference has two fragments");
  if (hash == std::string::npos)
    return reference;
  const std::string_view fragment = std::string_view(url).substr(hash + 1);
  if (!std::visit([&](auto& location) { return parseFragment(fragment, location); }, reference.location))
    fields.fail(ErrorKind::malformed, "a reference's fragment is not an index in its file");
  return reference;
}

namespace {

/// Parses the references of one file that has several URLs. The first says where in the file the data begins.
Reference referenceOf(const FieldReader& fields, const std::vector<std::string>& urls, Encoding encoding) {
  Reference reference = referenceOf(fields, urls.at(0), encoding);
  for (const std::string& url : std::span(urls).subspan(1)) {
    Reference further = referenceOf(fields, url, encoding);
    if (further.location == reference.location)
      reference.furtherUrls.push_back(std::move(further.url));
    else
      fields.warnOrFail("the URLs of a file have different fragments", "only those like the first are used");
  }
  return reference;
}

/// Byte planes that coordinates can have: 32 bits.
constexpr std::size_t maxCoordImages = 4;

/// Whether an element holds an image of an ImageGeometry, or would if it were of a kind that we read.
bool holdsImage(const char* name) {
  return std::ranges::any_of(std::initializer_list<const char*>{"ImageTexture", "Texture", "PixelTexture",
                                                                "MovieTexture", "img", "canvas", "video"},
                             [&](const char* known) { return equalIgnoringCase(name, known); });
}

/// The element that a USE names, null if there is none; the element itself without a USE.
pugi::xml_node findUsedNode(const DocumentText& source, const FieldReader& fields) {
  const std::string name = fields.text("USE");
  if (name.empty())
    return fields.node();
  const auto found = source.defs.find(name);
  return found == source.defs.end() ? pugi::xml_node() : found->second;
}

/// The same; fails if there is none.
pugi::xml_node usedNode(const DocumentText& source, const FieldReader& fields) {
  const pugi::xml_node used = findUsedNode(source, fields);
  if (!used)
    fields.fail(ErrorKind::malformed, fmt::format("USE=\"{}\" names no DEF of this scene", fields.text("USE")));
  return used;
}

/// Whether a child with an image is a movie that holds coordinates.
bool isReadAsMovie(const DocumentText& source, const pugi::xml_node& child) {
  const pugi::xml_node used = findUsedNode(source, FieldReader(source, child));
  return used && readMovie(FieldReader(source, used));
}

/// Whether a URL, which may have a query with a token, names a live stream (docs/live.md).
bool isStreamUrl(std::string_view url) {
  constexpr std::string_view folder = "live/";
  url = url.substr(0, url.find('?'));
  const std::size_t first = std::min(url.rfind('/') + 1, url.size()); // npos + 1 is 0
  const std::string_view name = url.substr(first), before = url.substr(0, first);
  const bool isName = !name.empty() && name.size() <= 64 && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return isName && (before == folder || before.ends_with("/live/"));
}

constexpr const char* streamReason = "a live stream is in no file";

/// Why the content of an element that holds an image is in no file; nothing where it may be in one.
std::optional<std::string> reasonNotInFiles(const DocumentText& source, pugi::xml_node image) {
  while (image) {
    const std::vector<std::string> urls = FieldReader(source, image).strings("url");
    const auto is = [&](const char* name) { return equalIgnoringCase(image.name(), name); };
    if (!urls.empty() && isStreamUrl(urls[0]))
      return streamReason;
    if (is("MovieTexture"))
      return "a movie with coordinates names a lossless video and the index of its frames";
    if (is("video"))
      return "movies are not drawn; images and live streams are";
    if (is("canvas"))
      return "a canvas has pixels only in a page";
    if (is("PixelTexture"))
      return "the pixels of a PixelTexture are not read as geometry; images are";
    if (!urls.empty())
      return {};
    image = image.find_child([](const auto& child) { return holdsImage(child.name()); });
  }
  return {};
}

/// The addresses of the image that an element holds: its `url` or `src`, or those of the element in it.
std::vector<std::string> imageUrls(const DocumentText& source, pugi::xml_node node) {
  for (;;) {
    const FieldReader fields(source, node);
    if (const auto reason = reasonNotInFiles(source, node))
      fields.fail(ErrorKind::unsupported, *reason);
    if (equalIgnoringCase(node.name(), "img")) {
      std::string address = fields.text("src");
      if (address.empty())
        fields.fail(ErrorKind::malformed, "an image without src has no part in the scene");
      return {std::move(address)};
    }
    if (std::vector<std::string> urls = fields.strings("url"); !urls.empty())
      return urls;
    node = node.find_child([](const pugi::xml_node& child) { return holdsImage(child.name()); });
    if (!node)
      fields.fail(ErrorKind::malformed, "a texture without url and without an image in it has no part in a geometry");
  }
}

/// References to the images of a patch, by role.
using ImagesByRole = std::map<Role, std::vector<Reference>>;

/// The `containerField` of a child or else of the node that it USEs.
std::string containerFieldOf(const DocumentText& source, const pugi::xml_node& child) {
  const FieldReader fields(source, child);
  std::string name = fields.text("containerField");
  if (const auto used = source.defs.find(fields.text("USE")); name.empty() && used != source.defs.end())
    name = FieldReader(source, used->second).text("containerField");
  return name;
}

/// What the image of a child is; empty where its containerField is none that we know.
std::optional<Role> imageRoleOf(const DocumentText& source, const pugi::xml_node& child) {
  const std::string name = containerFieldOf(source, child);
  for (const Role role : {Role::index, Role::coord, Role::normal, Role::texCoord, Role::color})
    if (equalIgnoringCase(name, nameOf(role)))
      return role;
  return {};
}

/// Adds a child that refers to an image of the patch as in X3DOM.
void readTexture(const DocumentText& source, const pugi::xml_node& child, Encoding encoding, DocumentWarnings* warnings,
                 ImagesByRole& images) {
  const FieldReader fields(source, child, warnings);
  const std::optional<Role> role = imageRoleOf(source, child);
  if (!role) {
    fields.warnOrFail(
        fmt::format("containerField=\"{}\" names no part of a geometry", shortened(containerFieldOf(source, child))),
        "the image is left out");
    return;
  }
  try {
    const pugi::xml_node used = usedNode(source, fields);
    images[*role].push_back(referenceOf(fields, imageUrls(source, used), encoding));
  } catch (const Error& error) {
    if (*role == Role::coord || *role == Role::index) // without it the surface would be another one
      throw;
    fields.warnOrFail(error.message(), "the image is left out");
  }
}

/// The first `limit` of some images. Of further ones there is a warning.
std::vector<Reference> firstImages(const FieldReader& fields, std::vector<Reference> images, std::size_t limit,
                                   const char* role) {
  if (images.size() > limit)
    fields.warnOrFail(fmt::format("only the first {} of {} {} images are used", limit, images.size(), role),
                      "the others are left out");
  images.resize(std::min(images.size(), limit));
  return images;
}

/// The images of an attribute: one for each byte of its numbers.
void setImages(PatchDescription& patch, VertexRole role, const std::vector<Reference>& images) {
  if (images.empty())
    return;
  patch.vertexAttributes[role] = images[0];
  patch.lowBytes[role].assign(images.begin() + 1, images.end());
}

/// The largest number of images of an attribute: three of colours (24 bits), two of others.
std::size_t maxImageCount(VertexRole role) {
  return role == VertexRole::color ? 3 : 2;
}

/// Reads the images that are children of an ImageGeometry. They replace those of its own fields; several images of
/// texture coordinates are its sets.
void readTextures(const DocumentText& source, const pugi::xml_node& node, Encoding encoding, DocumentWarnings* warnings,
                  PatchDescription& patch) {
  ImagesByRole images;
  for (const pugi::xml_node& child : node.children())
    if (holdsImage(child.name()) && !isReadAsMovie(source, child))
      readTexture(source, child, encoding, warnings, images);
  const FieldReader fields(source, node, warnings);
  const auto first = [&](Role role, std::size_t limit) {
    return firstImages(fields, std::move(images[role]), limit, nameOf(role));
  };
  if (const auto index = first(Role::index, 1); !index.empty())
    patch.index = index[0];
  if (auto coord = first(Role::coord, maxCoordImages); !coord.empty())
    patch.coord = std::move(coord);
  for (const VertexRole role : {VertexRole::normal, VertexRole::color})
    setImages(patch, role, first(fileRoleOf(role), maxImageCount(role)));
  const std::vector<Reference> sets = first(Role::texCoord, texCoordRoles.size());
  for (std::size_t i = 0; i < sets.size(); ++i)
    setImages(patch, texCoordRoles[i], {sets[i]});
}

/// Reads the references of the fields `coord`, `normal` ... of a patch. Those of images are one for each byte of a
/// number; the URLs of an array are those of one file.
void readReferenceFields(const FieldReader& fields, Encoding encoding, PatchDescription& patch) {
  const auto read = [&](const char* name, std::size_t limit) -> std::vector<Reference> {
    const std::vector<std::string> urls = fields.strings(name);
    if (urls.empty())
      return {};
    if (rowOf(encoding).storage == PatchStorage::arrays)
      return {referenceOf(fields, urls, encoding)};
    std::vector<Reference> images;
    for (const std::string& url : urls)
      images.push_back(referenceOf(fields, url, encoding));
    return firstImages(fields, std::move(images), limit, name);
  };
  if (const std::vector<std::string> urls = fields.strings("index"); !urls.empty())
    patch.index = referenceOf(fields, urls, encoding);
  patch.coord = read("coord", maxCoordImages);
  for (const VertexRole role : vertexRoles)
    setImages(patch, role, read(nameOf(role), maxImageCount(role)));
}

} // namespace

std::optional<std::string> reasonImagesAreNotInFiles(const DocumentText& source, const pugi::xml_node& patch) {
  if (const auto urls = FieldReader(source, patch).strings("coord"); !urls.empty() && isStreamUrl(urls[0]))
    return streamReason;
  for (const pugi::xml_node& child : patch.children()) {
    if (!holdsImage(child.name()) || isReadAsMovie(source, child))
      continue;
    const std::optional<Role> role = imageRoleOf(source, child);
    if (role == Role::coord || role == Role::index)
      if (const auto reason = reasonNotInFiles(source, usedNode(source, FieldReader(source, child))))
        return reason;
  }
  return {};
}

void readPatchReferences(const DocumentText& source, const pugi::xml_node& node, Encoding encoding,
                         DocumentWarnings* warnings, PatchDescription& patch) {
  readReferenceFields(FieldReader(source, node, warnings), encoding, patch);
  if (rowOf(encoding).storage == PatchStorage::bytePlanes)
    readTextures(source, node, encoding, warnings, patch);
}

std::optional<PatchName> parsePatchName(const std::string& text) {
  const std::size_t hash = text.rfind('#');
  PatchName name{text.substr(0, hash)};
  if (hash == std::string::npos || !parseInteger(std::string_view(text).substr(hash + 1), name.index))
    return {};
  return name;
}

} // namespace imgeo
