#include "io/imported_mesh.h"
#include "io/mesh_readers.h"

#include <cstdlib>

#include "compressing.h"
#include "io/import_protocol.h"
#include "io_testing.h"

namespace prohull {
namespace {

using namespace std::chrono_literals;

constexpr ImportLimits kLimits{60s, std::size_t{1} << 30, 1 << 20};
constexpr std::string_view kConvert = "; convert it to PLY, OBJ, STL or GLB, with Blender or MeshLab for example";

/// A program that does what a script says, in the place of prohull-import.
class FakeImporter : public testing::Test {
 protected:
  ~FakeImporter() override { unsetenv("PROHULL_IMPORTER"); }

  void install(const std::string& script) {
    write_bytes(path(), "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(path(), std::filesystem::perms::owner_all);
    setenv("PROHULL_IMPORTER", path().c_str(), 1);
  }
  void install_writing(const std::string& output) {
    write_bytes(folder_ / "output", output);
    install("exec cat '" + (folder_ / "output").string() + "'");
  }
  std::filesystem::path path() const { return folder_ / "importer"; }

  static void expect_error(Defect defect, const std::string& message, const ImportLimits& limits = kLimits) {
    expect_input_error([&] { imported_mesh("content", "a.dae", limits, {}); }, defect, "a.dae: " + message);
  }

 private:
  TemporaryFolder folder_;
};

/// A triangle as prohull-import would write it.
std::string triangle_output(std::uint32_t last_corner = 2) {
  std::string out(kImportMagic);
  out += bytes_of(std::uint64_t{3}) + bytes_of(std::uint64_t{1});
  for (const double c : {0., 0., 0., 1., 0., 0., 0., 0.1, 0.}) out += bytes_of(c);
  for (const std::uint32_t number : {3u, 0u, 1u, last_corner}) out += bytes_of(number);
  return out.append(kImportEnd);
}

TEST_F(FakeImporter, IsBelievedIfWhatItWritesIsWhole) {
  install_writing(triangle_output());
  const TriangleMesh mesh = imported_mesh("content", "a.dae", kLimits, {});
  EXPECT_EQ(mesh.positions[VertexId(2)], (Vec3{0, 0.1, 0}));
  EXPECT_EQ(mesh.triangles[FaceId(0)], corners(0, 1, 2));
}

TEST_F(FakeImporter, GetsNameContentAndLimits) {
  install(
      "[ \"$1\" = 'dir/a b.dae' ] && [ $2 = 30 ] && [ $3 = 1073741824 ] && [ \"$(cat)\" = content ] || exit 9\n"
      "printf 'well done'; exit 3");
  expect_input_error([] { imported_mesh("content", "dir/a b.dae.gz", kLimits, {}); }, Defect::Malformed,
                     "dir/a b.dae.gz: assimp refuses it: well done" + std::string(kConvert));
}

TEST_F(FakeImporter, ThatBreaksOffIsAnErrorAtEveryByte) {
  const std::string whole = triangle_output();
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    install_writing(whole.substr(0, size));
    expect_error(Defect::Malformed,
                 "what prohull-import wrote about it breaks off or is garbled" + std::string(kConvert));
  }
}

TEST_F(FakeImporter, ThatWritesGarbageIsAnError) {
  const std::string garbled = "what prohull-import wrote about it breaks off or is garbled" + std::string(kConvert);
  install_writing("hello");
  expect_error(Defect::Malformed, garbled);
  install_writing(triangle_output() + "x");
  expect_error(Defect::Malformed, garbled);
  for (const std::size_t count_at : {kImportMagic.size(), kImportMagic.size() + 8}) {
    std::string output = triangle_output();
    output.replace(count_at, 8, 8, '\xFF');
    install_writing(output);
    expect_error(Defect::Malformed, garbled);
  }
  install_writing(triangle_output(3));
  expect_error(Defect::Malformed, "the face has vertex 3, but the file has 3 vertices, counted from 0");
}

TEST_F(FakeImporter, ThatCrashesIsAnError) {
  install("kill -SEGV $$");
  expect_error(Defect::Malformed, "assimp crashed on it (signal 11, Segmentation fault)" + std::string(kConvert));
  install("exit 1");
  expect_error(Defect::Malformed, path().string() + " failed on it with exit code 1" + std::string(kConvert));
}

TEST_F(FakeImporter, ThatExceedsALimitIsAnError) {
  install("exec sleep 100");
  expect_error(Defect::CannotRead, "reading it takes more than 1 s, the limit for its size" + std::string(kConvert),
               {1s, 0, 100});
  install("kill -XCPU $$");
  expect_error(Defect::CannotRead, "reading it takes more than 60 s, the limit for its size" + std::string(kConvert));
  install("exit 4");
  expect_error(Defect::CannotRead,
               "reading it takes more than 1024 MiB, the limit for its size" + std::string(kConvert));
  install("exec cat /dev/zero");
  expect_error(Defect::CannotRead, "it holds more than 1 MiB, the limit for its size" + std::string(kConvert));
}

TEST_F(FakeImporter, ThatCannotBeRunIsAnError) {
  setenv("PROHULL_IMPORTER", "/no/such/program", 1);
  expect_error(Defect::CannotRead,
               "cannot run /no/such/program: No such file or directory; correct PROHULL_IMPORTER or install "
               "prohull-import anew");
}

TEST_F(FakeImporter, IsEndedByCancelling) {
  install("exec sleep 100");
  EXPECT_THROW(read_mesh("content", "a.dae", {.progress = [](std::string_view, double) { return false; }}), Cancelled);
}

// --- what assimp reads ---

class Assimp : public testing::Test {
 protected:
  void SetUp() override {
    if (!PROHULL_HAS_IMPORTER) GTEST_SKIP() << "built without assimp (libassimp-dev)";
    setenv("PROHULL_IMPORTER", PROHULL_BUILT_IMPORTER, 1);
  }
};

/// A square with a notch, and a line, in the plane z = 0; `asset` and `nodes` as given.
std::string collada(const std::string& asset, const std::string& nodes) {
  return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>)" +
         asset + R"(</asset><library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="15">0 0 0 4 0 0 4 4 0 2 1 0 0 4 0</float_array>
<technique_common><accessor source="#pa" count="5" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist count="1"><input semantic="VERTEX" source="#v" offset="0"/><vcount>5</vcount><p>0 1 2 3 4</p></polylist>
<lines count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1</p></lines>
</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s">)" +
         nodes + R"(</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

const std::string kInstance = "<instance_geometry url=\"#g\"/>";

double area_seen_from_above(const TriangleMesh& mesh) {
  double area = 0;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    area += cross(t.b - t.a, t.c - t.a).z / 2;
  }
  return area;
}

TEST_F(Assimp, ReadsColladaPolygonsAsTheyAre) {
  const TriangleMesh mesh = read_mesh(collada("", "<node>" + kInstance + "</node>"), "a.dae");
  EXPECT_EQ(mesh.positions, (PerVertex<Vec3>{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}}));
  EXPECT_EQ(mesh.face_count(), 3u);
  EXPECT_EQ(area_seen_from_above(mesh), 10);
  for (const FaceId f : mesh.triangles.ids()) {  // no triangle covers the notch
    const Triangle t = mesh.triangle(f);
    EXPECT_GT(cross(t.b - t.a, t.c - t.a).z, 0);
  }
}

