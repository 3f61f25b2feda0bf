// Options of convert for classic.

#include "containers/classic/classic.h"
#include "containers/limits.h"
#include "containers/normals.h"
#include "containers/option_checks.h"

namespace imgeo {

void resolveClassicOptions(ConvertOptions& options) {
  requireNoElementTypes(options);
  if (options.normalBits == 0)
    options.normalBits = 8;
  if (options.normals == NormalEncoding::derived)
    refuseOption("--normals", "only compact derives normals");
  if (imageCountOf(VertexRole::normal, options.normals, options.normalBits) == 0 || options.normalBits > 16)
    refuseOption("--normal-bits", std::string("images hold ") + nameOf(options.normals) + " normals of " +
                                      (options.normals == NormalEncoding::palette ? "8" : "8 or 16") + " bits, not " +
                                      std::to_string(options.normalBits));
  if (options.target != Target::x3dom)
    return;
  if (isPair(options.normals))
    refuseOption("--normals", std::string("X3DOM reads no ") + nameOf(options.normals) +
                                  " normals from images; rgb and palette it does");
  if (options.normalBits != 8)
    refuseOption("--normal-bits",
                 "X3DOM reads normals of 8 bits from images, not of " + std::to_string(options.normalBits));
  if (options.patchVertices > maxShortIndexedVertices)
    refuseOption("--patch-vertices", "X3DOM's index images name at most 65,535 vertices, not " +
                                         std::to_string(options.patchVertices) + "; bg's arrays more");
}

} // namespace imgeo
