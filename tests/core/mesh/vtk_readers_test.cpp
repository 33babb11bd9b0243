// VTK's files, legacy and XML, as VTK 9.1 writes them (data/cube_vtk.py) and as they should not be.
#include <gtest/gtest.h>

#include <cstring>

#include "core/mesh/topology.h"
#include "core/mesh/vtk_legacy_reader.h"
#include "core/mesh/vtu_data.h"
#include "core/mesh/vtu_reader.h"
#include "tests/core/mesh/mesh_texts.h"

namespace flexcast {
namespace {

using namespace mesh_texts;

class VtkCube : public testing::TestWithParam<const char*> {};

TEST_P(VtkCube, IsTheSameWhateverTheFormat) {
  const auto file = read_vtk_file(data_file(GetParam()));
  ASSERT_TRUE(file.ok()) << file.error().message;
  const Mesh& mesh = file.value().mesh;
  ASSERT_EQ(mesh.nodes.size(), 9u);
  EXPECT_EQ(mesh.nodes[6], Vec3(1, 1, 1));
  EXPECT_EQ(mesh.nodes[8], Vec3(0.5, 0.5, 0.5));
  ASSERT_EQ(mesh.tetrahedra.size(), 12u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  double volume = 0.0;
  for (const Tetrahedron& tetrahedron : mesh.tetrahedra) volume += calc_six_volumes(mesh.nodes, tetrahedron) / 6.0;
  EXPECT_NEAR(volume, 1.0, 1e-14);
  std::size_t turned = 0;
  for (std::size_t i = 0; i < 12; ++i) turned += mesh.tetrahedra[i][3] != 8;
  EXPECT_EQ(file.value().repairs.empty(), turned == 0);
}

INSTANTIATE_TEST_SUITE_P(VtkReaders, VtkCube,
                         testing::Values("cube_42_ascii.vtk", "cube_42_binary.vtk", "cube_51_ascii.vtk",
                                         "cube_51_binary.vtk", "cube_ascii_plain.vtu", "cube_binary_plain.vtu",
                                         "cube_binary_zlib.vtu", "cube_appended_plain.vtu", "cube_appended_zlib.vtu",
                                         "cube_appended64_plain.vtu", "cube_appended64_zlib.vtu",
                                         "cube_big_endian.vtu"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           for (char& c : name) c = c == '.' ? '_' : c;
                           return name;
                         });

const std::string legacy =
    "# vtk DataFile Version 3.0\na corner\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n"
    "CELLS 2 8\n4 0 1 2 3\n2 0 1\nCELL_TYPES 2\n10\n3\n";

TEST(VtkLegacyReader, TakesTheTetrahedraAndIgnoresLinesAndData) {
  const auto file = read_vtk_text(legacy + "CELL_DATA 2\nSCALARS a int\nLOOKUP_TABLE default\n1\n2\n");
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file.value().mesh.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
  EXPECT_TRUE(read_vtk_text(with(with(legacy, "POINTS", "points"), "ASCII", "ascii")).ok()) << "small letters are fine";
}

TEST(VtkLegacyReader, SaysWhatItCannotReadAndWhere) {
  expect_refused(read_vtk_text(""), {"a.vtk, line 1", "vtk DataFile Version"});
  expect_refused(read_vtk_text(with(legacy, "3.0", "6.0")), {"line 1", "'6.0'", "1.0 to 5.1"});
  expect_refused(read_vtk_text(with(legacy, "ASCII", "TEXT")), {"line 3", "'text'", "ASCII or BINARY"});
  expect_refused(read_vtk_text(with(legacy, "UNSTRUCTURED_GRID", "POLYDATA")),
                 {"line 4", "'polydata'", "UNSTRUCTURED_GRID"});
  expect_refused(read_vtk_text(with(legacy, "float", "quaternion")), {"line 5", "'quaternion'"});
  expect_refused(read_vtk_text(with(legacy, "1 0 0 0 1 0", "1 0 x 0 1 0")), {"line 6", "'x'"});
  expect_refused(read_vtk_text(with(legacy, "POINTS 4", "POINTS 400000000")),
                 {"line 5", "400000000 points", "cut short"});
  expect_refused(read_vtk_text(with(legacy, "POINTS 4", "POINTS -4")), {"-4 points", "negative"});
  expect_refused(read_vtk_text(with(legacy, "CELLS 2 8", "CELLS 3 8")), {"end within cell 2 of 3"});
  expect_refused(read_vtk_text(with(legacy, "CELLS 2 8", "CELLS 1 8")), {"3 numbers more than the cells need"});
  expect_refused(read_vtk_text(with(legacy, "4 0 1 2 3", "4 0 1 2 7")), {"do not exist", "element 0 (node 7)"});
  expect_refused(read_vtk_text(with(legacy, "CELL_TYPES 2\n10\n3", "CELL_TYPES 2\n12\n3")), {"cell 0 (hexahedron)"});
  expect_refused(read_vtk_text(with(legacy, "CELL_TYPES 2\n10\n3", "CELL_TYPES 2\n10\n99")), {"cell 1 (type 99)"});
  expect_refused(read_vtk_text(with(legacy, "CELL_TYPES 2\n10\n3", "CELL_TYPES 2\n10\n10")), {"cell 1 (2 points)"});
  expect_refused(read_vtk_text(with(legacy, "CELL_TYPES 2\n10\n3", "CELL_TYPES 1\n10")), {"3 offsets", "1 cells"});
  expect_refused(read_vtk_text(with(legacy, "CELL_TYPES 2\n10\n3\n", "")), {"has no CELL_TYPES section"});
  expect_refused(read_vtk_text(legacy + "POINTS 1 float\n0 0 0\n"), {"second POINTS"});
  expect_refused(read_vtk_text(legacy + "VERTICES 1 2\n"), {"'vertices'"});
  const FileContent binary = data_file("cube_51_binary.vtk");
  expect_refused(read_vtk_file({"b.vtk", binary.bytes.substr(0, 300)}), {"b.vtk, byte"});
}

const std::string xml =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
    "<UnstructuredGrid>\n<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">\n"
    "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 "
    "1</DataArray></Points>\n"
    "<Cells>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>\n"
    "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4</DataArray>\n"
    "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10</DataArray>\n</Cells>\n</Piece>\n"
    "</UnstructuredGrid>\n</VTKFile>\n";

TEST(VtuReader, JoinsItsPieces) {
  const std::size_t begin = xml.find("<Piece"), end = xml.find("</Piece>") + 9;
  const std::string second = with(xml.substr(begin, end - begin), "0 0 0 1 0 0 0 1 0 0 0 1", "5 0 0 6 0 0 5 1 0 5 0 1");
  const auto file = read_vtu_text(xml.substr(0, end) + second + xml.substr(end));
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file.value().mesh.nodes.size(), 8u);
  EXPECT_EQ(file.value().mesh.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}, {4, 5, 6, 7}}));
}

