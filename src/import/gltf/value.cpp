#include "import/gltf/value.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace imgeo::gltf {

namespace {

const Json absent;
constexpr std::size_t maxJsonDepth = 200;

/// The nesting depth of brackets outside of strings. Bounds the recursion over the parsed document.
std::size_t depthOf(std::string_view text) {
  std::size_t depth = 0, deepest = 0;
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      i += c == '\\';
      inString = c != '"';
    } else if (c == '"') {
      inString = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return deepest;
}

} // namespace

Value Value::operator[](const char* name) const {
  const std::string location = location_ + separator_ + name;
  if (json_->is_null())
    return {absent, location};
  if (!json_->is_object())
    fail(ErrorKind::malformed, "is no object");
  const auto found = json_->find(name);
  return {found == json_->end() ? absent : *found, location};
}

Value Value::operator[](std::size_t index) const {
  return {json_->at(index), fmt::format("{}[{}]", location_, index)};
}

std::size_t Value::size() const {
  if (json_->is_null())
    return 0;
  if (!json_->is_array())
    fail(ErrorKind::malformed, "is no array");
  return json_->size();
}

std::string Value::text(const std::string& fallback) const {
  if (json_->is_null())
    return fallback;
  if (!json_->is_string())
    fail(ErrorKind::malformed, "is no string");
  return json_->get<std::string>();
}

bool Value::boolean(bool fallback) const {
  if (json_->is_null())
    return fallback;
  if (!json_->is_boolean())
    fail(ErrorKind::malformed, "is neither true nor false");
  return json_->get<bool>();
}

double Value::real(double fallback) const {
  if (json_->is_null())
    return fallback;
  if (!json_->is_number())
    fail(ErrorKind::malformed, "is no number");
  const double value = json_->get<double>();
  if (!(std::abs(value) <= std::numeric_limits<float>::max()))
    fail(ErrorKind::malformed, "is beyond single precision");
  return value;
}

std::uint64_t Value::whole(std::uint64_t fallback) const {
  return json_->is_null() ? fallback : whole();
}

std::uint64_t Value::whole() const {
  if (json_->is_null())
    fail(ErrorKind::malformed, "is missing");
  if (json_->is_number_unsigned())
    return json_->get<std::uint64_t>();
  // Some writers give integers as 3.0.
  const double value = json_->is_number() ? json_->get<double>() : -1;
  if (!(value >= 0 && value < 9e15 && value == std::floor(value)))
    fail(ErrorKind::malformed, "is no whole number from 0 on");
  return static_cast<std::uint64_t>(value);
}

std::vector<double> Value::reals(std::size_t count, std::vector<double> fallback) const {
  if (json_->is_null())
    return fallback;
  if (size() != count)
    fail(ErrorKind::malformed, fmt::format("has {} numbers and needs {}", size(), count));
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    const Value element = (*this)[i];
    if (element.isAbsent())
      element.fail(ErrorKind::malformed, "is no number");
    numbers.push_back(element.real(0));
  }
  return numbers;
}

Vec3d Value::vec3(Vec3d fallback) const {
  const std::vector<double> n = reals(3, {fallback.x, fallback.y, fallback.z});
  return {n[0], n[1], n[2]};
}

Vec2<double> Value::vec2(Vec2<double> fallback) const {
  const std::vector<double> n = reals(2, {fallback.x, fallback.y});
  return {n[0], n[1]};
}

std::optional<std::size_t> Value::index(const char* member, const Value& array) const {
  const Value value = (*this)[member];
  if (value.isAbsent())
    return {};
  const std::uint64_t index = value.whole();
  if (index >= array.size())
    value.fail(ErrorKind::malformed, fmt::format("names element {} of {}", index, array.size()));
  return index;
}

Json parseJson(std::string_view text, const std::string& name) {
  if (depthOf(text) > maxJsonDepth)
    throw Error(ErrorKind::limit, name, "its JSON is nested too deeply");
  try {
    Json json = Json::parse(text);
    if (!json.is_object())
      throw Error(ErrorKind::malformed, name, "its JSON is no object");
    return json;
  } catch (const Json::parse_error& error) {
    const auto line = 1 + std::count(text.begin(), text.begin() + std::min(error.byte, text.size()), '\n');
    throw Error(ErrorKind::malformed, fmt::format("{}:{}", name, line), "its JSON is not well-formed");
  } catch (const Json::exception&) {
    throw Error(ErrorKind::malformed, name, "its JSON holds a number out of range");
  }
}

void checkJson(std::string_view text, const std::string& name) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == text.npos || text[begin] != '{' || depthOf(text) > maxJsonDepth || !Json::accept(text))
    parseJson(text, name);
}

} // namespace imgeo::gltf
