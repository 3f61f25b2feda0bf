// verifySequence(): reads the frames of a site back and compares them with the files that they were made from.

#include "base/error.h"
#include "imgeo/verify.h"
#include "transcode/source/frame_files.h"
#include "transcode/source/preparation.h"
#include "transcode/verify/check_files.h"
#include "transcode/verify/compare_frames.h"

namespace imgeo {

VerifyReport verifySequence(const std::filesystem::path& site, const std::vector<std::filesystem::path>& frames,
                            const VerifyOptions& given) {
  if (frames.size() == 1)
    return verify(site, frames.front(), given);
  if (given.memoryBytes > 0 || !given.workFolder.empty())
    throw Error(ErrorKind::usage, given.memoryBytes > 0 ? "--memory" : "--work",
                "sequences are compared in memory, a frame at a time");
  VerifyReport report;
  Findings findings(report);
  const SiteDocument document = openDocument(site);
  const std::optional<SiteManifest> manifest = manifestOf(document);
  std::uint64_t bytes = 0;
  ImportOptions options;
  options.outside = given.outside;
  if (manifest)
    options.attributes.names = {manifest->attributes.begin(), manifest->attributes.end()};
  const Imported first = importInput(frames.at(0), options, bytes);
  options.origin = first.origin;
  const FrameFiles files(frames, first.scene, options);
  try {
    if (manifest) {
      checkDocuments(document, false, findings);
      checkPictures(document, *manifest, findings);
    }
    const std::vector<SiteSequence> sequences = sequencesOf(document);
    if (sequences.size() != 1)
      findings.add("The site has {} sequences, the input one.", sequences.size());
    else if (checkFiles(document, false, first.scene.graph, findings))
      compareFrames(document, sequences[0], files, report, findings);
  } catch (const Error& error) {
    findings.add("{}.", error.what());
  }
  report.equal = report.findings.empty();
  return report;
}

} // namespace imgeo
