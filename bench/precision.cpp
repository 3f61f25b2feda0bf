// Precision on demand in compact: bytes of a mesh in two parts, the high bits of all positions first and their low bits
// after them, compared with one part of all bits. The first part is a compact file of fewer bits. The second part has
// the low bits, coded by adaptive probabilities given everything that the reader knows by then, and the normals, which
// are predicted from exact positions as in one part; it is decoded again before it is counted. Beside it, what a level
// of fewer triangles takes, as base meshes are made, and how far the mesh is from it. Prints the tables of
// docs/decisions/precision.md.
//
//   build/bench/precision [--effort 0..9] MODEL...

#include "bench/models.h"
#include "containers/compact/base.h"
#include "containers/compact/compact.h"
#include "containers/compact/range_decoder.h"
#include "containers/compact/range_encoder.h"
#include "containers/container_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <limits>
#include <optional>

namespace imgeo {
namespace {

using compact::RangeDecoder;
using compact::RangeEncoder;

/// The corners a, b, c of a parallelogram that predict a vertex as a + b - c.
struct Parallelogram {
  std::uint32_t a = 0, b = 0, c = 0;
};

/// For each vertex of a patch, the parallelograms across the edges of its triangles that do not contain it.
std::vector<std::vector<Parallelogram>> parallelogramsOf(const IndexedPatch& patch) {
  struct HalfEdge {
    std::uint64_t key; ///< its vertices, the smaller one first
    std::uint32_t opposite;
  };
  std::vector<HalfEdge> edges;
  for (const Vec3u& triangle : trianglesOf(patch))
    for (const auto& [a, b, opposite] :
         {std::array{triangle.x, triangle.y, triangle.z}, std::array{triangle.y, triangle.z, triangle.x},
          std::array{triangle.z, triangle.x, triangle.y}})
      edges.push_back({std::uint64_t{std::min(a, b)} << 32 | std::max(a, b), opposite});
  std::stable_sort(edges.begin(), edges.end(), [](const auto& x, const auto& y) { return x.key < y.key; });
  std::vector<std::vector<Parallelogram>> all(patch.vertexCount());
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (edges[i].key != edges[i - 1].key)
      continue;
    const auto a = static_cast<std::uint32_t>(edges[i].key >> 32), b = static_cast<std::uint32_t>(edges[i].key);
    const std::uint32_t c = edges[i - 1].opposite, d = edges[i].opposite;
    all[d].push_back({a, b, c});
    all[c].push_back({a, b, d});
  }
  return all;
}

/// Codes the low bits of positions whose high bits and triangles are known, in the order of the vertices. The same code
/// encodes and decodes.
template <typename Coder> class LowBits {
public:
  static constexpr std::uint32_t contexts = 18, classes = 6, modeledBits = 4;
  static constexpr std::size_t modelCount = std::size_t{3} * classes * contexts << modeledBits;

  LowBits(Coder& coder, std::uint32_t lowBits) : coder_(coder), lowBits_(lowBits) {}

  /// `positions` have all bits; a decoder sets the low ones.
  void code(std::vector<Vec3u>& positions, const std::vector<std::vector<Parallelogram>>& parallelograms) {
    for (std::uint32_t vertex = 0; vertex < positions.size(); ++vertex) {
      codeAxis(positions, parallelograms[vertex], vertex, &Vec3u::x, 0);
      codeAxis(positions, parallelograms[vertex], vertex, &Vec3u::y, 1);
      codeAxis(positions, parallelograms[vertex], vertex, &Vec3u::z, 2);
    }
  }

private:
  /// A vertex that comes later is in the middle of its step of the first part.
  double knownValue(const std::vector<Vec3u>& positions, std::uint32_t of, std::uint32_t vertex,
                    std::uint32_t Vec3u::*axis) const {
    const std::uint32_t value = positions[of].*axis;
    return of < vertex ? value : (value >> lowBits_ << lowBits_) + 0.5 * ((1u << lowBits_) - 1);
  }

  void codeAxis(std::vector<Vec3u>& positions, const std::vector<Parallelogram>& parallelograms, std::uint32_t vertex,
                std::uint32_t Vec3u::*axis, std::size_t axisIndex) {
    const double step = 1u << lowBits_;
    std::uint32_t& value = positions[vertex].*axis;
    const std::uint32_t high = value >> lowBits_ << lowBits_;
    // The mean of the parallelograms, each with the inverse of its expected squared error.
    double sum = 0, weights = 0;
    for (const auto& [a, b, c] : parallelograms) {
      const double unknown = (a > vertex) + (b > vertex) + (c > vertex);
      const double weight = 1 / (squaredError_[axisIndex] + unknown * step * step / 12);
      sum += weight * (knownValue(positions, a, vertex, axis) + knownValue(positions, b, vertex, axis) -
                       knownValue(positions, c, vertex, axis));
      weights += weight;
    }
    const double predicted = weights > 0 ? sum / weights : high + 0.5 * step;
    const double spread = weights > 0 ? 1 / std::sqrt(weights) : step;
    const double offset = (predicted - high) / step; // 0 .. 1 within the step
    const auto context = static_cast<std::uint32_t>(std::clamp(std::floor(offset * 16) + 1, 0.0, contexts - 1.0));
    const auto spreadClass =
        static_cast<std::uint32_t>(std::clamp(std::floor(std::log2(spread / step) + 4), 0.0, classes - 1.0));
    const std::size_t models = ((axisIndex * classes + spreadClass) * contexts + context) << modeledBits;
    const std::uint32_t modeled = std::min(lowBits_, modeledBits), plain = lowBits_ - modeled;
    std::uint32_t leaf = 1;
    for (std::uint32_t level = lowBits_; level-- > plain;)
      leaf = leaf << 1 | std::uint32_t{coder_.bit(models + leaf, value >> level & 1)};
    const std::uint32_t low = (leaf - (1u << modeled)) << plain | coder_.raw(plain, value & ((1u << plain) - 1));
    value = high | low;
    if (weights > 0) {
      const double error = predicted - value;
      squaredError_[axisIndex] += (error * error - squaredError_[axisIndex]) / 256;
    }
  }

  Coder& coder_;
  std::uint32_t lowBits_;
  std::array<double, 3> squaredError_{100, 100, 100};
};

/// Bytes of the low bits of a patch in decoding order. Throws Error if they decode to something else.
std::size_t lowBitsSize(const IndexedPatch& patch, std::uint32_t lowBits) {
  const auto parallelograms = parallelogramsOf(patch);
  std::vector<Vec3u> positions = patch.positions;
  RangeEncoder encoder(LowBits<RangeEncoder>::modelCount);
  LowBits<RangeEncoder>(encoder, lowBits).code(positions, parallelograms);
  const Bytes bytes = encoder.finish();
  for (Vec3u& position : positions)
    position = {position.x >> lowBits << lowBits, position.y >> lowBits << lowBits, position.z >> lowBits << lowBits};
  const std::string location = "low bits";
  RangeDecoder decoder(bytes, LowBits<RangeDecoder>::modelCount, location);
  LowBits<RangeDecoder>(decoder, lowBits).code(positions, parallelograms);
  if (positions != patch.positions)
    throw Error(ErrorKind::malformed, location, "were written as something else");
  return bytes.size();
}

struct Encoded {
  std::size_t bytes = 0;
  double decodingSeconds = 0; ///< of processor time
  std::vector<IndexedPatch> patches;
};

Encoded encode(const PatchedMesh& mesh, int effort) {
  EncodeOptions options;
  options.encoding = Encoding::compact;
  options.normals = NormalEncoding::octahedral;
  options.effort = effort;
  const GeometryDescription geometry = describe(mesh, options);
  Encoded result;
  for (const Patch& patch : mesh.patches) {
    const EncodedPatch encoded = encodePatch(patch, geometry, options);
    for (const EncodedFile& file : encoded.files)
      result.bytes += file.bytes.size();
    const std::clock_t start = std::clock();
    result.patches.push_back(decodePatch(encoded, geometry));
    result.decodingSeconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }
  return result;
}

/// The mesh with the high bits of its positions, without normals.
PatchedMesh firstPartOf(PatchedMesh mesh, std::uint32_t lowBits) {
  mesh.lattice.bits -= lowBits;
  mesh.lattice.step *= 1u << lowBits;
  for (Patch& patch : mesh.patches) {
    patch.normals.clear();
    for (Vec3u& position : patch.positions)
      position = {position.x >> lowBits, position.y >> lowBits, position.z >> lowBits};
  }
  return mesh;
}

/// The distance of a point from a triangle (Ericson, "Real-Time Collision Detection", 2005, 5.1.5).
double distanceTo(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0)
    return length(ap);
  if (d3 >= 0 && d4 <= d3)
    return length(bp);
  if (d6 >= 0 && d5 <= d6)
    return length(cp);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0)
    return length(ap - ab * (d1 / (d1 - d3)));
  if (vb <= 0 && d2 >= 0 && d6 <= 0)
    return length(ap - ac * (d2 / (d2 - d6)));
  if (va <= 0 && d4 >= d3 && d5 >= d6)
    return length(bp - (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
  const double sum = va + vb + vc;
  return sum > 0 ? length(ap - ab * (vb / sum) - ac * (vc / sum)) : length(ap);
}

/// Bytes of a level of the mesh, and the distance from it of all but a hundredth of the mesh's vertices, in steps.
struct Level {
  std::size_t triangles = 0, bytes = 0;
  double distance = 0;
};

Level levelOf(const PatchedMesh& mesh, const BaseMesh& simplified, int effort) {
  EncodeOptions options;
  options.encoding = Encoding::compact;
  options.normals = NormalEncoding::octahedral;
  options.effort = effort;
  const std::array coded{quantiseBase(simplified, describe(mesh, options), 12, 8)};
  const BaseMesh level = meshOfBase(coded[0]);
  Level result{level.triangleCount(), baseFile(coded).bytes.size(), 0};
  constexpr std::size_t samples = 1000;
  std::vector<double> distances;
  std::size_t count = 0;
  for (const Patch& patch : mesh.patches)
    count += patch.positions.size();
  std::size_t index = 0;
  for (const Patch& patch : mesh.patches)
    for (const Vec3u& position : patch.positions) {
      if (index++ % std::max<std::size_t>(1, count / samples) != 0)
        continue;
      double nearest = std::numeric_limits<double>::max();
      for (std::size_t corner = 0; corner < level.corners.size(); corner += 3)
        nearest = std::min(nearest, distanceTo(Vec3d(position), Vec3d(level.cornerPosition(corner)),
                                               Vec3d(level.cornerPosition(corner + 1)),
                                               Vec3d(level.cornerPosition(corner + 2))));
      distances.push_back(nearest);
    }
  std::ranges::sort(distances);
  result.distance = distances[distances.size() * 99 / 100];
  return result;
}

/// Prints levels beside the first part of the same precision: views are exact up to the number of pixels along the
/// mesh's longest edge at which an error is half a pixel.
void printLevels(const PatchedMesh& mesh, std::size_t bytes, int effort) {
  fmt::print("\n| level | triangles | bytes | of one part | off by, in steps | exact up to, in pixels |\n"
             "|---|--:|--:|--:|--:|--:|\n");
  for (const double share : {2.0, 5.0, 10.0, 20.0})
    if (const std::optional<BaseMesh> simplified = baseOf(mesh, share)) {
      const Level level = levelOf(mesh, *simplified, effort);
      fmt::print("| {} % | {} | {} | {:.1f} % | {:.1f} | {:.0f} |\n", share, level.triangles, level.bytes,
                 100 * static_cast<double>(level.bytes) / static_cast<double>(bytes), level.distance,
                 0.5 * mesh.lattice.maximum() / level.distance);
      std::fflush(stdout);
    }
}

std::string percent(std::size_t part, std::size_t whole) {
  return fmt::format("{:.1f} %", 100 * static_cast<double>(part) / static_cast<double>(whole));
}

void printModel(const std::string& model, int effort) {
  bench::visitSurfaces(model, [&](const Mesh& mesh) {
    const PatchedMesh exact = bench::patchesOf(mesh);
    const Encoded one = encode(exact, effort), shape = encode(firstPartOf(exact, 0), effort);
    const std::size_t normals = one.bytes - shape.bytes, patches = exact.patches.size();
    fmt::print(
        "\n### {}: {} triangles, {} {}; one part: {} bytes, of them normals {}; decoding {:.0f} ms\n\n"
        "| bits of the first part | its bytes | of one part | low bits | of an ideal coder | both parts and normals "
        "| of one part | decoding the first part, ms |\n|--:|--:|--:|--:|--:|--:|--:|--:|\n",
        std::filesystem::path(model).filename().string(), mesh.elementCount(), patches,
        patches == 1 ? "patch" : "patches", one.bytes, normals, 1000 * one.decodingSeconds);
    for (const std::uint32_t lowBits : {2u, 4u, 6u}) {
      const Encoded first = encode(firstPartOf(exact, lowBits), effort);
      std::size_t low = 0;
      for (const IndexedPatch& patch : shape.patches)
        low += lowBitsSize(patch, lowBits);
      const std::size_t both = first.bytes + low + normals;
      fmt::print("| {} | {} | {} | {} | {} | {} | {} | {:.0f} |\n", 16 - lowBits, first.bytes,
                 percent(first.bytes, one.bytes), low, shape.bytes - std::min(shape.bytes, first.bytes), both,
                 percent(both, one.bytes), 1000 * first.decodingSeconds);
      std::fflush(stdout);
    }
    printLevels(exact, one.bytes, effort);
  });
}

} // namespace
} // namespace imgeo

int main(int count, char** words) {
  using namespace imgeo;
  return bench::run([&] {
    const bench::ModelArguments arguments = bench::modelArguments(count, words, "precision", 5);
    for (const std::string& model : arguments.models)
      printModel(model, arguments.effort);
  });
}
