#include "prepare/levels/drop_pieces.h"

#include "base/vec.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

namespace imgeo {

namespace {

struct Piece {
  Box3d box;
  std::size_t triangles = 0;
  bool isFixed = false;    ///< has a fixed position
  int power = 0;           ///< of the fourth root of two, of its diagonal
  std::uint64_t curve = 0; ///< number of its centre on a Morton curve
  bool isDropped = false;
};

/// Spreads the lower 20 bits to every third.
std::uint64_t spread(std::uint64_t value) {
  std::uint64_t result = 0;
  for (int bit = 0; bit < 20; ++bit)
    result |= (value >> bit & 1) << (3 * bit);
  return result;
}

/// Drops, of pieces of one power along the curve, an even selection that has about `triangles`.
std::size_t dropEvenly(std::span<Piece* const> pieces, std::size_t triangles) {
  std::size_t all = 0, dropped = 0;
  for (const Piece* piece : pieces)
    all += piece->triangles;
  const double share = std::min(1.0, static_cast<double>(triangles) / static_cast<double>(all));
  double due = 0; // triangles to be dropped so far
  for (Piece* piece : pieces) {
    due += share * static_cast<double>(piece->triangles);
    if (static_cast<double>(dropped) + static_cast<double>(piece->triangles) / 2 <= due) {
      piece->isDropped = true;
      dropped += piece->triangles;
    }
  }
  return dropped;
}

} // namespace

DisjointSets piecesOf(std::size_t positionCount, std::span<const std::uint32_t> corners) {
  DisjointSets sets(positionCount);
  for (std::size_t corner = 0; corner < corners.size(); corner += 3) {
    sets.merge(corners[corner], corners[corner + 1]);
    sets.merge(corners[corner], corners[corner + 2]);
  }
  return sets;
}

std::size_t countPieces(std::size_t positionCount, std::span<const std::uint32_t> corners) {
  DisjointSets sets = piecesOf(positionCount, corners);
  std::vector<bool> isRoot(positionCount);
  for (const std::uint32_t position : corners)
    isRoot[sets.find(position)] = true;
  return static_cast<std::size_t>(std::ranges::count(isRoot, true));
}

void dropPieces(SimplifiedTriangles& simplified, std::vector<bool>& isFixed, std::size_t triangleCount) {
  const std::vector<std::uint32_t>& corners = simplified.corners;
  std::size_t excess = corners.size() / 3 - std::min(corners.size() / 3, triangleCount);
  if (excess == 0)
    return;
  DisjointSets sets = piecesOf(simplified.positions.size(), corners);
  std::vector<Piece> pieces(simplified.positions.size()); // by the smallest position
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    Piece& piece = pieces[sets.find(corners[corner])];
    piece.box.add(Vec3d(simplified.positions[corners[corner]]));
    piece.isFixed = piece.isFixed || isFixed[corners[corner]];
    piece.triangles += corner % 3 == 0;
  }
  std::vector<Piece*> free;
  for (Piece& piece : pieces) {
    if (piece.triangles == 0 || piece.isFixed)
      continue;
    const Vec3d center = piece.box.center();
    const double diagonal = 1 + length(piece.box.size());
    piece.power = std::ilogb(diagonal * diagonal * diagonal * diagonal);
    for (int axis = 0; axis < 3; ++axis)
      piece.curve |= spread(static_cast<std::uint64_t>(center[axis]) >> 4) << axis;
    free.push_back(&piece);
  }
  const auto largest = std::ranges::max_element(
      pieces, {}, [](const Piece& piece) { return piece.triangles > 0 ? length(piece.box.size()) : -1.0; });
  std::erase(free, &*largest);
  std::ranges::stable_sort(free, {}, [](const Piece* piece) { return std::tie(piece->power, piece->curve); });
  for (auto first = free.begin(); first != free.end() && excess > 0;) {
    const auto last =
        std::find_if(first, free.end(), [&](const Piece* piece) { return piece->power != (*first)->power; });
    excess -= std::min(excess, dropEvenly({first, last}, excess));
    first = last;
  }

  SimplifiedTriangles kept;
  kept.inputArea = simplified.inputArea;
  std::vector<std::uint32_t> newIndices(simplified.positions.size(), SimplifiedTriangles::none);
  std::vector<bool> isKeptFixed;
  for (std::uint32_t position = 0; position < simplified.positions.size(); ++position)
    if (!pieces[sets.find(position)].isDropped) {
      newIndices[position] = static_cast<std::uint32_t>(kept.positions.size());
      kept.positions.push_back(simplified.positions[position]);
      isKeptFixed.push_back(isFixed[position]);
    }
  for (std::size_t triangle = 0; triangle < simplified.triangles.size(); ++triangle)
    if (newIndices[corners[3 * triangle]] != SimplifiedTriangles::none) {
      kept.triangles.push_back(simplified.triangles[triangle]);
      for (std::size_t i = 0; i < 3; ++i)
        kept.corners.push_back(newIndices[corners[3 * triangle + i]]);
    }
  for (const std::uint32_t vertex : simplified.vertexOfInput)
    kept.vertexOfInput.push_back(vertex == SimplifiedTriangles::none ? vertex : newIndices[vertex]);
  simplified = std::move(kept);
  isFixed = std::move(isKeptFixed);
}

} // namespace imgeo
