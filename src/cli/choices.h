#pragma once
// The flags of convert that choose from a list: the name of each choice on the command line and its value in
// ConvertOptions. convert_flags.cpp uses the names, convert_options.cpp and convert_report.cpp the values.

#include "imgeo/convert.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo::cli {

template <typename Value> struct Choice {
  const char* name;
  Value value;
};

// The first choice of each list is the flag's default.

inline constexpr Choice<Target> targetChoices[] = {{"web", Target::web}, {"x3dom", Target::x3dom}};

inline constexpr Choice<MeshForm> formChoices[] = {{"mesh", MeshForm::mesh},
                                                   {"geometry-image", MeshForm::geometryImage},
                                                   {"height-map", MeshForm::heightMap},
                                                   {"sequence", MeshForm::sequence},
                                                   {"video", MeshForm::video}};

inline constexpr Choice<Primitives> primitivesChoices[] = {
    {"triangles", Primitives::triangles}, {"strips", Primitives::strips}, {"points", Primitives::points}};

inline constexpr Choice<bool> indexChoices[] = {{"on", true}, {"off", false}};

/// auto: the conversion chooses.
inline constexpr Choice<std::optional<ElementType>> coordTypeChoices[] = {
    {"auto", std::nullopt},          {"uint8", ElementType::uint8}, {"int8", ElementType::int8},
    {"uint16", ElementType::uint16}, {"int16", ElementType::int16}, {"float32", ElementType::float32}};

/// auto: what the format says, otherwise a guess.
inline constexpr Choice<std::optional<AxisDirection>> upChoices[] = {
    {"auto", std::nullopt},        {"x", AxisDirection::x},       {"y", AxisDirection::y},      {"z", AxisDirection::z},
    {"-x", AxisDirection::minusX}, {"-y", AxisDirection::minusY}, {"-z", AxisDirection::minusZ}};

/// Metres in a unit. auto: what the file says, otherwise metres.
inline constexpr Choice<std::optional<double>> unitChoices[] = {
    {"auto", std::nullopt}, {"m", 1},       {"cm", 0.01},   {"mm", 0.001},  {"um", 1e-6},
    {"km", 1000},           {"in", 0.0254}, {"ft", 0.3048}, {"yd", 0.9144}, {"mi", 1609.344}};

inline constexpr Choice<StartView> viewChoices[] = {{"auto", StartView::automatic}, {"front", StartView::front},
                                                    {"left", StartView::left},      {"back", StartView::back},
                                                    {"right", StartView::right},    {"top", StartView::top},
                                                    {"bottom", StartView::bottom}};

inline constexpr Choice<Layout> layoutChoices[] = {{"separate", Layout::separate},
                                                   {"interleaved", Layout::interleaved}};

inline constexpr Choice<NormalEncoding> normalsChoices[] = {{"rgb", NormalEncoding::rgb},
                                                            {"octahedral", NormalEncoding::octahedral},
                                                            {"spherical", NormalEncoding::spherical},
                                                            {"palette", NormalEncoding::palette},
                                                            {"derived", NormalEncoding::derived}};

inline constexpr Choice<ImageFormat> imagesChoices[] = {{"png", ImageFormat::png}, {"webp", ImageFormat::webp}};

inline constexpr Choice<DroppedElements> dropChoices[] = {{"none", {}},
                                                          {"degenerate", {.degenerate = true}},
                                                          {"repeated", {.repeated = true}},
                                                          {"both", {.degenerate = true, .repeated = true}}};

inline constexpr Choice<LevelChoice> levelsChoices[] = {
    {"auto", LevelChoice::automatic}, {"always", LevelChoice::always}, {"never", LevelChoice::never}};

inline constexpr Choice<bool> instancesChoices[] = {{"auto", true}, {"never", false}};

inline constexpr Choice<TextureFormat> texturesChoices[] = {{"keep", TextureFormat::keep},
                                                            {"webp", TextureFormat::webp},
                                                            {"avif", TextureFormat::avif},
                                                            {"png", TextureFormat::png}};

inline constexpr Choice<NormalWeighting> normalWeightingChoices[] = {
    {"area", NormalWeighting::area}, {"angle", NormalWeighting::angle}, {"uniform", NormalWeighting::uniform}};

/// The names of a list, in its order.
template <typename Value, std::size_t count> std::vector<std::string> namesOf(const Choice<Value> (&choices)[count]) {
  std::vector<std::string> names;
  for (const Choice<Value>& choice : choices)
    names.push_back(choice.name);
  return names;
}

/// The value of a name that is in the list; the parser has checked that.
template <typename Value, std::size_t count>
Value valueNamed(const Choice<Value> (&choices)[count], std::string_view name) {
  return std::ranges::find(choices, name, &Choice<Value>::name)->value;
}

} // namespace imgeo::cli
