#include "io/file_unit.h"

#include <gtest/gtest.h>

#include "compressing.h"

namespace prohull {
namespace {

/// The length; below 0 if the file does not say it, but its standard does.
double unit_in(const std::string& content, const char* name) {
  const FileUnit unit = unit_of_file(content, name);
  return unit.is_said ? unit.metres : -unit.metres;
}

TEST(FileUnit, IsToldByTheContent) {
  EXPECT_EQ(unit_in("<COLLADA>", "a.dae"), 1);
  EXPECT_EQ(unit_in("glTF", "standard input"), -1);
  EXPECT_EQ(unit_in("{}", "a.gltf"), -1);
  EXPECT_EQ(unit_in("v 0 0 0", "a.obj"), 0);
  EXPECT_EQ(unit_in("<?xml version='1.0'?><amf unit=\"inch\" version='1.1'>", "a.amf"), 0.0254);
  EXPECT_EQ(unit_in("<amf version='1.1'><object unit='inch'/>", "a.amf"), 0.001);
  EXPECT_EQ(unit_in("<amf unit='parsec'>", "a.amf"), 0);
  const auto model = [](const std::string& root) {
    return zipped({{"[Content_Types].xml", "<Types/>"}, {"3D/3dmodel.model", root}});
  };
  EXPECT_EQ(unit_in(model("<model xmlns='x' unit='foot'><resources/>"), "a.3mf"), 0.3048);
  EXPECT_EQ(unit_in(model("<model xmlns='x'>"), "a.3MF"), 0.001);
  EXPECT_EQ(unit_in(model("<?xml?><!-- <model unit='foot'> --><m:model xmlns:m='x' unit = 'inch'>"), "a.3mf"), 0.0254);
  EXPECT_EQ(unit_in(model("<!-- <model unit='foot'>"), "a.3mf"), 0.001);  // a comment without an end
}

TEST(FileUnit, IsThatOfWhatAnArchiveHolds) {
  FileUnit unit;
  const ReadOptions options{.unit = &unit};
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  read_mesh(zipped({{"a.obj", obj}}), "a.zip", options);
  EXPECT_EQ(unit.metres, 0);
  const std::string gltf = R"({"asset": {"version": "2.0"}})";
  read_mesh(zipped({{"a.gltf", gltf}}), "a.zip", options);
  EXPECT_EQ(unit.metres, 1);
}

}  // namespace
}  // namespace prohull
