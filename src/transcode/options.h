#pragma once
// What the options of a conversion mean together.

#include "transcode/transcode.h"

namespace imgeo {

/// The same options with every default filled in that depends on others. Throws
/// Error{usage}, one sentence, for options that contradict each other or that the
/// container or the target cannot honour.
ConvertOptions resolved(ConvertOptions options);

} // namespace imgeo
