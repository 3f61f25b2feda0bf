#pragma once
// Elements of a document, as messages list them.

#include <cstddef>
#include <map>
#include <string>

namespace imgeo {

/// "Box (2), Text (1)"; empty if there are none.
std::string listed(const std::map<std::string, std::size_t>& elements);

} // namespace imgeo
