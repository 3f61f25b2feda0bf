#pragma once
// How a comparison out of core divides its work within a memory, and its folder.

#include "base/error.h"
#include "base/unfinished_files.h"
#include "imgeo/verify.h"
#include "transcode/out_of_core/work_folder.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace imgeo {

/// The least memory in which sites are compared out of core.
inline constexpr std::uint64_t minVerifyMemory = std::uint64_t{256} << 20;

/// Memory of a triangle, or point, of a mesh that is read as a whole, while others are compared.
inline constexpr std::uint64_t readElementBytes = 110;

/// An estimate of the memory in which so many triangles and points are compared with those of a site, where all are
/// read together, and their meshes are compared one after the other, of which the largest has so many.
std::uint64_t verifyMemoryInCore(std::uint64_t elements, std::uint64_t ofLargest);

/// An estimate of the memory that what is known of so many meshes takes beside, in the source and in the site.
std::uint64_t verifyStructureMemory(std::uint64_t meshes);

/// The triangles or points of a piece of a source in a memory, about.
std::uint64_t pieceTriangles(std::uint64_t memory);

/// Where the work folder is: as stated, or beside the site.
std::filesystem::path workFolderOf(const std::filesystem::path& site, const VerifyOptions& options);

/// What fails in the work folder while a site is read: no difference between the site and its input.
struct WorkFault {
  Error error;
};

class VerifyWork {
public:
  /// Makes the folder, which the destructor removes, and a signal that ends the process. `memory`: what is left of at
  /// least minVerifyMemory. Throws as WorkFolder does, and Error{usage} for the work folder of a conversion.
  VerifyWork(const std::filesystem::path& folder, std::uint64_t memory);
  ~VerifyWork();
  VerifyWork(const VerifyWork&) = delete;
  VerifyWork& operator=(const VerifyWork&) = delete;

  const WorkFolder& folder() const { return *folder_; }
  /// Begins with a mesh of the source, whose files are in a folder of their own within the work folder. Throws
  /// Error{io}.
  void beginMesh(std::size_t number);
  /// Removes that folder.
  void endMesh();
  /// Begins with the meshes that are compared as a whole, whose files are in a folder of their own until the end.
  void beginWholeMeshes();
  std::uint32_t regionTriangles() const { return regionTriangles_; } ///< of a region, about
  std::uint64_t pieceTriangles() const { return pieceTriangles_; }   ///< of what is scattered at once

  std::uint64_t batchElements() const { return batchElements_; } ///< of whole meshes that are read at once

  /// Writes a work file. Throws WorkFault.
  void write(const std::string& name, ByteSpan bytes) const;

  /// Calls task(i) for each i below `count`, few enough at a time for the memory.
  void forEach(std::size_t count, const std::function<void(std::size_t)>& task) const;

private:
  std::uint32_t regionTriangles_ = 0;
  std::uint64_t pieceTriangles_ = 0, batchElements_ = 0;
  std::size_t atOnce_ = 1;
  std::optional<UnfinishedFile> unfinished_;
  std::optional<WorkFolder> folder_;
};

} // namespace imgeo
