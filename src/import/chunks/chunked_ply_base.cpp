#include "import/chunks/chunked_ply_base.h"

#include "base/error.h"
#include "import/chunks/ply_declaration.h"
#include "import/complete_import.h"
#include "import/mesh/far_origin.h"
#include "import/ply/content.h"
#include "import/ply/ply.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace imgeo {

namespace {

/// Each is a mesh, for which the faces of the file are gone through.
constexpr std::size_t maxTextures = 4096;
/// Faces are copied in the order of their textures where their pieces are more than so many times their bytes.
constexpr std::size_t maxPassedOver = 2;

void addMissing(std::vector<std::string>& texts, std::vector<std::string> further) {
  for (std::string& text : further)
    if (std::ranges::find(texts, text) == texts.end())
      texts.push_back(std::move(text));
}

} // namespace

ChunkedPlyBase::ChunkedPlyBase(SourceContent content, std::filesystem::path scratch, std::uint64_t chunkRecords)
    : ChunkedSource(std::move(content)), header_(readPlyHeader(bytes(), name_)), scratch_(std::move(scratch)),
      chunkRecords_(chunkRecords) {
  const PlyMeshElements elements = meshElementsOf(header_, name_);
  vertices_ = elements.vertices, faces_ = elements.faces;
  setTopology(elements.topology());
  hasTextures_ = faces_ && !header_.textureFiles.empty();
  if (hasTextures_)
    for (const PlyProperty& property : faces_->properties)
      if (isPlyTextureNumber(property))
        textureNumber_ = &property; // of several, the last one
}

void ChunkedPlyBase::setFirstVertex(std::size_t offset) {
  origin_ = plyOriginOf(bytes(), header_, offset, name_);
}

void ChunkedPlyBase::addFace(std::size_t begin, std::size_t end, std::uint64_t corners, std::uint32_t texture) {
  if (!lastPart_ || lastPart_->texture != texture) {
    lastPart_ = &partsByTexture_[texture];
    lastPart_->texture = texture;
    if (partsByTexture_.size() > maxTextures)
      throw Error(ErrorKind::unsupported, name_,
                  fmt::format("has faces of more than {} textures, and is not read piece by piece", maxTextures));
  }
  Part& part = *lastPart_;
  if (part.chunks.empty() || part.chunks.back().records == chunkRecords_)
    part.chunks.push_back({begin, end, 0, 0});
  Chunk& chunk = part.chunks.back();
  const std::uint64_t elements = corners >= 3 ? corners - 2 : 0;
  chunk.end = end;
  ++chunk.records;
  chunk.elements += elements;
  part.elements += elements;
  part.bytes += end - begin;
  if (elements > 0 && !part.first)
    part.first = {begin, end, 1, elements};
}

void ChunkedPlyBase::endFaces() {
  // Faces of fewer than three corners are no mesh.
  if (textureNumber_)
    std::erase_if(partsByTexture_, [](const auto& part) { return part.second.elements == 0; });
  if (partsByTexture_.empty())
    return;
  removeMeshes();
  for (auto& [texture, part] : partsByTexture_) {
    if (part.first)
      part.first->mesh = parts_.size();
    beginMesh(Topology::triangles);
    for (const Chunk& chunk : part.chunks)
      add(chunk);
    parts_.push_back(std::move(part));
  }
  partsByTexture_.clear();
  lastPart_ = nullptr;
  if (alternate())
    copyFaces();
}

/// Whether pieces would pass over much more than their faces.
bool ChunkedPlyBase::alternate() const {
  std::size_t passed = 0, bytes = 0;
  for (const Part& part : parts_) {
    bytes += part.bytes;
    for (const Chunk& chunk : part.chunks)
      passed += chunk.end - chunk.offset;
  }
  return parts_.size() > 1 && passed > maxPassedOver * bytes;
}

void ChunkedPlyBase::copyFaces() {
  std::map<std::uint32_t, Part*> byTexture;
  std::map<std::uint32_t, std::size_t> next, count;
  std::size_t sum = 0;
  for (Part& part : parts_) {
    byTexture[part.texture] = &part;
    next[part.texture] = sum;
    sum += part.bytes;
  }
  copiedFaces_ = std::make_unique<ScratchFile>(nearestFolder(scratch_));
  const std::span<std::uint8_t> copies = copiedFaces_->resize(sum);
  visitAllFaces([&](std::size_t begin, std::size_t end, std::uint32_t texture) {
    const auto found = byTexture.find(texture);
    if (found == byTexture.end()) // without triangles
      return;
    Part& part = *found->second;
    std::size_t& at = next[texture];
    if (count[texture]++ % chunkRecords_ == 0)
      part.copies.push_back(at);
    if (part.first && part.first->offset == begin)
      part.copyOfFirst = at;
    std::ranges::copy(bytes().subspan(begin, end - begin), copies.begin() + static_cast<std::ptrdiff_t>(at));
    at += end - begin;
  });
  for (Part& part : parts_)
    part.copies.push_back(next[part.texture]);
}

