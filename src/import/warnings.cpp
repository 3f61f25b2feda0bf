#include "import/warnings.h"

#include "import/mesh/triangulate.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace imgeo {

std::string counted(std::uint64_t count, const std::string& singular, const std::string& plural) {
  return fmt::format("{} {}", count, count == 1 ? singular : plural);
}

std::string withoutFullStop(const std::string& sentence) {
  return sentence.ends_with('.') ? sentence.substr(0, sentence.size() - 1) : sentence;
}

std::string leftOut(const Error& damage) {
  return fmt::format("Left out: {}.", damage.what());
}

void addOmissions(std::vector<std::string>& warnings, const std::vector<std::string>& omissions, bool isStrict,
                  const std::string& sourceName) {
  if (isStrict && !omissions.empty()) {
    const std::string first = withoutFullStop(omissions.front());
    const std::size_t end = first.starts_with(sourceName + ":") ? first.find(": ") : first.npos; // FILE:LINE: SENTENCE
    if (end != first.npos)
      throw Error(ErrorKind::malformed, first.substr(0, end), first.substr(end + 2));
    throw Error(ErrorKind::malformed, sourceName, first);
  }
  std::ranges::copy(omissions, std::back_inserter(warnings));
}

void warnOfRounding(std::vector<std::string>& warnings, double maxRounding, double longestEdge) {
  if (maxRounding > longestEdge / 131072)
    warnings.push_back(
        fmt::format("Coordinates far from the origin were rounded to single precision, by up to {:.2g}.", maxRounding));
}

void warnOfSmallFaces(std::vector<std::string>& warnings, std::uint64_t faces) {
  if (faces > 0)
    warnings.push_back(fmt::format("{} left out: fewer than three corners.", counted(faces, "face was", "faces were")));
}

void warnOfFans(std::vector<std::string>& warnings, std::uint64_t polygons) {
  if (polygons > 0)
    warnings.push_back(fmt::format("{} cut as a fan, which may overlap itself: concave, with more than {} corners.",
                                   counted(polygons, "polygon was", "polygons were"), maxEarClippedCorners));
}

void warnOfNormals(std::vector<std::string>& warnings, std::uint64_t normals) {
  if (normals > 0)
    warnings.push_back(
        fmt::format("{} replaced by (0, 0, 1): without direction.", counted(normals, "normal was", "normals were")));
}

void warnOfColors(std::vector<std::string>& warnings, std::uint64_t values) {
  if (values > 0)
    warnings.push_back(fmt::format("{} outside the range of the type and clamped to it.",
                                   counted(values, "colour value was", "colour values were")));
}

} // namespace imgeo
