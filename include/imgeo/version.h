#pragma once
/// @file
/// The version of the library.

namespace imgeo {

/// Version of the linked library: "MAJOR.MINOR.PATCH".
const char* version() noexcept;

} // namespace imgeo
