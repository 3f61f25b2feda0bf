#include "documents/field_reader.h"

#include "documents/field_messages.h"
#include "documents/xml_text.h"
#include "markup/find_x3d.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <type_traits>
#include <utility>

namespace imgeo {

namespace {

constexpr std::string_view separators = " \t\r\n,";

std::string quoted(const char* name, const std::string& text) {
  return fmt::format("{}=\"{}\"", name, shortened(text));
}

/// The X3D type of a field of so many numbers; 0: any number.
template <typename T> const char* typeOf(std::size_t count) {
  constexpr bool isReal = std::is_floating_point_v<T>;
  switch (count) {
  case 0:
    return isReal ? "MFFloat" : "MFInt32";
  case 1:
    return isReal ? "SFFloat" : "SFInt32";
  case 2:
    return "SFVec2f";
  case 3:
    return "SFVec3f";
  default:
    return "SFVec4f";
  }
}

/// The next word of `text`, which it removes; empty at the end.
std::string_view nextWord(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(separators), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(separators));
  text.remove_prefix(word.size());
  return word;
}

template <typename T> std::optional<T> parseNumber(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-')
    word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size())
    return std::nullopt;
  if constexpr (std::is_floating_point_v<T>) // X3D's numbers are single precision; then sums of doubles do not overflow
    if (!(std::abs(value) <= std::numeric_limits<float>::max()))
      return std::nullopt;
  return value;
}

} // namespace

void fail(const DocumentText& source, const pugi::xml_node& node, ErrorKind kind, const std::string& message) {
  throw Error(kind, locationOf(source.text, source.name, source.offsets.of(node)), message);
}

void FieldReader::warnOrFail(const std::string& message, const char* consequence) const {
  if (!warnings_)
    fail(ErrorKind::malformed, message);
  // Without the folder, which may be a temporary one.
  const std::string file = std::filesystem::path(source_.name).filename();
  warnings_->add(fmt::format("{}: {}: {}; {}.", locationOf(source_.text, file, source_.offsets.of(node_)),
                             validText(node_.name()), message, consequence));
}

std::string FieldReader::text(const char* name) const {
  const pugi::xml_attribute attribute = attributeOf(node_, name);
  return attribute ? validText(attribute.value()) : std::string();
}

template <typename T> std::vector<T> FieldReader::parse(const char* name) const {
  return parse<T>(name, 0);
}

template <typename T> std::vector<T> FieldReader::parse(const char* name, std::size_t count) const {
  const std::string value = text(name);
  std::string_view rest = value;
  std::vector<T> numbers;
  for (std::string_view word = nextWord(rest); !word.empty(); word = nextWord(rest)) {
    if (const std::optional<T> number = parseNumber<T>(word)) {
      numbers.push_back(*number);
      continue;
    }
    if constexpr (std::is_unsigned_v<T>)
      if (const std::optional<std::int32_t> negative = parseNumber<std::int32_t>(word))
        fail(ErrorKind::malformed, fmt::format("{} {} is negative", name, *negative));
    numbers.clear();
    break;
  }
  const bool isAbsent = value.find_first_not_of(separators) == std::string::npos;
  if (isAbsent || (count == 0 ? !numbers.empty() : numbers.size() == count))
    return numbers;
  warnOrFailField(quoted(name, value) + " is no " + typeOf<T>(count));
  return {};
}

bool FieldReader::boolean(const char* name, bool fallback) const {
  const std::string value = text(name);
  if (value.empty())
    return fallback;
  if (equalIgnoringCase(value, "true"))
    return true;
  if (equalIgnoringCase(value, "false"))
    return false;
  warnOrFailField(quoted(name, value) + " is no SFBool");
  return fallback;
}

double FieldReader::real(const char* name, double fallback) const {
  const auto numbers = parse<double>(name, 1);
  return numbers.empty() ? fallback : numbers[0];
}
float FieldReader::real(const char* name, float fallback) const {
  const auto numbers = parse<float>(name, 1);
  return numbers.empty() ? fallback : numbers[0];
}
Vec2f FieldReader::vec2(const char* name, Vec2f fallback) const {
  const auto numbers = parse<float>(name, 2);
  return numbers.empty() ? fallback : Vec2f{numbers[0], numbers[1]};
}
Vec3f FieldReader::vec3(const char* name, Vec3f fallback) const {
  const auto numbers = parse<float>(name, 3);
  return numbers.empty() ? fallback : Vec3f{numbers[0], numbers[1], numbers[2]};
}
Vec3d FieldReader::vec3(const char* name, Vec3d fallback) const {
  const auto numbers = parse<double>(name, 3);
  return numbers.empty() ? fallback : Vec3d{numbers[0], numbers[1], numbers[2]};
}
Rotation FieldReader::rotation(const char* name, const Rotation& fallback) const {
  const auto numbers = parse<double>(name, 4);
  return numbers.empty() ? fallback : Rotation{{numbers[0], numbers[1], numbers[2]}, numbers[3]};
}
std::vector<double> FieldReader::reals(const char* name) const {
  return parse<double>(name);
}
std::vector<double> FieldReader::reals(const char* name, std::size_t count) const {
  return parse<double>(name, count);
}
std::vector<std::uint32_t> FieldReader::integers(const char* name) const {
  return parse<std::uint32_t>(name);
}
std::uint32_t FieldReader::integer(const char* name, std::uint32_t fallback) const {
  const auto numbers = parse<std::uint32_t>(name, 1);
  return numbers.empty() ? fallback : numbers[0];
}

std::vector<std::string> FieldReader::strings(const char* name) const {
  const std::string value = text(name);
  const std::size_t first = value.find_first_not_of(separators);
  if (first == std::string::npos)
    return {};
  if (value[first] != '"')
    return {value.substr(first, value.find_last_not_of(separators) + 1 - first)};
  std::vector<std::string> strings;
  for (std::size_t at = first; at < value.size(); ++at) {
    if (separators.find(value[at]) != std::string_view::npos)
      continue;
    if (value[at] != '"') {
      warnOrFailField(quoted(name, value) + " is no MFString");
      return {};
    }
    std::string& string = strings.emplace_back();
    for (++at; at < value.size() && value[at] != '"'; ++at) {
      if (value[at] == '\\' && at + 1 < value.size())
        ++at;
      string += value[at];
    }
    if (at >= value.size()) {
      warnOrFailField(quoted(name, value) + " is no MFString");
      return {};
    }
  }
  return strings;
}

Box3d FieldReader::box() const {
  const Vec3d center = vec3("bboxCenter", Vec3d{0, 0, 0}), size = vec3("bboxSize", Vec3d{-1, -1, -1});
  if (size.x < 0 || size.y < 0 || size.z < 0)
    return {};
  return {center - size * 0.5, center + size * 0.5};
}

} // namespace imgeo
