#pragma once
// Sentences that several importers say.

#include <cstdint>
#include <string>
#include <vector>

namespace imgeo {

/// "1 face", "2 faces"
std::string counted(std::uint64_t count, const std::string& singular, const std::string& plural);

/// The sentence as part of a longer one.
std::string withoutFullStop(const std::string& sentence);

/// Adds what of a source is left out for its damage; if strict, the first is an Error that
/// names the source.
void addLosses(std::vector<std::string>& warnings, const std::vector<std::string>& losses, bool isStrict,
               const std::string& sourceName);

// Each adds its sentence where the count is not zero.
void warnOfSmallFaces(std::vector<std::string>& warnings, std::uint64_t faces);
void warnOfFans(std::vector<std::string>& warnings, std::uint64_t polygons);
void warnOfNormals(std::vector<std::string>& warnings, std::uint64_t normals);
void warnOfColors(std::vector<std::string>& warnings, std::uint64_t values);

} // namespace imgeo