TEST_F(Assimp, PlacesEachInstanceOfCollada) {
  const TriangleMesh mesh =
      read_mesh(collada("", "<node><matrix>0 -1 0 10 1 0 0 20 0 0 1 30 0 0 0 1</matrix>" + kInstance +
                                "<node><scale>-1 2 1</scale>" + kInstance + "</node></node>"),
                "a.dae");
  const PerVertex<Vec3> expected = {{10, 20, 30}, {10, 24, 30}, {6, 24, 30}, {9, 22, 30},  {6, 20, 30},
                                    {2, 20, 30},  {8, 18, 30},  {2, 16, 30}, {10, 16, 30}, {10, 20, 30}};
  ASSERT_EQ(mesh.vertex_count(), 10u);
  for (const Vec3& p : expected)
    EXPECT_NE(std::find(mesh.positions.begin(), mesh.positions.end(), p), mesh.positions.end())
        << p.x << " " << p.y << " " << p.z;
  EXPECT_EQ(area_seen_from_above(mesh), 30);  // the mirrored one is turned
}

TEST_F(Assimp, AppliesTheUnitOfColladaAndNotItsUpAxis) {
  for (const char* up : {"X_UP", "Y_UP", "Z_UP"}) {
    const TriangleMesh mesh = read_mesh(
        collada("<unit meter=\"0.0625\"/><up_axis>" + std::string(up) + "</up_axis>", "<node>" + kInstance + "</node>"),
        "a.dae");
    EXPECT_EQ(mesh.positions[VertexId(2)], (Vec3{0.25, 0.25, 0})) << up;
  }
}

