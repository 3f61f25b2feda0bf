#include "import/x3d/x3d.h"

#include "import/references.h"
#include "import/warnings.h"
#include "import/x3d/node_conversions.h"
#include "import/x3d/page.h"
#include "import/x3d/prototypes.h"
#include "import/x3d/scene_reader.h"
#include "import/x3d/shared_appearances.h"
#include "import/x3d/summary.h"
#include "import/x3d/unread_fields.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

Imported x3d::readElements(Elements elements, ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  const References references(options, name);
  ExternPrototypes externals(references);
  const PrototypeReport prototypes = expandPrototypes(elements, name, externals);
  if (options.strict && !prototypes.failures.empty())
    throw Error(ErrorKind::unsupported, name, prototypes.failures[0]);
  std::vector<std::string> unread;
  warnOfUnreadFields(elements, unread);
  const NodeConversions conversions = convertNodes(elements);
  std::vector<std::string> skinFaults;
  for (const auto& [element, message] : elements.skins.faults) {
    const std::string location = locationOf(asText(bytes), name, elements.offsets.of(element));
    if (options.strict)
      throw Error(ErrorKind::malformed, location, message);
    skinFaults.push_back(fmt::format("{}: {}.", location, message));
  }
  const std::size_t sharedAppearances = shareAppearances(elements);
  const std::string format = elements.format;
  std::vector<std::string> warnings = std::move(elements.warnings);
  const Source source(std::move(elements), asText(bytes), name);
  Imported imported = readSceneGraph(source, references, options);
  imported.format = format;
  imported.warnings.insert(imported.warnings.begin(), warnings.begin(), warnings.end());
  for (const std::string& failure : prototypes.failures)
    imported.warnings.push_back(failure + ".");
  if (prototypes.instances > 0)
    imported.warnings.push_back(fmt::format("{} of {} written out as the nodes that they stand for.",
                                            counted(prototypes.instances, "instance", "instances"),
                                            counted(prototypes.prototypes, "prototype is", "prototypes are")));
  if (sharedAppearances > 0)
    imported.warnings.push_back(fmt::format("{} of an equal one: the scene has more than {} shapes.",
                                            counted(sharedAppearances, "Appearance is a USE", "Appearances are USEs"),
                                            maxShapesWithOwnAppearance));
  std::ranges::move(unread, std::back_inserter(imported.warnings));
  std::ranges::move(skinFaults, std::back_inserter(imported.warnings));
  warnOfElements(imported.warnings, "Left out of prototypes", prototypes.leftOut);
  warnOfElements(imported.warnings, "Written as other nodes", conversions.converted);
  warnOfElements(imported.warnings, "Left out of materials", conversions.leftOut);
  warnOfElements(imported.warnings, "Hidden, since the order of their LayerSet does not name them", conversions.hidden);
  warnOfElements(imported.warnings, "Left out of layers that are not active, since pages have one camera",
                 conversions.unbound);
  return imported;
}

bool isX3d(ByteSpan bytes) {
  const std::string_view beginning = asText(bytes).substr(0, 4096);
  return beginning.starts_with("<") && beginning.find("<X3D") != beginning.npos && !isPage(bytes);
}

Imported readX3d(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  return x3d::readElements(x3d::parseXml(asText(bytes), name), bytes, name, options);
}

} // namespace imgeo