TEST(VtuReader, SaysWhatItCannotReadAndWhere) {
  expect_refused(read_vtu_text(""), {"a.vtu", "XML"});
  expect_refused(read_vtu_text("<a/>"), {"has no <VTKFile>"});
  expect_refused(read_vtu_text(xml.substr(0, 200)), {"a.vtu, byte", "not well-formed XML"});
  expect_refused(read_vtu_text(with(xml, "\"UnstructuredGrid\"", "\"PolyData\"")), {"line 2", "'PolyData'"});
  expect_refused(read_vtu_text(with(xml, "LittleEndian", "Middle")), {"line 2", "'Middle'"});
  expect_refused(read_vtu_text(with(xml, "NumberOfCells=\"1\"", "NumberOfCells=\"-1\"")),
                 {"line 4", "NumberOfCells", "'-1'"});
  expect_refused(read_vtu_text(with(xml, "NumberOfPoints=\"4\"", "")), {"line 4", "NumberOfPoints", "''"});
  expect_refused(read_vtu_text(with(xml, "NumberOfComponents=\"3\"", "NumberOfComponents=\"2\"")),
                 {"line 5", "'2'", "3 are needed"});
  expect_refused(read_vtu_text(with(xml, "1 0 0 0 1 0", "1 0 0 0 y 0")), {"line 5", "'y'"});
  expect_refused(read_vtu_text(with(xml, "0 0 0 1</", "0 0 0 1 7</")), {"line 5", "13 values", "12 are expected"});
  expect_refused(read_vtu_text(with(xml, "Float32", "Float16")), {"line 5", "'Float16'"});
  expect_refused(read_vtu_text(with(xml, ">0 1 2 3<", ">0 1 2 4<")), {"line 6", "point 4", "has 4"});
  expect_refused(read_vtu_text(with(xml, ">4<", ">-4<")), {"line 6", "-4"});
  expect_refused(read_vtu_text(with(xml, "Name=\"types\"", "Name=\"kinds\"")), {"line 4", "'types'"});
  expect_refused(read_vtu_text(with(xml, ">10<", ">12<")), {"line 6", "cell 0 (hexahedron)"});
  expect_refused(read_vtu_text(with(xml, "format=\"ascii\">10<", "format=\"binary\">AQAAAAo<")),
                 {"line 9", "'types'", "end early"});
  expect_refused(read_vtu_text(with(xml, "format=\"ascii\">10<", "format=\"binary\">AgAAAAo=<")),
                 {"line 9", "2 bytes where 1"});
  expect_refused(read_vtu_text(with(xml, "format=\"ascii\">10<", "format=\"appended\" offset=\"3\">10<")),
                 {"line 9", "'3'"});
  expect_refused(read_vtu_file(data_file("cube_lz4.vtu")),
                 {"line 2", "'vtkLZ4DataCompressor'", "vtkZLibDataCompressor is"});
}

