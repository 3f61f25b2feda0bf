#include "transcode/out_of_core/image_verdict.h"

#include <utility>

namespace imgeo {

const char* imageVerdictFile(bool resamples) {
  return resamples ? "new-images-done" : "images-done";
}

Bytes writeImageVerdict(const ImageVerdict& verdict) {
  WorkWriter out;
  out.addText(verdict.obstacle);
  out.add(verdict.mayResample);
  return std::move(out.bytes);
}

ImageVerdict storedImageVerdict(const WorkFolder& work, bool resamples) {
  const char* const name = imageVerdictFile(resamples);
  if (!work.has(name))
    return {};
  const Bytes bytes = readFile(work.file(name));
  WorkReader in(bytes, work.file(name));
  ImageVerdict verdict;
  verdict.obstacle = in.takeText();
  verdict.mayResample = in.take<bool>();
  return verdict;
}

} // namespace imgeo
