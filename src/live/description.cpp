#include "live/description.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace imgeo::live {

namespace {

using Json = nlohmann::json;

constexpr double maxStatedRate = 1000;
constexpr std::size_t maxDescriptionBytes = std::size_t{16} * 1024;

[[noreturn]] void refuse(const std::string& location, const std::string& message) {
  throw Error(ErrorKind::malformed, location, message);
}

const Json& member(const Json& json, const char* name, const std::string& location) {
  const auto found = json.find(name);
  if (found == json.end())
    refuse(location, fmt::format("the description of the stream lacks \"{}\"", name));
  return *found;
}

std::uint32_t integerOf(const Json& json, const char* name, const std::string& location) {
  if (!json.contains(name))
    return 0;
  const Json& value = json.at(name);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > UINT32_MAX)
    refuse(location, fmt::format("\"{}\" is no integer of 32 bits", name));
  return value.get<std::uint32_t>();
}

/// The numbers of an array of `count` numbers.
std::vector<double> numbersOf(const Json& json, std::size_t count, const char* name, const std::string& location) {
  if (!json.is_array() || json.size() != count)
    refuse(location, fmt::format("\"{}\" does not consist of arrays of {} numbers", name, count));
  std::vector<double> numbers;
  for (const Json& number : json) {
    if (!number.is_number())
      refuse(location, fmt::format("\"{}\" holds something that is no number", name));
    numbers.push_back(number.get<double>());
  }
  return numbers;
}

Box3d boxOf(const Json& json, const std::string& location) {
  if (!json.is_array() || json.size() != 2)
    refuse(location, "\"box\" does not consist of two corners");
  const std::vector<double> min = numbersOf(json[0], 3, "box", location), max = numbersOf(json[1], 3, "box", location);
  return {{min[0], min[1], min[2]}, {max[0], max[1], max[2]}};
}

bool isFinite(Vec3d point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

} // namespace

double Description::step() const {
  return box.longestEdge() / ((std::uint32_t{1} << layout.positionBits) - 1);
}

void checkDescription(const Description& description, const std::string& location) {
  checkLayout(description.layout, location);
  const Box3d& box = description.box;
  if (!isFinite(box.min) || !isFinite(box.max) || !isFinite(box.size()) || box.min.x > box.max.x ||
      box.min.y > box.max.y || box.min.z > box.max.z || description.step() <= 0)
    refuse(location, "the box is empty or not finite");
  if (description.valueRange.size() != description.layout.valueComponents)
    refuse(location, "\"valueRange\" does not have a range for each component of the values");
  for (const auto& [min, max] : description.valueRange)
    if (!std::isfinite(max - min) || min >= max)
      refuse(location, "a range of values is empty or not finite");
  if (!(description.rate >= 0 && description.rate <= maxStatedRate))
    refuse(location, fmt::format("the rate is not between 0 and {} frames per second", maxStatedRate));
  if (description.viewToken.size() > maxTokenBytes)
    refuse(location, fmt::format("\"viewToken\" has more than {} bytes", maxTokenBytes));
}

std::string describe(const Description& description) {
  const FrameLayout& layout = description.layout;
  const auto arrayOf = [](Vec3d point) { return fmt::format("[{}, {}, {}]", point.x, point.y, point.z); };
  std::vector<std::string> ranges;
  for (const auto& [min, max] : description.valueRange)
    ranges.push_back(fmt::format("[{}, {}]", min, max));
  return fmt::format("\"rate\": {}, \"vertices\": {}, \"columns\": {}, \"positionBits\": {}, \"origin\": {}, "
                     "\"step\": {}, \"box\": [{}, {}], \"normalBits\": {}, \"colorComponents\": {}, "
                     "\"valueComponents\": {}, \"valueBits\": {}, \"valueRange\": [{}]",
                     description.rate, layout.vertices, layout.columns, layout.positionBits,
                     arrayOf(description.origin()), description.step(), arrayOf(description.box.min),
                     arrayOf(description.box.max), layout.normalBits, layout.colorComponents, layout.valueComponents,
                     layout.valueBits, fmt::join(ranges, ", "));
}

Description readDescription(std::string_view text, const std::string& location) {
  if (text.size() > maxDescriptionBytes)
    throw Error(ErrorKind::limit, location, "the description of the stream is too long");
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object())
    refuse(location, "the description of the stream is no JSON object");
  Description description;
  FrameLayout& layout = description.layout;
  layout.vertices = integerOf(json, "vertices", location);
  layout.columns = integerOf(json, "columns", location);
  if (json.contains("positionBits"))
    layout.positionBits = integerOf(json, "positionBits", location);
  layout.normalBits = integerOf(json, "normalBits", location);
  layout.colorComponents = integerOf(json, "colorComponents", location);
  layout.valueComponents = integerOf(json, "valueComponents", location);
  layout.valueBits = integerOf(json, "valueBits", location);
  description.box = boxOf(member(json, "box", location), location);
  if (json.contains("valueRange")) {
    const Json& ranges = json.at("valueRange");
    if (!ranges.is_array() || ranges.size() > 4)
      refuse(location, "\"valueRange\" is no array of at most 4 ranges");
    for (const Json& range : ranges) {
      const std::vector<double> numbers = numbersOf(range, 2, "valueRange", location);
      description.valueRange.push_back({numbers[0], numbers[1]});
    }
  }
  if (json.contains("rate")) {
    if (!json.at("rate").is_number())
      refuse(location, "\"rate\" is no number");
    description.rate = json.at("rate").get<double>();
  }
  if (json.contains("viewToken")) {
    if (!json.at("viewToken").is_string())
      refuse(location, "\"viewToken\" is no text");
    description.viewToken = json.at("viewToken").get<std::string>();
  }
  checkDescription(description, location);
  return description;
}

bool isStreamName(std::string_view name) {
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

} // namespace imgeo::live