TEST_F(Assimp, ReadsCompressedCollada) {
  const std::string text = collada("", "<node>" + kInstance + "</node>");
  EXPECT_EQ(read_mesh(gzipped(text), "a.dae.gz").face_count(), 3u);
  EXPECT_EQ(read_mesh(gzipped(text), "a.dae").face_count(), 3u);
  EXPECT_EQ(read_mesh(zipped({{"a.dae", text}}), "a.zip").face_count(), 3u);
}

std::string package_3mf(const std::string& build) {
  const std::string model =
      R"(<?xml version="1.0"?><model unit="inch" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<resources><object id="1" type="model"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>
<vertex x="0" y="1" z="0"/><vertex x="0" y="0" z="1"/></vertices><triangles><triangle v1="0" v2="2" v3="1"/>
<triangle v1="0" v2="1" v3="3"/><triangle v1="1" v2="2" v3="3"/><triangle v1="0" v2="3" v3="2"/></triangles></mesh></object>
</resources><build>)" +
      build + "</build></model>";
  const std::string types =
      R"(<?xml version="1.0"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>)";
  const std::string relations =
      R"(<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Target="/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>)";
  return zipped({{"[Content_Types].xml", types}, {"_rels/.rels", relations}, {"3D/3dmodel.model", model}});
}

TEST_F(Assimp, Reads3mfInItsOwnUnit) {
  const TriangleMesh one = read_mesh(package_3mf(R"(<item objectid="1"/>)"), "a.3mf");
  EXPECT_EQ(one.vertex_count(), 4u);
  EXPECT_EQ(one.face_count(), 4u);
  EXPECT_EQ(signed_volume(one), signed_volume(tetrahedron()));
  const TriangleMesh two = read_mesh(
      package_3mf(R"(<item objectid="1" transform="0 1 0 -1 0 0 0 0 1 10 20 30"/><item objectid="1"/>)"), "a.3MF");
  ASSERT_EQ(two.vertex_count(), 8u);
  for (const Vec3& p : {Vec3{10, 20, 30}, Vec3{10, 21, 30}, Vec3{9, 20, 30}, Vec3{10, 20, 31}, Vec3{1, 0, 0}})
    EXPECT_NE(std::find(two.positions.begin(), two.positions.end(), p), two.positions.end());
}

