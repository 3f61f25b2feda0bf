#pragma once
// The input files of a command that takes one file, or the frames of a sequence.

#include <filesystem>
#include <string>
#include <vector>

namespace imgeo::cli {

/// Whether `a` comes before `b` in the order in which people number files: runs of digits count as numbers, so that
/// frame-9.ply comes before frame-10.ply.
bool isBeforeInNaturalOrder(const std::string& a, const std::string& b);

/// The files that `words` name: paths, or patterns in quotes of which the last part has * or ?, as a shell has them, or
/// one number as printf writes it (frame-%04d.ply). Several files are in natural order. Throws Error{usage} for a
/// pattern that no file has, and Error{io} where a number is missing between numbered files.
std::vector<std::filesystem::path> inputFiles(const std::vector<std::string>& words);

} // namespace imgeo::cli
