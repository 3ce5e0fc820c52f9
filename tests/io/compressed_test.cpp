#include "compressing.h"
#include "io/file_content.h"
#include "io_testing.h"

namespace prohull {
namespace {

const std::string kOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

TEST(Gzip, IsReadWhateverTheName) {
  EXPECT_EQ(read_mesh(gzipped(kOff), "a.off.gz").face_count(), 1u);
  EXPECT_EQ(read_mesh(gzipped(kOff), "a.off").face_count(), 1u);
  EXPECT_EQ(read_mesh(gzipped(kOff), "a").face_count(), 1u);
  EXPECT_EQ(read_mesh(kOff, "a.off.gz").face_count(), 1u);
}

TEST(Gzip, MayConsistOfSeveralMembers) {
  EXPECT_EQ(read_mesh(gzipped(kOff.substr(0, 20)) + gzipped(kOff.substr(20)), "a.off.gz").face_count(), 1u);
}

TEST(Gzip, IsReadInManyChunks) {
  std::string text(3 << 20, ' ');
  for (std::size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>('a' + i * i % 23);
  EXPECT_EQ(decompressed(gzipped(text), "a.gz")->bytes, text);
}

TEST(Gzip, ThatIsDamagedIsAnError) {
  std::string bytes = gzipped(kOff);
  expect_refused(std::string_view(bytes).substr(0, bytes.size() / 2), "a.off.gz",
                 "a.off.gz: cannot decompress: the file is truncated");
  bytes[bytes.size() - 6] ^= 1;
  expect_refused(bytes, "a.off.gz", "a.off.gz: cannot decompress: incorrect data check");
}

TEST(Gzip, ThatWouldExhaustTheMemoryIsAnError) {
  const std::string bomb = gzipped(std::string(200 << 20, '\0'));
  expect_refused(bomb, "a.stl.gz",
                 "a.stl.gz: cannot decompress: more than " + std::to_string(decompression_limit(bomb.size())) +
                     " bytes come out of " + std::to_string(bomb.size()) +
                     ", which neither meshes nor queries do; if it is right, decompress it first");
}

TEST(Zip, IsReadIfItHasOneMesh) {
  const std::string bytes = zipped({{"readme.txt", "hello"}, {"dir/a.off", kOff}, {"__MACOSX/dir/._a.off", "x"}});
  EXPECT_EQ(read_mesh(bytes, "a.zip").face_count(), 1u);
  expect_refused(zipped({{"a.off", "OFF\n3 1 0\n"}}), "a.zip",
                 "a.zip/a.off: line 3: the file ends before vertex 1 of 3; it is truncated or its count is wrong");
}

TEST(Zip, MayHaveNamesThatAreNoAscii) {
  std::string bytes = zipped({{"u.off", kOff}});
  for (const std::size_t at : {bytes.find("u.off"), bytes.rfind("u.off")}) bytes[at] = '\xFC';  // as old archives say
  EXPECT_EQ(read_mesh(bytes, "a.zip").face_count(), 1u);
  bytes = zipped({{"uu.off", kOff}});
  for (const std::size_t at : {bytes.find("uu.off"), bytes.rfind("uu.off")}) bytes.replace(at, 2, "\xC3\xBC");
  bytes[7] |= 8, bytes[bytes.find("PK\x01\x02") + 9] |= 8;  // names are in UTF-8
  EXPECT_EQ(read_mesh(bytes, "a.zip").face_count(), 1u);
}

TEST(Zip, WithTheDataOfAGltfFileIsAnError) {
  const TemporaryFolder folder;
  const std::string json = R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "a.bin"}]})";
  write_file(folder / "a.zip", zipped({{"part/a.gltf", json}, {"part/a.bin", std::string(36, '\0')}}));
  try {
    read_mesh(folder / "a.zip");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("of an archive only one file is read; extract all of it"),
              std::string::npos)
        << error.what();
  }
}

TEST(Zip, WithoutOrWithSeveralMeshesIsAnError) {
  expect_refused(zipped({{"readme.txt", "hello"}}), "a.zip",
                 "a.zip: cannot decompress: it has no .ply, .obj, .off, .stl or .glb file, nor another mesh; name "
                 "a 3MF file .3mf");
  expect_refused(zipped({{"a.off", kOff}, {"b.ply", kOff}}), "a.zip",
                 "a.zip: cannot decompress: it has more than one mesh, a.off and b.ply; extract the one you mean");
}

// Of such members minizip returns the bytes as they are in the archive.
TEST(Zip, ThatIsEncryptedOrPackedInAnotherWayIsAnError) {
  const std::string bytes = zipped({{"a.off", kOff}});
  const std::size_t local = 0, central = bytes.find("PK\x01\x02");
  const auto with = [&](std::size_t field, char value) {
    std::string changed = bytes;
    changed[local + 6 + field] = changed[central + 8 + field] = value;
    return changed;
  };
  EXPECT_EQ(read_mesh(with(2, bytes[local + 8]), "a.zip").face_count(), 1u) << "as it was";
  expect_refused(with(0, 1), "a.zip", "a.zip: cannot decompress: it is encrypted; extract the mesh first");
  constexpr char kBzip2 = 12;
  expect_refused(with(2, kBzip2), "a.zip",
                 "a.zip: cannot decompress: it is not packed by deflate, as zip files are by default; extract the mesh "
                 "first");
}

TEST(Zip, WithoutMembersHasNoMesh) {
  expect_refused(
      "PK\x05\x06" + std::string(18, '\0'), "a.zip",
      "a.zip: cannot decompress: it has no .ply, .obj, .off, .stl or .glb file, nor another mesh; name a 3MF "
      "file .3mf");
}

TEST(Zip, ThatIsDamagedIsAnError) {
  const std::string bytes = zipped({{"a.off", kOff}});
  EXPECT_THROW(read_mesh(std::string_view(bytes).substr(0, 50), "a.zip"), InputError);
  std::string changed = bytes;
  changed[60] ^= 1;
  EXPECT_THROW(read_mesh(changed, "a.zip"), InputError);
}

}  // namespace
}  // namespace prohull
