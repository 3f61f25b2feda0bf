#include "transcode/options.h"

#include "base/error.h"
#include "containers/limits.h"
#include "containers/normals.h"
#include "prepare/patches.h"

#include <fmt/format.h>

namespace imgeo {

namespace {

[[noreturn]] void refuse(const char* option, const std::string& why) {
  throw Error(ErrorKind::usage, option, why);
}

void requireWithin(const char* option, std::int64_t value, std::int64_t least, std::int64_t most) {
  if (value < least || value > most)
    refuse(option, fmt::format("{} is not within {}..{}", value, least, most));
}

bool has16BitCoords(const ConvertOptions& options) {
  return coordBytes(Container::bg, options.positionBits) == 2;
}

/// Two numbers of a byte each fit beside 16-bit coordinates without taking any room.
std::uint32_t defaultNormalBits(const ConvertOptions& options) {
  const bool roomless = options.container == Container::bg && !has16BitCoords(options);
  return options.normals == NormalEncoding::octahedral && roomless ? 16 : 8;
}

void requireNormals(const ConvertOptions& options) {
  const std::uint32_t bits = options.normalBits;
  if (options.container == Container::sig) {
    if (bits != 8)
      refuse("--normal-bits", fmt::format("sig stores normals in 8 bits, not {}; bg also in 16 or 32", bits));
    if (options.target == Target::x3dom && isPair(options.normals))
      refuse("--normals", fmt::format("X3DOM reads no {} normals from images; rgb and palette it does",
                                      nameOf(options.normals)));
    return;
  }
  switch (options.normals) {
  case NormalEncoding::rgb:
    if (bits != 8 && bits != 16 && bits != 32)
      refuse("--normal-bits", fmt::format("bg stores normals in 8, 16 or 32 bits, not {}", bits));
    return;
  case NormalEncoding::palette:
    refuse("--normals", "a palette belongs to images, and bg has none");
  case NormalEncoding::octahedral:
    if (options.target == Target::x3dom)
      refuse("--normals", "X3DOM reads no octahedral normals; spherical ones take the same room");
    if (bits != 16 && (bits != 8 || !has16BitCoords(options)))
      refuse("--normal-bits", fmt::format("octahedral normals have 16 bits in bg, or 8 beside coordinates of "
                                          "9..16 bits, not {}",
                                          bits));
    return;
  case NormalEncoding::spherical:
    if (bits != 8)
      refuse("--normal-bits", fmt::format("spherical normals have 8 bits, not {}", bits));
    if (!has16BitCoords(options))
      refuse("--normals", "spherical normals in bg lie beside coordinates of 9..16 bits");
  }
}

} // namespace

ConvertOptions resolved(ConvertOptions options) {
  requireWithin("--position-bits", options.positionBits, 8, 32);
  requireWithin("--patch-vertices", options.patchVertices, 256, maxPatchWedges);
  requireWithin("--effort", options.effort, 0, 9);
  if (options.normalBits == 0)
    options.normalBits = defaultNormalBits(options);
  requireNormals(options);
  if (options.target == Target::x3dom && options.container == Container::bg && options.positionBits > 16)
    refuse("--position-bits",
           fmt::format("X3DOM reads bg with at most 16 bits, not {}; sig holds more", options.positionBits));
  if (options.target == Target::x3dom && options.container == Container::sig &&
      options.patchVertices > maxShortIndexedVertices)
    refuse("--patch-vertices",
           fmt::format("X3DOM's index images name at most 65,535 vertices, not {}; bg's arrays more",
                       options.patchVertices));
  if (options.target != Target::x3dom && !options.x3domUrl.empty())
    refuse("--x3dom-url", "only a page for X3DOM needs X3DOM: --target x3dom");
  return options;
}

} // namespace imgeo
