#pragma once
/// @file
/// All of imgeo's public C++ API.

#include "imgeo/convert.h"
#include "imgeo/error.h"
#include "imgeo/site.h"
#include "imgeo/verify.h"
#include "imgeo/version.h"

/// @namespace imgeo
/// Everything of the library.

/// @mainpage The C++ library
/// - convert() makes a site, a folder for any static host, from a mesh or scene file; imgeo::ConvertOptions are its
/// options.
/// - verify() reads a site back and compares it with its source.
/// - inspect() counts the bytes of a site, readSiteMeshes() returns its vertices and indices.
///
/// Functions throw imgeo::Error for bad input, with the file and the location in it. Nothing prints or exits.
///
/// `make install PREFIX=~/.local` installs headers and library. A program that uses them links `imgeo::imgeo`:
/// @include CMakeLists.txt
/// @include convert_and_verify.cpp
