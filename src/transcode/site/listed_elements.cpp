#include "transcode/site/listed_elements.h"

#include <fmt/format.h>

namespace imgeo {

std::string listed(const std::map<std::string, std::size_t>& elements) {
  std::string list;
  for (const auto& [name, count] : elements)
    list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", name, count);
  return list;
}

} // namespace imgeo