TEST_F(Assimp, ReadsColladaInUtf16) {
  const std::string text = collada("", kInstance);
  const TriangleMesh mesh = read_mesh(text, "a.dae");
  EXPECT_GT(mesh.face_count(), 0u);
  for (const bool little : {true, false}) {
    std::string wide = little ? "\xFF\xFE" : "\xFE\xFF";
    for (const char c : text) wide += little ? std::string{c, '\0'} : std::string{'\0', c};
    EXPECT_EQ(read_mesh(wide, "a.dae"), mesh);
    wide += '<';  // half of a character
    EXPECT_THROW(read_mesh(wide, "a.dae"), InputError);
  }
}

TEST_F(Assimp, ReadsOtherFilesUnlessTheFileHasToStandAlone) {
  const TemporaryFolder folder;
  const std::filesystem::path part = folder / "part.obj";
  write_bytes(part, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string scene = "LWSC\n5\n\nLoadObjectLayer 1 " + part.string() + "\nEndScene\n";
  EXPECT_EQ(read_mesh(scene, "a.lws").face_count(), 1u);
  expect_input_error([&] { read_mesh(scene, "a.lws", {.alone = true}); }, Defect::Malformed,
                     "a.lws: assimp refuses it: it has data in " + part.string() +
                         ", which --no-outside-files refuses" + std::string(kConvert));
  EXPECT_GT(read_mesh(collada("", kInstance), "a.dae", {.alone = true}).face_count(), 0u);
}

TEST_F(Assimp, ThatRefusesIsQuoted) {
  expect_refused("hello", "a.dae",
                 "a.dae: assimp refuses it: Unable to read file, malformed XML" + std::string(kConvert));
}

TEST_F(Assimp, GivesTheBitsThatOurReaderOfColladaGives) {
  const std::string inner =
      "<node><scale>-1.1 2 0.3</scale><rotate>0 0.6 0.8 33.3</rotate>" + std::string(kInstance) + "</node>";
  for (const std::string& text :
       {collada("", kInstance), collada("<unit meter=\"0.0254\"/><up_axis>Y_UP</up_axis>", inner),
        collada("", "<node><matrix>0 -1 0 .1 1 0 0 2e-1 0 0 1 30 0 0 0 1</matrix>" + inner + kInstance + "</node>")}) {
    const TriangleMesh ours = read_collada(text, "a.dae", kLimits.output);
    EXPECT_GT(ours.face_count(), 0u);
    EXPECT_EQ(ours, mesh_by_assimp(text, "a.dae", kLimits, {}));
  }
}

TEST_F(Assimp, MayCrashOnWhatIsNestedDeeply) {
  std::string nodes;
  for (int i = 0; i < 200000; ++i) nodes += "<node>";
  nodes += "<lookat>0 0 0 0 0 1 0 1 0</lookat>" + std::string(kInstance);  // which only assimp reads
  for (int i = 0; i < 200000; ++i) nodes += "</node>";
  EXPECT_THROW(read_mesh(collada("", nodes), "a.dae"), InputError);
}

TEST_F(Assimp, IsHeldToItsMemory) {
#ifdef PROHULL_TESTS_ARE_SLOW
  GTEST_SKIP() << "sanitizers leave no address space to limit";
#endif
  const std::string blanks(100 << 20, ' ');
  ImportLimits limits = kLimits;
  limits.memory = std::size_t{160} << 20;
  expect_input_error([&] { imported_mesh(package_3mf(blanks), "a.3mf", limits, {}); }, Defect::CannotRead,
                     "a.3mf: reading it takes more than 160 MiB, the limit for its size" + std::string(kConvert));
}

TEST(Importer, ThatIsNotInstalledIsTold) {
  if (PROHULL_HAS_IMPORTER) GTEST_SKIP() << "built with assimp";
  expect_refused("", "a.dae",
                 "a.dae: DAE is read by prohull-import, which is not installed: build prohull where libassimp-dev is, "
                 "or name the program in PROHULL_IMPORTER; or convert it to PLY, OBJ, STL or GLB, with Blender or "
                 "MeshLab for example",
                 Defect::UnknownFormat);
}

}  // namespace
}  // namespace prohull