TEST(VtuReader, TakesBase64WhoseHeadIsPaddedAndOneWhoseHeadIsNot) {
  // UInt32 1, then the byte 10: as one text, and as two.
  for (const char* text : {"AQAAAAo=", "AQAAAA==Cg==", " AQAA\n AAo= "}) {
    const auto bytes = unpack_vtu_data(text, VtuEncoding::base64, {}, 1);
    ASSERT_TRUE(bytes.ok()) << text << ": " << bytes.error().message;
    EXPECT_EQ(bytes.value(), "\n") << text;
  }
}

// A head that announces more than there can be is refused before anything is allocated for it.
TEST(VtuReader, AnnouncedSizesAreNotTrusted) {
  const auto head = [](std::initializer_list<std::uint32_t> numbers) {
    std::string bytes;
    for (const std::uint32_t number : numbers) {
      char raw[4];
      std::memcpy(raw, &number, 4);
      bytes.append(raw, 4);
    }
    return bytes;
  };
  const VtuLayout packed{.order = ByteOrder::little, .header_bytes = 4, .compressed = true};
  constexpr std::uint64_t much = std::uint64_t{3} << 30;
  for (const std::string& source : {head({3, 1 << 30, 0, 4, 4, 4}) + "abcdefghijkl", head({0xffffffff, 1, 0}),
                                    head({1, 0xffffffff, 0xc0000000, 4}) + "abcd", head({0, 0, 0}), head({2, 8})}) {
    EXPECT_FALSE(unpack_vtu_data(source, VtuEncoding::raw, packed, much).ok());
  }
  EXPECT_FALSE(unpack_vtu_data(head({0xc0000000}), VtuEncoding::raw, {}, much).ok());
  EXPECT_TRUE(unpack_vtu_data(head({0, 0, 0}), VtuEncoding::raw, packed, 0).ok());
}

}  // namespace
}  // namespace flexcast
