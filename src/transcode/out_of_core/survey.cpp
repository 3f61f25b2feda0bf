#include "transcode/out_of_core/survey.h"

#include "base/error.h"
#include "import/complete_import.h"
#include "prepare/levels/regions.h"
#include "transcode/source/preparation.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace {

constexpr std::size_t maxWarnings = 16;

} // namespace

void Survey::add(Survey&& next) {
  if (elements == 0) {
    std::swap(*this, next);
    std::swap(warnings, next.warnings);
  } else if (next.elements > 0) {
    if (!layout.hasSameAttributes(next.layout))
      throw Error(ErrorKind::malformed, meshName, "has other attributes in one part than in another");
    elements += next.elements;
    box.add(next.box.min), box.add(next.box.max);
    layout.colorComponents = std::max(layout.colorComponents, next.layout.colorComponents);
    for (std::size_t i = 0; i < low.size(); ++i) {
      low[i] = std::min(low[i], next.low[i]);
      high[i] = std::max(high[i], next.high[i]);
    }
    colorError = std::max(colorError, next.colorError);
    sample.insert(sample.end(), next.sample.begin(), next.sample.end());
    appendSampledCorners(cornerTriangles, next.cornerTriangles);
  }
  for (std::string& warning : next.warnings) {
    if (std::ranges::find(warnings, warning) != warnings.end() || warnings.size() > maxWarnings)
      continue;
    warnings.push_back(warnings.size() < maxWarnings ? std::move(warning)
                                                     : "Other parts of the file have further warnings.");
  }
}

bool Survey::lacksNormals(bool flatWithoutNormals) const {
  return layout.topology == Topology::triangles && !layout.normals && !(flatWithoutNormals && statedCreaseDegrees == 0);
}

double Survey::creaseDegrees(EdgeReport& guessed) const {
  return statedCreaseDegrees ? *statedCreaseDegrees : guessCreases(isManMade(cornerTriangles), guessed);
}

Imported readPiece(const ChunkedMesh& source, std::size_t chunk, const ImportOptions& importOptions,
                   const ConvertOptions& options, double* colorError) {
  Imported imported = source.read(chunk, importOptions);
  Mesh& mesh = imported.scene.meshes.at(0);
  if (mesh.topology != source.topology()) // a piece whose faces have all fewer than three corners
    mesh.corners.clear(), mesh.topology = source.topology();
  if (mesh.elementCount() != source.elementsOf(chunk))
    throw Error(ErrorKind::malformed, mesh.name, "has other faces or points when they are read again");
  if (options.colorBits <= 8) {
    const double error = roundColors(mesh);
    if (colorError)
      *colorError = error;
  }
  return imported;
}

Survey surveyPiece(const ChunkedMesh& source, std::size_t chunk, const ImportOptions& importOptions,
                   const ConvertOptions& options) {
  const std::uint64_t firstElement = source.firstElementOf(chunk);
  Survey survey;
  Imported imported = readPiece(source, chunk, importOptions, options, &survey.colorError);
  Mesh& mesh = imported.scene.meshes.at(0);
  completeCreases(mesh, importOptions);
  survey.elements = mesh.elementCount();
  survey.layout = RecordLayout::of(mesh);
  survey.format = imported.format;
  survey.meshName = mesh.name;
  survey.warnings = std::move(imported.warnings);
  survey.attributes = std::move(imported.attributes);
  survey.up = imported.up;
  const std::size_t perCorner = survey.layout.cornerFloats(), corners = survey.layout.corners();
  survey.low.assign(perCorner, INFINITY);
  survey.high.assign(perCorner, -INFINITY);
  std::vector<float> record;
  for (std::size_t element = 0; element < mesh.elementCount(); ++element) {
    record.clear();
    survey.layout.append(record, 0, mesh, element);
    for (std::size_t i = 0; i < corners; ++i)
      survey.box.add(Vec3d(positionOf(record.data(), i)));
    for (std::size_t i = 0; i < corners * perCorner; ++i) {
      const float value = record[survey.layout.attributesOffset() + i];
      survey.low[i % perCorner] = std::min(survey.low[i % perCorner], value);
      survey.high[i % perCorner] = std::max(survey.high[i % perCorner], value);
    }
  }
  survey.statedCreaseDegrees = mesh.creaseDegrees;
  if (mesh.topology == Topology::triangles && mesh.normals.empty() && !mesh.creaseDegrees)
    survey.cornerTriangles = sampledCorners(mesh, source.elementCount());
  const std::uint64_t all = source.elementCount(), samples = sampledElementCount(all);
  for (std::uint64_t i = firstElement * samples / all; i < samples; ++i) {
    const std::uint64_t number = sampledElement(i, all);
    if (number >= firstElement + survey.elements)
      break;
    for (std::uint64_t corner = 0; number >= firstElement && corner < corners; ++corner)
      survey.sample.push_back(mesh.cornerPosition(corners * (number - firstElement) + corner));
  }
  return survey;
}

