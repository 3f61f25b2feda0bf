// Options of convert for compact.

#include "containers/compact/compact.h"
#include "containers/option_checks.h"

namespace imgeo {

void resolveCompactOptions(ConvertOptions& options) {
  requireNoElementTypes(options);
  if (options.normalBits == 0)
    options.normalBits = 8;
  if (options.target == Target::x3dom)
    refuseOption("--profile", "X3DOM reads no compact images; it reads classic ones");
  if (options.primitives == Primitives::strips)
    refuseOption("--primitives", "compact holds triangles, lines and points; strips are --profile classic's");
  if (!options.indexed)
    refuseOption("--index", "compact always has an index; --profile classic need not");
  if (options.normals == NormalEncoding::rgb)
    options.normals = NormalEncoding::octahedral;
  if (options.normals != NormalEncoding::octahedral && options.normals != NormalEncoding::derived)
    refuseOption("--normals", std::string("compact stores octahedral normals or derives them, but has no ") +
                                  nameOf(options.normals) + " ones");
  requireWithin("--normal-bits", options.normalBits, 4, 16);
  requireWithin("--patch-vertices", options.patchVertices, 256, compactEncoding.capabilities.maxPatchVertices);
}

} // namespace imgeo
