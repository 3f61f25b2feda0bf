#include "transcode/convert/source_attributes.h"

#include "base/error.h"
#include "scene/fog_depths.h"
#include "transcode/source/frame_files.h"
#include "transcode/source/preparation.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace imgeo {

ImportOptions importOptionsFor(const ConvertOptions& options, RecordingChoice recordings) {
  AttributeChoice attributes = options.keepAttributes;
  attributes.names.insert(fogDepthName);
  return {.attributes = std::move(attributes),
          .folder = {},
          .outside = options.outside,
          .inlineBytes = inlineBytes,
          .recordings = recordings,
          .creaseDegrees = options.creaseDegrees,
          .strict = options.strict};
}

void requireAttributes(const Imported& imported, const ConvertOptions& options) {
  for (const std::string& name : options.keepAttributes.names)
    if (std::ranges::find(imported.attributes, name) == imported.attributes.end())
      throw Error(ErrorKind::usage, "--keep-attributes",
                  imported.attributes.empty() ? fmt::format("the input has no attribute \"{}\", nor any other", name)
                                              : fmt::format("the input has no attribute \"{}\" but {}", name,
                                                            fmt::join(imported.attributes, ", ")));
}

} // namespace imgeo