ChunkedPlyBase::FaceRange ChunkedPlyBase::copyOf(const Chunk& chunk) const {
  const Part& part = parts_[chunk.mesh];
  const ByteSpan copies = copiedFaces_->bytes();
  if (part.first && chunk.records == 1 && chunk.offset == part.first->offset)
    return {copies, part.copyOfFirst, part.copyOfFirst + part.first->end - part.first->offset};
  const std::size_t pieces = chunk.end == part.chunks[chunk.number].end ? 1 : part.chunks.size();
  return {copies, part.copies[chunk.number], part.copies[chunk.number + pieces]};
}

void ChunkedPlyBase::makeFile(Bytes& file, const Chunk& chunk) const {
  if (!faces_)
    return makeFileOfPoints(file, chunk);
  const FaceRange inFile{bytes(), chunk.offset, chunk.end, textureNumber_ != nullptr};
  if (!copiedFaces_)
    return makeFileOfFaces(file, chunk, inFile);
  try {
    makeFileOfFaces(file, chunk, copyOf(chunk));
  } catch (const Error&) {
    makeFileOfFaces(file, chunk, inFile); // says where in the file the fault is
    throw;
  }
}

ChunkedSource::Chunk ChunkedPlyBase::wholeOf(std::size_t mesh) const {
  const Part& part = parts_[mesh];
  Chunk whole{part.chunks.front().offset, part.chunks.back().end, 0, part.elements};
  whole.mesh = mesh;
  for (const Chunk& chunk : part.chunks)
    whole.records += chunk.records;
  return whole;
}

Imported ChunkedPlyBase::readPiece(const Chunk& chunk, const ImportOptions& given) const {
  ImportOptions options = given;
  options.origin = origin_;
  Bytes file;
  makeFile(file, chunk);
  Imported imported = hasTextures_ ? readPlyWithoutTextures(file, name_, options) : readPly(file, name_, options);
  imported.up = header_.up;
  return imported;
}

Imported ChunkedPlyBase::readChunk(const Chunk& chunk, const ImportOptions& options) const {
  Imported imported = readPiece(chunk, options);
  if (hasTextures_) {
    Mesh& mesh = imported.scene.meshes.at(0);
    if (!mesh.colors.empty() && !mesh.texCoords.empty() && isReadable(textureNumber_ ? textureOf(chunk) : 0, options))
      mesh.colors.clear();
  }
  if (chunk.number == 0)
    warnOfTrailingPlyBytes(imported.warnings, trailingBytes_);
  return imported;
}

bool ChunkedPlyBase::isReadable(std::uint32_t texture, const ImportOptions& options) const {
  if (texture >= header_.textureFiles.size())
    return false;
  const std::lock_guard lock(mutex_);
  const auto [found, isNew] = isReadable_.try_emplace(texture);
  if (isNew)
    found->second = isReadablePlyTexture(header_.textureFiles[texture], options, name_);
  return found->second;
}

Imported ChunkedPlyBase::readScene(const std::set<std::size_t>& whole, const ImportOptions& given) const {
  if (!hasTextures_ || parts_.empty())
    return ChunkedSource::readScene(whole, given);
  const ImportOptions options = besideFile(given);
  std::vector<TexturedPart> parts;
  Imported imported;
  std::vector<std::string> warnings;
  for (std::size_t mesh = 0; mesh < parts_.size(); ++mesh) {
    const bool isWhole = whole.contains(mesh);
    Imported piece = readPiece(isWhole ? wholeOf(mesh) : parts_[mesh].first.value_or(wholeOf(mesh)), options);
    Mesh& read = piece.scene.meshes.at(0);
    parts.push_back({textureNumber_ ? parts_[mesh].texture : 0, parts_[mesh].elements,
                     parts_.size() > 1 && isWhole ? inOrderOfUse(read) : std::move(read)});
    addMissing(warnings, std::move(piece.warnings));
    addMissing(imported.attributes, std::move(piece.attributes));
    imported.format = piece.format;
    imported.up = piece.up;
  }
  addTexturedShapes(imported, std::move(parts), header_.textureFiles, options, name_);
  setOrigin(imported, origin_);
  addMissing(imported.warnings, std::move(warnings));
  warnOfTrailingPlyBytes(imported.warnings, trailingBytes_);
  completeImport(imported, false, options, name_);
  return imported;
}

} // namespace imgeo
