#pragma once
// Small vectors, an sRGB colour and axis-aligned boxes: plain data.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace imgeo {

template <typename T> struct Vec2 {
  T x{}, y{};
  friend bool operator==(const Vec2&, const Vec2&) = default;
};

template <typename T> struct Vec3 {
  T x{}, y{}, z{};

  T& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  const T& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

  friend bool operator==(const Vec3&, const Vec3&) = default;
  friend Vec3 operator+(Vec3 a, Vec3 b) { return {T(a.x + b.x), T(a.y + b.y), T(a.z + b.z)}; }
  friend Vec3 operator-(Vec3 a, Vec3 b) { return {T(a.x - b.x), T(a.y - b.y), T(a.z - b.z)}; }
  friend Vec3 operator*(Vec3 a, T s) { return {T(a.x * s), T(a.y * s), T(a.z * s)}; }
  Vec3& operator+=(Vec3 b) { return *this = *this + b; }

  template <typename U> explicit operator Vec3<U>() const {
    return {static_cast<U>(x), static_cast<U>(y), static_cast<U>(z)};
  }
};

using Vec2f = Vec2<float>;
using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;
using Vec3u = Vec3<std::uint32_t>;

template <typename T> T dot(Vec3<T> a, Vec3<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename T> Vec3<T> cross(Vec3<T> a, Vec3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename T> T length(Vec3<T> a) {
  return std::sqrt(dot(a, a));
}

/// A colour of 8 bits a channel, in sRGB unless stated otherwise.
struct Rgba8 {
  std::uint8_t r = 0, g = 0, b = 0, a = 255;
  friend bool operator==(const Rgba8&, const Rgba8&) = default;
};

/// A colour of four channels, 0 .. 1, in sRGB unless stated otherwise. Sources of 8 bits a channel keep them exactly.
struct Rgba {
  float r = 0, g = 0, b = 0, a = 1;

  constexpr Rgba() = default;
  constexpr Rgba(float red, float green, float blue, float alpha) : r(red), g(green), b(blue), a(alpha) {}
  constexpr Rgba(Rgba8 bytes) // not explicit: bytes are the usual form of colours
      : r(static_cast<float>(bytes.r / 255.0)), g(static_cast<float>(bytes.g / 255.0)),
        b(static_cast<float>(bytes.b / 255.0)), a(static_cast<float>(bytes.a / 255.0)) {}
  friend bool operator==(const Rgba&, const Rgba&) = default;
};

/// The nearest of 0 .. 255 to a channel, which is clamped; NaN becomes 0.
inline std::uint8_t channelByte(double channel) {
  return channel > 0 ? static_cast<std::uint8_t>(std::lround(std::min(channel, 1.0) * 255)) : std::uint8_t{0};
}

/// A source's channel, clamped to 0 .. 1; NaN becomes 0. 0.7 is half-way between the bytes 178 and 179, but the float
/// nearest to it is not: where that changes the byte, the next float is taken. A float stands for the decimal number
/// that it was read from, so that its product with 255 is rounded as a float.
template <typename Number> float channelOf(Number number) {
  const Number fraction = number > 0 ? std::min(number, Number{1}) : 0;
  const auto byte = static_cast<std::uint8_t>(std::lround(fraction * 255));
  const auto nearest = static_cast<float>(fraction);
  const std::uint8_t nearestByte = channelByte(nearest);
  return nearestByte == byte ? nearest : std::nextafter(nearest, nearestByte < byte ? 2.0f : -1.0f);
}

/// The nearest colour of 8 bits a channel.
inline Rgba8 asRgba8(const Rgba& color) {
  return {channelByte(color.r), channelByte(color.g), channelByte(color.b), channelByte(color.a)};
}

/// Whether 8 bits a channel hold the colour exactly.
inline bool isRgba8(const Rgba& color) {
  return Rgba(asRgba8(color)) == color;
}

/// An axis-aligned box; empty until a point is added.
struct Box3d {
  Vec3d min{+std::numeric_limits<double>::infinity(), +std::numeric_limits<double>::infinity(),
            +std::numeric_limits<double>::infinity()};
  Vec3d max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};

  bool empty() const { return !(min.x <= max.x); }
  void add(Vec3d p) {
    for (int axis = 0; axis < 3; ++axis) {
      min[axis] = std::min(min[axis], p[axis]);
      max[axis] = std::max(max[axis], p[axis]);
    }
  }
  Vec3d center() const { return (min + max) * 0.5; }
  Vec3d size() const { return empty() ? Vec3d{} : max - min; }
  double longestEdge() const { return std::max({size().x, size().y, size().z}); }
  friend bool operator==(const Box3d&, const Box3d&) = default;
};

} // namespace imgeo
