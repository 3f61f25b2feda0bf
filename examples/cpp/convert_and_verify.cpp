// Converts a mesh file into a site, verifies the site against the file and reads its meshes back.
// Usage: convert_and_verify statue.ply site

#include <imgeo/imgeo.h>

#include <cstdio>

int main(int argumentCount, char** arguments) {
  if (argumentCount != 3) {
    std::fprintf(stderr, "usage: %s INPUT DIRECTORY\n", arguments[0]);
    return 1;
  }
  const char *input = arguments[1], *directory = arguments[2];
  try {
    std::printf("imgeo %s\n", imgeo::version());

    imgeo::ConvertOptions options;
    options.encoding = imgeo::Encoding::compact;
    options.positionBits = 14;
    options.title = "An example";
    const imgeo::ConvertReport report = imgeo::convert(input, directory, options);
    std::printf("%zu triangles in %zu patches, off by at most %g\n", report.elements.triangles, report.patches,
                report.positionError);

    const imgeo::VerifyReport verified = imgeo::verify(directory, input);
    for (const std::string& finding : verified.findings)
      std::printf("%s\n", finding.c_str());
    std::printf("%s\n", verified.equal ? "equal" : "not equal");

    const imgeo::SiteInfo info = imgeo::inspect(directory);
    std::printf("%zu files, %llu bytes of geometry\n", info.files.size(),
                static_cast<unsigned long long>(info.containerBytes));

    for (const imgeo::SiteMesh& mesh : imgeo::readSiteMeshes(directory).meshes)
      std::printf("mesh \"%s\": %zu vertices, %zu indices\n", mesh.name.c_str(), mesh.positions.size(),
                  mesh.indices.size());
    return verified.equal ? 0 : 3;
  } catch (const imgeo::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
