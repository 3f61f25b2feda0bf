#pragma once
// What the options of a conversion mean for sequences of frames.

#include "imgeo/convert.h"
#include "import/import.h"

#include <filesystem>
#include <vector>

namespace imgeo {

/// Whether everything that moves the vertices of a source is to be recorded.
bool recordsAll(const ConvertOptions& options);

/// Refuses options that contradict sequences.
void requireSequenceOptions(const ConvertOptions& options);

/// The options of the meshes of sequences, whose static files are SIG classic.
ConvertOptions ofSequences(ConvertOptions options);

/// The options for frames in files of their own.
ConvertOptions optionsForFiles(const std::vector<std::filesystem::path>& frames, const ConvertOptions& options);

/// The animations of vertices of a document that become sequences although nobody asked for it: those whose text is
/// long, unless other options contradict.
RecordingChoice recordingChoice(const ConvertOptions& options);

} // namespace imgeo
