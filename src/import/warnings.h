#pragma once
// Warnings that several formats share.

#include "base/error.h"

#include <cstdint>
#include <string>
#include <vector>

namespace imgeo {

/// "1 face", "2 faces"
std::string counted(std::uint64_t count, const std::string& singular, const std::string& plural);

/// The sentence without its full stop, for use in a longer one.
std::string withoutFullStop(const std::string& sentence);

/// The warning about a part that is left out because it is damaged.
std::string leftOut(const Error& damage);

/// Adds the warnings about content that was left out because it is damaged. If strict, throws the first as an
/// Error{malformed} that names the source, once: an omission may begin with "FILE:LINE: ".
void addOmissions(std::vector<std::string>& warnings, const std::vector<std::string>& omissions, bool isStrict,
                  const std::string& sourceName);

/// Adds a warning where single precision has moved coordinates of a source by more than half a step of 16 bits over
/// `longestEdge`, that of their box.
void warnOfRounding(std::vector<std::string>& warnings, double maxRounding, double longestEdge);

// Each adds one sentence where the count is not zero.
void warnOfSmallFaces(std::vector<std::string>& warnings, std::uint64_t faces);
void warnOfFans(std::vector<std::string>& warnings, std::uint64_t polygons);
void warnOfNormals(std::vector<std::string>& warnings, std::uint64_t normals);
void warnOfColors(std::vector<std::string>& warnings, std::uint64_t values);

} // namespace imgeo
