#include "transcode/out_of_core/region_atlas.h"

#include "transcode/out_of_core/region_charts.h"
#include "transcode/out_of_core/region_triangles.h"

#include <algorithm>

namespace imgeo {

namespace {

/// Calls visit(triangle) for the triangles of a piece of level 0.
void visitPiece(const RegionedLevel& level, const std::string& path, std::uint32_t firstLabel,
                const std::function<void(const TexturedTriangle&)>& visit) {
  constexpr std::size_t atOnce = 4096;
  const std::size_t size = level.layout.recordFloats();
  visitScattered(path, [&](std::span<const float> records) {
    std::vector<const float*> own;
    std::vector<Vec3f> positions;
    const auto visitOwn = [&] {
      const std::vector<Vec3u> points = quantise(positions, *level.lattice);
      for (std::size_t i = 0; i < own.size(); ++i) {
        TexturedTriangle triangle;
        for (std::size_t corner = 0; corner < 3; ++corner) {
          const float* texCoord = own[i] + level.layout.texCoordOffset(corner, 0);
          triangle.points[corner] = points[3 * i + corner];
          triangle.texCoords[corner] = {texCoord[0], texCoord[1]};
        }
        triangle.chart = level.charts.at(firstLabel + labelOf(level, own[i]));
        visit(triangle);
      }
      own.clear(), positions.clear();
    };
    for (std::size_t at = 0; at + size <= records.size(); at += size) {
      if (isGhostTag(tagOf(&records[at])))
        continue;
      own.push_back(&records[at]);
      for (std::size_t corner = 0; corner < 3; ++corner)
        positions.push_back(positionOf(&records[at], corner));
      if (own.size() == atOnce)
        visitOwn();
    }
    visitOwn();
  });
}

} // namespace

Bytes resampleTexture(const RegionedLevel& level, const WorkFolder& work, const LevelImages& images,
                      std::uint64_t maxBytes) {
  const TriangleVisits triangles = [&](const std::function<void(const TexturedTriangle&)>& visit) {
    for (std::size_t task = 0; task < level.scatterTasks; ++task)
      visitPiece(level, work.file(level.file("scatter", task)), level.firstLabels[task], visit);
  };
  const std::optional<ResampledTexture> texture = images.resampled(triangles, maxBytes);
  WorkWriter out;
  out.add(texture.has_value());
  if (!texture)
    return std::move(out.bytes);
  const auto& [charts, source] = *texture;
  out.bytes.reserve(source.image.pixels.size() + source.image.pixels.size() / 16);
  out.add(charts.size), out.add(charts.cellShift);
  out.addAll(std::span(charts.cells)), out.addAll(std::span(charts.layers)), out.addAll(std::span(charts.charts));
  out.addAll(std::span(source.image.pixels));
  addCharts(out, source.charts);
  return std::move(out.bytes);
}

std::optional<ResampledTexture> readResampled(const std::string& path) {
  const FileView view(path);
  WorkReader in(view.bytes(), path);
  if (!in.take<bool>())
    return std::nullopt;
  ResampledTexture texture;
  auto& [charts, source] = texture;
  charts.size = in.take<RasterSize>(), charts.cellShift = in.take<std::uint32_t>();
  charts.cells = in.takeAll<NewCharts::Cell>(), charts.layers = in.takeAll<NewCharts::Layer>();
  charts.charts = in.takeAll<NewCharts::Chart>();
  source.image = {charts.size.width, charts.size.height, in.takeAll<std::uint8_t>()};
  source.charts = takeCharts(in);
  for (const NewCharts::Chart& chart : charts.charts)
    source.projections.push_back(chart.projection);
  return texture;
}

} // namespace imgeo
