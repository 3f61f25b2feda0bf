#pragma once
// Whether images of groups are of use, which is known when all have been counted. It is kept in a work file.

#include "transcode/out_of_core/work_folder.h"

#include <string>

namespace imgeo {

struct ImageVerdict {
  std::string obstacle;     ///< empty: they are of use, or not known to be of none
  bool mayResample = false; ///< whether new charts have not been tried
};

/// The name of the work file. `resamples`: of images with new charts.
const char* imageVerdictFile(bool resamples);

/// The content of the work file.
Bytes writeImageVerdict(const ImageVerdict& verdict);

/// What the work file says; without one, that images are not known to be of no use.
ImageVerdict storedImageVerdict(const WorkFolder& work, bool resamples);

} // namespace imgeo
