// Compares sites whose meshes share files with their inputs: file by file, with findings in the order of the document.

#include "containers/order_by_file.h"
#include "containers/read_mesh.h"
#include "transcode/site/site_document.h"
#include "transcode/verify/large_comparison_testing.h"
#include "transcode/verify/several_meshes_testing.h"

#include <set>

namespace imgeo {
namespace {

using testing::GltfText;
using testing::primitiveOf;
using testing::roughTorus;
using testing::TemporaryDirectory;

/// Tori of which each is far from the next in the document and near the one after `stride` others, whose file it
/// shares: files hold two.
std::vector<Mesh> tori(int count, int stride) {
  std::vector<Mesh> meshes;
  for (int i = 0; i < count; ++i)
    meshes.push_back(
        roughTorus(96 + i, 70, {100.0f * static_cast<float>(i % stride), 0, 3.0f * static_cast<float>(i)}));
  return meshes;
}

void writeTori(const std::filesystem::path& path, const std::vector<Mesh>& meshes) {
  GltfText gltf;
  for (const Mesh& mesh : meshes)
    gltf.show(gltf.addMesh({primitiveOf(gltf, mesh, false)}));
  writeFile(path, gltf.glb());
}

ConvertOptions withoutPictures() {
  ConvertOptions options;
  options.pictures = false;
  return options;
}

TEST(SharedFiles, AreDecodedOnceInTheOrderOfFiles) {
  const TemporaryDirectory directory;
  writeTori(directory / "input.glb", tori(12, 6));
  convert(directory / "input.glb", directory / "site", withoutPictures());
  const SiteDocument document = openDocument(directory / "site");
  const std::vector<GeometryDescription>& geometries = document.scene.geometries;
  std::vector<std::string> fetched;
  const ContainerReader reader([&](const std::string& url) {
    fetched.push_back(url);
    return fetchFrom(document)(url);
  });
  for (const std::size_t geometry : orderByFile(geometries))
    readMesh(reader, geometries[geometry], "the site");
  EXPECT_EQ(fetched.size(), 6u); // more than a reader keeps
  EXPECT_EQ(std::set(fetched.begin(), fetched.end()).size(), 6u);
}

TEST(SharedFiles, HaveTheirFindingsInTheOrderOfTheDocument) {
  const TemporaryDirectory directory;
  std::vector<Mesh> meshes = tori(4, 2);
  writeTori(directory / "input.glb", meshes);
  convert(directory / "input.glb", directory / "site", withoutPictures());
  const std::vector<GeometryDescription> geometries = openDocument(directory / "site").scene.geometries;
  ASSERT_EQ(orderByFile(geometries), (std::vector<std::size_t>{0, 2, 1, 3}));
  for (const std::size_t mesh : {1, 2})
    std::swap(meshes[mesh].corners[30], meshes[mesh].corners[31]);
  writeTori(directory / "other.glb", meshes);
  std::vector<std::string> subjects;
  for (const std::string& finding :
       testing::verifyBoth(directory, directory / "site", directory / "other.glb").findings)
    if (const std::string subject = finding.substr(0, finding.find(':'));
        subjects.empty() || subjects.back() != subject)
      subjects.push_back(subject);
  EXPECT_EQ(subjects, (std::vector<std::string>{"Shape 2", "Shape 3"}));
}

} // namespace
} // namespace imgeo
