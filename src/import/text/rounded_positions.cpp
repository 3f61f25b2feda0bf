#include "import/text/rounded_positions.h"

#include "import/warnings.h"

namespace imgeo {

void RoundedPositions::addWarning(std::vector<std::string>& warnings) const {
  warnOfRounding(warnings, maxRounding_, box_.longestEdge());
}

} // namespace imgeo
