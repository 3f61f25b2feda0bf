#include "transcode/out_of_core/source_passes.h"

#include "transcode/out_of_core/region_files.h"

#include <fmt/format.h>

namespace imgeo {

namespace {

/// The share of the whole work that the survey has.
constexpr double surveyShare = 0.04;

/// The residuals of all positions. `pass`: 0 or 1.
LatticeResiduals residualsOf(const SourcePieces& pieces, Passes& passes, const Lattice& lattice, std::uint32_t pass) {
  const auto fileOf = [&](std::size_t chunk) { return taskFile("lattice", pass, chunk); };
  passes.run({.name = "finding the lattice of the source",
              .count = pieces.mesh.chunkCount(),
              .atOnce = pieces.atOnce,
              .doneFile = fmt::format("lattice-{}-done", pass),
              .fileOf = fileOf,
              .task = [&](std::size_t chunk) {
                const Imported piece = readPiece(pieces.mesh, chunk, pieces.importOptions, pieces.options);
                WorkWriter out;
                out.add(residualsOn(piece.scene.meshes.at(0).positions, lattice));
                return std::move(out.bytes);
              }});
  LatticeResiduals residuals;
  for (std::size_t chunk = 0; chunk < pieces.mesh.chunkCount(); ++chunk) {
    const std::string path = pieces.work.file(fileOf(chunk));
    const Bytes bytes = readFile(path);
    residuals.add(WorkReader(bytes, path).take<LatticeResiduals>());
  }
  return residuals;
}

} // namespace

Survey surveySource(const SourcePieces& pieces, Passes& passes) {
  const auto fileOf = [](std::size_t chunk) { return taskFile("survey", 0, chunk); };
  passes.run({.name = "reading",
              .share = surveyShare,
              .count = pieces.mesh.chunkCount(),
              .atOnce = pieces.atOnce,
              .doneFile = "survey-done",
              .fileOf = fileOf,
              .task = [&](std::size_t chunk) {
                return writeSurvey(surveyPiece(pieces.mesh, chunk, pieces.importOptions, pieces.options));
              }});
  Survey survey;
  for (std::size_t chunk = 0; chunk < pieces.mesh.chunkCount(); ++chunk) {
    const std::string path = pieces.work.file(fileOf(chunk));
    survey.add(readSurvey(readFile(path), path));
  }
  return survey;
}

std::optional<SourceLattice> findSourceLattice(const SourcePieces& pieces, Passes& passes,
                                               std::span<const Vec3f> sample, const Lattice& requested) {
  const std::optional<Lattice> guess = guessSourceLattice(sample, requested);
  if (!guess)
    return std::nullopt;
  const Lattice centered = centeredLattice(*guess, residualsOf(pieces, passes, *guess, 0), requested);
  return acceptedLattice(centered, residualsOf(pieces, passes, centered, 1), requested);
}

} // namespace imgeo
