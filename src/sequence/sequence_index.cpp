#include "sequence/sequence_index.h"

#include "base/error.h"
#include "base/narrow.h"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace imgeo {

namespace {

using Json = nlohmann::json;

constexpr std::size_t maxUrlLength = 128;
constexpr auto replacesInvalid = Json::error_handler_t::replace; ///< what is no UTF-8

[[noreturn]] void refuse(const std::string& location, const std::string& message) {
  throw Error(ErrorKind::malformed, location, message);
}

/// A file beside the index, so that no index leads a reader elsewhere.
bool isFileName(std::string_view name) {
  return !name.empty() && name.size() <= maxUrlLength && name.front() != '.' && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
           c == '-';
  });
}

std::uint64_t positiveInteger(const Json& json, const char* name, std::uint64_t maximum, const std::string& location) {
  const auto found = json.find(name);
  if (found == json.end() || !found->is_number_unsigned() || found->get<std::uint64_t>() == 0)
    refuse(location, fmt::format("a file of the sequence states no \"{}\"", name));
  if (found->get<std::uint64_t>() > maximum)
    throw Error(ErrorKind::limit, location, fmt::format("a file of the sequence has more than {} {}", maximum, name));
  return found->get<std::uint64_t>();
}

SequenceFile fileFrom(const Json& json, const std::string& location) {
  if (!json.is_object() || !json.contains("url") || !json["url"].is_string())
    refuse(location, "a file of the sequence states no \"url\"");
  SequenceFile file;
  file.url = json["url"].get<std::string>();
  if (!isFileName(file.url))
    refuse(location, "a \"url\" of the sequence is no name of a file beside its index");
  file.frames = narrow<std::uint32_t>(positiveInteger(json, "frames", maxSequenceFileFrames, location));
  file.bytes = positiveInteger(json, "bytes", maxSequenceFileBytes, location);
  return file;
}

} // namespace

std::uint32_t SequenceIndex::frameCount() const {
  std::uint32_t count = 0;
  for (const SequenceFile& file : files)
    count += file.frames;
  return count;
}

std::uint32_t SequenceIndex::firstFrameOf(std::size_t file) const {
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < file; ++i)
    first += files[i].frames;
  return first;
}

std::size_t SequenceIndex::fileOf(std::uint32_t frame) const {
  assert(frame < frameCount());
  std::size_t file = 0;
  for (; frame >= files[file].frames; ++file)
    frame -= files[file].frames;
  return file;
}

std::string writeSequenceIndex(const SequenceIndex& index) {
  std::string text = fmt::format("{{\"version\": 1, {},\n", live::describe(index.description));
  if (!index.valueName.empty())
    text += fmt::format("\"valueName\": {},\n", Json(index.valueName).dump(-1, ' ', false, replacesInvalid));
  text += "\"files\": [";
  for (std::size_t i = 0; i < index.files.size(); ++i)
    text += fmt::format("{}\n{{\"url\": \"{}\", \"frames\": {}, \"bytes\": {}}}", i > 0 ? "," : "", index.files[i].url,
                        index.files[i].frames, index.files[i].bytes);
  return text + "]}\n";
}

SequenceIndex readSequenceIndex(std::string_view text, const std::string& location) {
  if (text.size() > maxSequenceIndexBytes)
    throw Error(ErrorKind::limit, location, "the index of the sequence is too long");
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object())
    refuse(location, "is no index of a sequence: it is no JSON object");
  const auto version = json.find("version");
  if (version == json.end() || !version->is_number_unsigned())
    refuse(location, "is no index of a sequence: it states no \"version\"");
  if (*version != 1)
    throw Error(ErrorKind::unsupported, location, "is a sequence of another version; only 1 is read");
  const Json valueName = json.value("valueName", Json(""));
  if (!valueName.is_string())
    refuse(location, "the sequence states a \"valueName\" that is no text");
  const Json files = json.value("files", Json());
  if (!files.is_array() || files.empty())
    refuse(location, "the sequence has no files");
  json.erase("files");
  json.erase("viewToken");

  SequenceIndex index;
  index.description = live::readDescription(json.dump(-1, ' ', false, replacesInvalid), location);
  if (index.description.rate <= 0)
    refuse(location, "the sequence states no \"rate\" above 0");
  index.valueName = valueName.get<std::string>();
  std::uint64_t frames = 0;
  for (const Json& file : files) {
    index.files.push_back(fileFrom(file, location));
    frames += index.files.back().frames;
  }
  if (frames > maxSequenceFrames)
    throw Error(ErrorKind::limit, location,
                fmt::format("the sequence has {} frames; {} are read", frames, maxSequenceFrames));
  return index;
}

} // namespace imgeo
