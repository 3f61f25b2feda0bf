// Writes a generated scene to a mesh file.

#include "transcode/sample/sample_file.h"

#include "base/error.h"
#include "transcode/export/write_scene.h"
#include "transcode/sample/sample_hall.h"

namespace imgeo {

ExportReport writeSampleHall(std::uint32_t seats, const std::filesystem::path& output) {
  if (meshFormatOf(output) != MeshFormat::glb)
    throw Error(ErrorKind::usage, output.string(), "does not end in .glb, the format that keeps a hall's structure");
  return writeScene(hallScene(seats), MeshFormat::glb, output);
}

} // namespace imgeo
