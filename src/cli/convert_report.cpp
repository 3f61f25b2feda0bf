#include "cli/convert_report.h"

#include "cli/choices.h"
#include "cli/element_counts.h"
#include "cli/terminal.h"
#include "containers/encodings.h"

#include <array>
#include <cmath>
#include <fmt/format.h>

namespace imgeo::cli {

namespace {

void printLine(const std::string& label, const std::string& text) {
  fmt::print("{} {}\n", bold(fmt::format("{:10}", label)), text);
}

std::string positionsOf(const Arguments& arguments, const ConvertReport& report) {
  const bool asFloats = arguments.text("coord-type") == "float32";
  const std::string lattice = asFloats && arguments.text("position-bits").empty() ? "the source's numbers"
                              : report.minPositionBits < report.maxPositionBits
                                  ? fmt::format("{} to {} bits: steps of up to {:.4g}", report.minPositionBits,
                                                report.maxPositionBits, report.maxStep)
                                  : fmt::format("{} bits: step {:.4g}", report.maxPositionBits, report.maxStep);
  // Rounding moves some vertex by nearly half a step, unless all lie on the lattice already.
  const bool isOfSource = !asFloats && report.positionError < 0.25 * report.maxStep;
  return fmt::format("{}{}{}, so off by at most {:.4g} an axis, in units of the source", lattice,
                     asFloats ? " as float32" : "", isOfSource ? ", as in the source" : "", report.positionError);
}

/// "z up, guessed: it stands upright along z ... (--up states another axis)"
std::string upOf(const SourceAxesReport& report) {
  return report.isGuess
             ? fmt::format("{}, guessed: {} (--up states another axis)", nameOf(report.axes.up), report.upReason)
             : fmt::format("{}, {}", nameOf(report.axes.up), report.upReason);
}

/// "12 files: 34.1 MB as found, 3.2 MB as written; 2 made smaller, 10 re-encoded; 12 previews of 14 kB"
std::string texturesOf(const TextureReport& textures) {
  std::string text =
      fmt::format("{} {}: {} as found, {} as written", textures.files, textures.files == 1 ? "file" : "files",
                  byteSize(textures.sourceBytes), byteSize(textures.bytes));
  if (textures.resized + textures.reencoded > 0)
    text += fmt::format("; {} made smaller, {} re-encoded", textures.resized, textures.reencoded);
  if (textures.previews > 0)
    text += fmt::format("; {} {} of {}", textures.previews, textures.previews == 1 ? "preview" : "previews",
                        byteSize(textures.previewBytes));
  return text;
}

/// "26 geometry images, 65,528 texels: off by at most 0.1 (0.2 % of the diagonal), 0.01 (0.02 %) in the mean"
std::string resampledText(const std::vector<ResampledMesh>& meshes) {
  ResampledMesh sum;
  double largestShare = 0, meanShare = 0;
  for (const ResampledMesh& mesh : meshes) {
    sum.geometryImages += mesh.geometryImages;
    sum.texels += mesh.texels;
    sum.largestDistance = std::max(sum.largestDistance, mesh.largestDistance);
    sum.meanDistance = std::max(sum.meanDistance, mesh.meanDistance);
    largestShare = std::max(largestShare, mesh.largestDistance / mesh.diagonal);
    meanShare = std::max(meanShare, mesh.meanDistance / mesh.diagonal);
  }
  return fmt::format("{} of {} texels; the surface is off by at most {:.4g} ({:.3g} % of the box's diagonal), by "
                     "{:.4g} ({:.3g} %) in the mean",
                     sum.geometryImages == 1 ? "a geometry image"
                                             : fmt::format("{} geometry images", grouped(sum.geometryImages)),
                     grouped(sum.texels), sum.largestDistance, 100 * largestShare, sum.meanDistance, 100 * meanShare);
}

void printTextures(const TextureReport& textures) {
  if (textures.files > 0)
    printLine("textures", texturesOf(textures));
}

/// "computed: triangles count by their area"
std::string normalSourceText(const Arguments& arguments, const ConvertReport& report) {
  if (!report.normalsComputed)
    return "the source's, where it has any";
  const std::string& degrees = arguments.text("crease-angle");
  const std::string creases = degrees.empty()    ? ""
                              : degrees == "180" ? ", smooth"
                                                 : fmt::format(", sharp above {} degrees", degrees);
  switch (valueNamed(normalWeightingChoices, arguments.text("normal-weighting"))) {
  case NormalWeighting::area:
    return "computed: triangles count by their area" + creases;
  case NormalWeighting::angle:
    return "computed: triangles count by their angle" + creases;
  case NormalWeighting::uniform:
    break;
  }
  return "computed: triangles count by one each" + creases;
}

/// "sharp above 39 degrees in 2 of 3 meshes, guessed: ..."
std::string guessedEdgesOf(const EdgeReport& edges) {
  const std::size_t guessed = edges.guessedSharp + edges.guessedSmooth;
  if (edges.guessedSharp == 0)
    return "smooth, guessed: few flat faces meet at edges, as in scans (--crease-angle states where edges are sharp)";
  const std::string part =
      edges.guessedSmooth > 0 ? fmt::format(" in {} of {} meshes", grouped(edges.guessedSharp), grouped(guessed)) : "";
  return fmt::format("sharp above {} degrees{}, guessed: flat faces meet at edges, as in man-made objects "
                     "(--crease-angle states another angle, 180: smooth)",
                     manMadeCreaseDegrees, part);
}

void printWelding(const Arguments& arguments, const ConvertReport& report) {
  const WeldReport& weld = report.weld;
  const DroppedElements dropped = valueNamed(dropChoices, arguments.text("drop"));
  printLine("welding", fmt::format("merged {} positions and {} wedges, dropped {} unreferenced positions",
                                   grouped(weld.mergedPositions), grouped(weld.mergedWedges),
                                   grouped(weld.unreferencedPositions)));
  if (weld.degenerateElements + weld.duplicateElements == 0)
    return;
  const bool isStrips = arguments.text("primitives") == "strips"; // strips draw no degenerate triangles
  printLine("", fmt::format("{} {} degenerate elements, {} {} repeated ones",
                            dropped.degenerate || isStrips ? "dropped" : "kept", grouped(weld.degenerateElements),
                            dropped.repeated ? "dropped" : "kept", grouped(weld.duplicateElements)));
}

/// "7 of at most 65,512 vertices", "4 grids of at most 263,169 vertices"
std::string patchesText(const ConvertReport& report) {
  const std::string largest = fmt::format("of at most {} vertices", grouped(report.largestPatch));
  if (report.grids == 0 || report.grids < report.patches)
    return fmt::format("{} {}{}", report.patches, largest,
                       report.grids > 0 ? fmt::format(", {} of them grids", report.grids) : "");
  return fmt::format("{} {} {}", report.grids, report.grids == 1 ? "grid" : "grids", largest);
}

void printChoices(const Arguments& arguments, const ConvertReport& report) {
  const EncodingRow& row = rowOf(report.encoding);
  printLine("source", fmt::format("{}, {}", report.format, byteSize(report.sourceBytes)));
  if (report.frames > 0)
    printLine("sequence",
              fmt::format("{} frames, {:.6g} a second: {}, {} each", grouped(report.frames), report.frameRate,
                          byteSize(report.frameBytes), byteSize(report.frameBytes / report.frames)));
  if (report.videoBytes > 0)
    printLine("video", fmt::format("lossless VP9: {}, {} a frame", byteSize(report.videoBytes),
                                   byteSize(report.videoBytes / report.frames)));
  printLine("up", upOf(report.axes));
  if (report.axes.axes.scale != 1)
    printLine("scale",
              fmt::format("{:.6g} metres a unit; the unit is {}", report.axes.axes.scale, report.axes.unitReason));
  if (report.origin != std::array<double, 3>{})
    printLine("origin", fmt::format("{} {} {}: subtracted from the source's coordinates, which are far from zero",
                                    report.origin[0], report.origin[1], report.origin[2]));
  if (report.axes.axes.exaggeration != 1)
    printLine("heights", fmt::format("exaggerated {:.6g} times", report.axes.axes.exaggeration));
  if (report.patches == 0) { // a scene of a few primitives
    printLine("elements", "none to encode: what geometry there is stays in the document as it is");
    return printTextures(report.textures);
  }
  printLine("elements", fmt::format("{} of {} vertices", listed(report.elements), grouped(report.vertices)));
  const bool onlyPoints = report.elements.points == report.elements.sum();
  printLine("container",
            fmt::format("{} ({}), profile {}, target {}, {}{}", row.container,
                        arguments.text("images") == "webp" ? "PNG and lossless WebP images" : row.fileKind, row.profile,
                        arguments.text("target"), onlyPoints ? "points" : arguments.text("primitives"),
                        onlyPoints || arguments.text("index") == "on" ? "" : " without index"));
  if (!report.x3domUrl.empty())
    printLine("X3DOM", fmt::format("{}, from {}", report.x3domVersion, report.x3domUrl));
  if (!report.resampled.empty())
    printLine("resampled", resampledText(report.resampled));
  printLine("positions", positionsOf(arguments, report));
  if (report.collapsed.sum() > 0)
    printLine("", fmt::format("too coarse for {}: they have lost their area or length", listed(report.collapsed)));
  if (report.hasNormals)
    printLine("normals",
              fmt::format("{}, {} bits: off by at most {:.2g} degrees; {}", nameOf(report.normalEncoding),
                          report.normalBits, report.normalErrorDegrees, normalSourceText(arguments, report)));
  const EdgeReport& edges = report.edges;
  if (edges.guessedSharp + edges.guessedSmooth > 0 && report.hasNormals)
    printLine("edges", guessedEdgesOf(edges));
  if (edges.flat > 0)
    printLine("edges", fmt::format("sharp in {} {} without normals, whose triangles are flat (--crease-angle 180: "
                                   "smooth)",
                                   grouped(edges.flat), edges.flat == 1 ? "mesh" : "meshes"));
  const auto bitsOf = [&](std::uint32_t bits) {
    return row.storage != PatchStorage::arrays ? fmt::format("{} bits: ", bits) : "";
  };
  if (report.texCoordError)
    printLine("texcoords", fmt::format("{}off by at most {:.3g}", bitsOf(report.texCoordBits), *report.texCoordError));
  if (report.hasColors)
    printLine("colours",
              bitsOf(report.colorBits) + (report.colorError == 0
                                              ? "as in the source"
                                              : fmt::format("off by at most {:.2g} of 255", 255 * report.colorError)));
  for (const AttributeReport& attribute : report.attributes)
    printLine("attribute",
              fmt::format("{}: {} bits, off by at most {:.3g}", attribute.name, attribute.bits, attribute.error));
  if (const InstanceReport& instances = report.instances; instances.shapes > 0)
    printLine("instances", fmt::format("{} {} the mesh of another shape, moved, within {:.3g}; {} {} not stored",
                                       grouped(instances.shapes), instances.shapes == 1 ? "shape shows" : "shapes show",
                                       instances.largestDistance, grouped(instances.meshes),
                                       instances.meshes == 1 ? "mesh is" : "meshes are"));
  printTextures(report.textures);
  if (report.resampledTextures > 0)
    printLine("", fmt::format("images of the groups of {} {} are resampled: the charts of the source are too small",
                              grouped(report.resampledTextures), report.resampledTextures == 1 ? "mesh" : "meshes"));
  printLine("patches", patchesText(report));
  printWelding(arguments, report);
}

void printBytes(const ConvertReport& report) {
  fmt::print("\n{}\n", bold(fmt::format("{:10} {:>7} {:>14} {:>16}", "role", "files", "bytes", "bytes/triangle")));
  RoleBytes sum{"together", 0, 0};
  const auto print = [&](const RoleBytes& role) {
    const std::size_t triangles = report.elements.triangles;
    const bool hasTriangles = triangles > 0;
    const double each = hasTriangles ? static_cast<double>(role.bytes) / static_cast<double>(triangles) : 0;
    fmt::print("{:10} {:>7} {:>14} {:>16}\n", role.role, role.files, grouped(role.bytes),
               hasTriangles ? fmt::format("{:.3f}", each) : "");
  };
  for (const RoleBytes& role : report.roles) {
    print(role);
    sum.bytes += role.bytes;
    sum.files += role.files;
  }
  print(sum);
  if (report.elements.triangles > 0)
    fmt::print("\nGeometry takes {:.3f} bytes a triangle, its nodes in the document included.\n",
               report.bytesPerTriangle);
}

void printPrecompressed(const PrecompressReport& report) {
  if (report.files > 0)
    fmt::print("Compressed in advance: {} {} of {}, to load as {} with brotli, {} with gzip.\n", report.files,
               report.files == 1 ? "file" : "files", byteSize(report.bytes), byteSize(report.brotliBytes),
               byteSize(report.gzipBytes));
}

/// ", 83 bytes a triangle"; empty if there are no triangles.
std::string bytesPerTriangleOf(const ConvertReport& report) {
  return report.elements.triangles == 0
             ? ""
             : fmt::format(", {} bytes a triangle", grouped(report.peakMemoryBytes / report.elements.triangles));
}

} // namespace

void printReport(const Arguments& arguments, const ConvertReport& report) {
  printChoices(arguments, report);
  printBytes(report);
  printPrecompressed(report.precompressed);
}

void printCosts(const ConvertReport& report) {
  fmt::print("It took {:.2f} s (import {:.2f}, prepare {:.2f}, encode {:.2f}) and at most {} of memory{}.\n",
             report.totalSeconds, report.importSeconds, report.prepareSeconds, report.encodeSeconds,
             byteSize(report.peakMemoryBytes), bytesPerTriangleOf(report));
  if (report.tasks > 0)
    fmt::print("This rank has done {} of {} tasks.\n", report.tasksTaken, report.tasks);
}

} // namespace imgeo::cli
