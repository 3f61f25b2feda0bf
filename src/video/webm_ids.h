#pragma once
// Identifiers of the elements of WebM files.

#include <cstdint>

namespace imgeo::webm {

enum Id : std::uint32_t {
  ebml = 0x1A45DFA3,
  ebmlVersion = 0x4286,
  ebmlReadVersion = 0x42F7,
  ebmlMaxIdLength = 0x42F2,
  ebmlMaxSizeLength = 0x42F3,
  docType = 0x4282,
  docTypeVersion = 0x4287,
  docTypeReadVersion = 0x4285,
  segment = 0x18538067,
  info = 0x1549A966,
  timestampScale = 0x2AD7B1,
  duration = 0x4489,
  muxingApp = 0x4D80,
  writingApp = 0x5741,
  tracks = 0x1654AE6B,
  trackEntry = 0xAE,
  trackNumber = 0xD7,
  trackUid = 0x73C5,
  trackType = 0x83,
  flagLacing = 0x9C,
  codecId = 0x86,
  video = 0xE0,
  pixelWidth = 0xB0,
  pixelHeight = 0xBA,
  colour = 0x55B0,
  matrixCoefficients = 0x55B1,
  range = 0x55B9,
  transferCharacteristics = 0x55BA,
  primaries = 0x55BB,
  cues = 0x1C53BB6B,
  cuePoint = 0xBB,
  cueTime = 0xB3,
  cueTrackPositions = 0xB7,
  cueTrack = 0xF7,
  cueClusterPosition = 0xF1,
  cluster = 0x1F43B675,
  timestamp = 0xE7,
  simpleBlock = 0xA3,
  blockGroup = 0xA0,
  block = 0xA1,
};

} // namespace imgeo::webm