Bytes writeSurvey(const Survey& survey) {
  WorkWriter out;
  out.add(survey.elements);
  out.add(survey.box.min), out.add(survey.box.max);
  out.add(survey.layout.topology);
  out.add(survey.layout.normals), out.add(survey.layout.colors), out.add(survey.layout.colorComponents);
  out.add(survey.layout.texCoordSets), out.addTexts(survey.layout.texCoordMappings);
  out.add(std::uint64_t{survey.layout.named.size()});
  for (const NamedAttribute& attribute : survey.layout.named)
    out.addText(attribute.name), out.add(attribute.components);
  out.addAll(std::span<const float>(survey.low)), out.addAll(std::span<const float>(survey.high));
  out.add(survey.colorError);
  out.addTexts(survey.warnings), out.addTexts(survey.attributes);
  out.addText(survey.format), out.addText(survey.meshName);
  out.add(survey.up.has_value()), out.add(survey.up.value_or(AxisDirection{}));
  out.addAll(std::span<const Vec3f>(survey.sample));
  out.add(survey.statedCreaseDegrees.has_value()), out.add(survey.statedCreaseDegrees.value_or(0));
  out.addAll(std::span<const CornerTriangle>(survey.cornerTriangles));
  return std::move(out.bytes);
}

Survey readSurvey(ByteSpan bytes, const std::string& path) {
  WorkReader in(bytes, path);
  Survey survey;
  survey.elements = in.take<std::uint64_t>();
  survey.box.min = in.take<Vec3d>(), survey.box.max = in.take<Vec3d>();
  survey.layout.topology = in.take<Topology>();
  survey.layout.normals = in.take<bool>(), survey.layout.colors = in.take<bool>();
  survey.layout.colorComponents = in.take<std::uint32_t>();
  survey.layout.texCoordSets = in.take<std::uint32_t>(), survey.layout.texCoordMappings = in.takeTexts();
  for (auto count = in.take<std::uint64_t>(); count > 0; --count) {
    NamedAttribute& attribute = survey.layout.named.emplace_back();
    attribute.name = in.takeText();
    attribute.components = in.take<std::uint32_t>();
  }
  survey.low = in.takeAll<float>(), survey.high = in.takeAll<float>();
  survey.colorError = in.take<double>();
  survey.warnings = in.takeTexts(), survey.attributes = in.takeTexts();
  survey.format = in.takeText(), survey.meshName = in.takeText();
  const bool hasUp = in.take<bool>();
  const auto up = in.take<AxisDirection>();
  if (hasUp)
    survey.up = up;
  survey.sample = in.takeAll<Vec3f>();
  const bool statesCreases = in.take<bool>();
  const auto degrees = in.take<double>();
  survey.statedCreaseDegrees = statesCreases ? std::optional(degrees) : std::nullopt;
  survey.cornerTriangles = in.takeAll<CornerTriangle>();
  return survey;
}

Mesh extremesOf(const Survey& survey) {
  Mesh mesh;
  mesh.topology = survey.layout.topology;
  mesh.positions = {Vec3f(survey.box.min), Vec3f(survey.box.max)};
  mesh.wedgePositions = {0, 1};
  mesh.texCoordMappings = survey.layout.texCoordMappings;
  mesh.colorComponents = survey.layout.colorComponents;
  for (const std::vector<float>* values : {&survey.low, &survey.high}) {
    std::size_t at = 0;
    if (survey.layout.normals)
      mesh.normals.push_back({0, 0, 1}), at += 3;
    for (std::size_t set = 0; set < survey.layout.texCoordSets; ++set, at += 2)
      texCoordsOf(mesh, set).push_back({(*values)[at], (*values)[at + 1]});
    if (survey.layout.colors)
      mesh.colors.emplace_back((*values)[at], (*values)[at + 1], (*values)[at + 2], (*values)[at + 3]), at += 4;
    for (std::size_t i = 0; i < survey.layout.named.size(); ++i) {
      if (mesh.namedAttributes.size() <= i)
        mesh.namedAttributes.push_back(survey.layout.named[i]);
      NamedAttribute& attribute = mesh.namedAttributes[i];
      for (std::uint32_t c = 0; c < attribute.components; ++c)
        attribute.values.push_back((*values)[at++]);
    }
  }
  return mesh;
}

} // namespace imgeo
