#pragma once
// The releases of X3DOM that pages load.

#include "containers/geometry_description.h"
#include "documents/documents.h"

#include <string>

namespace imgeo {

struct X3domRelease {
  std::string version;
  X3domFiles files;
};

/// 1.7.2 for SIG, the last release that draws images; 1.8.3 for BG. `folderUrl` is the folder of x3dom.js and
/// x3dom.css; empty: the npm package on a public CDN, with integrity hashes, so that the browser refuses other files.
X3domRelease x3domReleaseFor(Encoding encoding, const std::string& folderUrl);

} // namespace imgeo
