#pragma once
/// @file
/// All of imgeo's public C++ API.

#include "imgeo/convert.h"
#include "imgeo/error.h"
#include "imgeo/site.h"
#include "imgeo/verify.h"
#include "imgeo/version.h"
