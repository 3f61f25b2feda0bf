#pragma once
// Typed, checked access to glTF's JSON; every Error names the location of the value.

#include "base/affine.h"
#include "base/error.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace imgeo::gltf {

using Json = nlohmann::json;

/// A value of the document and its location: "scene.gltf, meshes[2].primitives[0]".
class Value {
public:
  /// `separator` stands between the location and the name of a member.
  Value(const Json& json, std::string location, const char* separator = ".")
      : json_(&json), location_(std::move(location)), separator_(separator) {}

  [[noreturn]] void fail(ErrorKind kind, const std::string& message) const { throw Error(kind, location_, message); }
  const Json& json() const { return *json_; }
  const std::string& location() const { return location_; }

  bool has(const char* name) const { return json_->is_object() && json_->contains(name); }
  /// A member of an object; a null value where it is absent.
  Value operator[](const char* name) const;
  /// An element of an array; `index` must be below size().
  Value operator[](std::size_t index) const;
  /// The number of elements of an array; 0 for an absent value.
  std::size_t size() const;
  bool isAbsent() const { return json_->is_null(); }

  // Each returns the fallback where the value is absent, and throws Error{malformed} for another type.
  std::string text(const std::string& fallback = "") const;
  bool boolean(bool fallback) const;
  double real(double fallback) const; ///< finite and within single precision
  std::uint64_t whole(std::uint64_t fallback) const;
  /// A required unsigned integer.
  std::uint64_t whole() const;
  /// Exactly `count` finite numbers.
  std::vector<double> reals(std::size_t count, std::vector<double> fallback) const;
  Vec3d vec3(Vec3d fallback) const;
  Vec3f vec3f(Vec3f fallback) const { return Vec3f(vec3(Vec3d(fallback))); }
  Vec2<double> vec2(Vec2<double> fallback) const;

  /// The value of `member` as an index into `array`; empty where it is absent. Throws Error{malformed} where it is out
  /// of range.
  std::optional<std::size_t> index(const char* member, const Value& array) const;

private:
  const Json* json_;
  std::string location_;
  const char* separator_;
};

/// Parses the text of a document. Throws Error{malformed, limit} naming `name`.
Json parseJson(std::string_view text, const std::string& name);
/// Throws as parseJson() does.
void checkJson(std::string_view text, const std::string& name);

} // namespace imgeo::gltf
