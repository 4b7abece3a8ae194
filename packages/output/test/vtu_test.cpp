#include <culm/base/error.hpp>
#include <culm/output/vtu.hpp>

#include "read_back.hpp"
#include "sample_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace culm::output {
namespace {

// Decodes all arrays of a file with nothing but the standard library of Python.
constexpr const char* decoder = R"(
import base64, struct, sys
import xml.etree.ElementTree as E
codes = {'Float64': 'd', 'Int32': 'i', 'UInt8': 'B'}
def decode(array):
    raw = base64.b64decode(array.text, validate=True)
    size = struct.unpack('<Q', raw[:8])[0]
    assert size == len(raw) - 8, array.get('Name')
    code = codes[array.get('type')]
    return list(struct.unpack('<%d%s' % (size // struct.calcsize(code), code), raw[8:]))
piece = E.parse(sys.argv[1]).getroot().find('UnstructuredGrid/Piece')
def data(place): return {a.get('Name'): decode(a) for a in piece.find(place)}
points, cells = int(piece.get('NumberOfPoints')), int(piece.get('NumberOfCells'))
point_data, cell_data, topology = data('PointData'), data('CellData'), data('Cells')
coordinates = decode(piece.find('Points/DataArray'))
)";

void write_pictures(const std::filesystem::path& folder, const std::vector<StructureMesh>& meshes,
                    int steps) {
  Pictures pictures(folder, "run", meshes);
  for (int i = 0; i < steps; ++i) pictures.add(sample_picture(meshes, i));
  pictures.write();
}

TEST(Vtu, APictureThatVanishesOrChangesIsAFileErrorAtTheEnd) {
  const TemporaryFolder folder;
  const std::vector<StructureMesh> meshes = sample_meshes(2);
  const auto end = [&](auto change) {
    Pictures pictures(folder.path(), "run", meshes);
    for (int i = 0; i < 3; ++i) pictures.add(sample_picture(meshes, i));
    change(folder / "run_vtu/beam_000001.vtu");
    pictures.write();
  };
  EXPECT_NO_THROW(end([](const auto&) {}));
  EXPECT_THROW(end([](const auto& path) { std::filesystem::remove(path); }), FileError);
  EXPECT_THROW(end([](const auto& path) { std::ofstream(path) << "mine"; }), FileError);
  EXPECT_THROW(end([&](const auto&) { std::filesystem::remove(folder / "run.pvd"); }), FileError);
}

TEST(Vtu, CentreLineCarriesMotionAndResultants) {
  if (!has_python("xml")) GTEST_SKIP() << "no python";
  const TemporaryFolder folder;
  write_pictures(folder.path(), sample_meshes(2), 3);
  const std::string text = run_python(std::string(decoder) + R"(
print(points, cells, topology['connectivity'], topology['offsets'], topology['types'])
print(sorted(point_data), sorted(cell_data))
print(cell_data['N1'], cell_data['M'], cell_data['structure'])
print(point_data['temperature'], point_data['director3'][:3])
print(coordinates[:3], coordinates[8] - point_data['displacement'][8])
)",
                                      folder / "run_vtu/beam_000002.vtu");
  EXPECT_EQ(text,
            "3 2 [0, 1, 1, 2] [2, 4] [3, 3]\n"
            "['director1', 'director2', 'director3', 'displacement', 'reaction', 'temperature'] "
            "['M', 'M1', 'M2', 'M3', 'N', 'N1', 'N2', 'N3', 'structure']\n"
            "[0.0, 10.0] [3.0, 4.0, 5.0, 13.0, 14.0, 15.0] [0, 0]\n"
            "[300.0, 301.0, 302.0] [0.0, 0.0, 1.0]\n"
            "[0.0, 0.0, 0.0] 2.0\n");
}

TEST(Vtu, CurvesOfHigherOrderHaveBothEndsFirst) {
  if (!has_python("xml")) GTEST_SKIP() << "no python";
  const TemporaryFolder folder;
  StructureMesh mesh = patch_mesh();
  mesh.type = "Beam";
  mesh.cells = {{CellType::line, {0, 1, 2}}, {CellType::line, {3, 2, 1, 0}}};
  mesh.resultant_names.clear();
  mesh.cell_arrays.clear();
  Picture picture;
  picture.structures.push_back({mesh.positions, mesh.triads, {}, {}, {}});
  Pictures(folder.path(), "run", std::vector{mesh}).add(picture);
  const std::string text =
      run_python(std::string(decoder) +
                     "print(topology['connectivity'], topology['offsets'], topology['types'])\n",
                 folder / "run_vtu/beam_000000.vtu");
  EXPECT_EQ(text, "[0, 2, 1, 3, 0, 2, 1] [3, 7] [21, 35]\n");
}

TEST(Vtu, SkinIsDisplacedFromTheReferenceSkin) {
  const TemporaryFolder folder;
  write_pictures(folder.path(), sample_meshes(2), 3);
  const std::string text = run_python(std::string(decoder) + R"(
types = topology['types']
print(points, cells, types.count(9), types.count(7), types[24], types[49])
start = [x - u for x, u in zip(coordinates, point_data['displacement'])]
print(all(abs(x * x + y * y - 0.01) < 1e-12 for x, y in zip(start[0::3], start[1::3])))
print(sorted({round(z, 12) + 0.0 for z in start[2::3]}), cell_data['N1'][24:26])
)",
                                      folder / "run_vtu/beam_000002_skin.vtu");
  EXPECT_EQ(text, "72 50 48 2 7 7\nTrue\n[0.0, 1.0, 2.0] [0.0, 10.0]\n");
}

TEST(Vtu, StructuresOfOneTypeShareAFileAndMissingDataIsNan) {
  const TemporaryFolder folder;
  std::vector<StructureMesh> meshes = {patch_mesh(), patch_mesh()};
  meshes[1].name = "other";
  meshes[1].resultant_names = {"q"};
  Picture picture;
  for (const StructureMesh& mesh : meshes) {
    picture.structures.push_back({mesh.positions, mesh.triads, {{4.0}}, {}, {{1.0, 2.0}}});
  }
  Pictures(folder.path(), "run", meshes).add(picture);
  const std::string text = run_python(std::string(decoder) + R"(
print(points, cells, topology['connectivity'], topology['offsets'], cell_data)
)",
                                      folder / "run_vtu/shell_000000.vtu");
  EXPECT_EQ(text,
            "8 2 [0, 1, 2, 3, 4, 5, 6, 7] [4, 8] "
            "{'structure': [0, 1], 'n11': [4.0, nan], 'stress': [1.0, 2.0, 1.0, 2.0], "
            "'q': [nan, 4.0]}\n");
}

TEST(Vtu, CollectionsListExistingFilesWithTheirTimes) {
  const TemporaryFolder folder;
  write_pictures(folder.path(), sample_meshes(2), 20);
  constexpr const char* script = R"(
import os, sys
import xml.etree.ElementTree as E
sets = E.parse(sys.argv[1]).getroot().findall('Collection/DataSet')
files = [os.path.join(os.path.dirname(sys.argv[1]), s.get('file')) for s in sets]
for file in files: E.parse(file)
times = sorted({float(s.get('timestep')) for s in sets})
print(len(sets), len(set(files)), len(times), times[1], sorted({s.get('part') for s in sets}))
)";
  EXPECT_EQ(run_python(script, folder / "run.pvd"), "60 60 20 0.1 ['0', '1', '2']\n");
  EXPECT_EQ(run_python(script, folder / "run_skin.pvd"), "20 20 20 0.1 ['0']\n");
}

TEST(Vtu, EachOfSeveralAnalysesHasCollectionsOfItsOwn) {
  const TemporaryFolder folder;
  const std::vector<StructureMesh> meshes = sample_meshes(2);
  const auto write = [&](auto add) {
    Pictures pictures(folder.path(), "run", meshes, {"up", "modes", "down/1"});
    for (int i = 0; i < 5; ++i) add(pictures, i, i < 2 ? 0 : 2);
    pictures.write();
  };
  const auto check = [&] {
    for (const auto& [file, times] : {std::pair{"run.pvd", "01234"},
                                      {"run_skin.pvd", "01234"},
                                      {"run.up.pvd", "01"},
                                      {"run_skin.down_1.pvd", "234"}}) {
      const std::string text = read_text_file(folder / file);
      for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(text.find("_00000" + std::to_string(i)) != std::string::npos,
                  std::string(times).find(std::to_string(i)) != std::string::npos)
            << file << " " << i;
      }
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "run.modes.pvd")) << "no state is its own";
  };
  write([&](Pictures& pictures, int i, int analysis) {
    Picture picture = sample_picture(meshes, i);
    picture.analysis = analysis;
    pictures.add(picture);
  });
  check();
  write(
      [](Pictures& pictures, int i, int analysis) { pictures.add_earlier(i, 1.0 * i, analysis); });
  check();
}

std::vector<int> listed_in(const std::filesystem::path& collection) {
  std::set<int> found;
  const std::string text = read_text_file(collection);
  const std::regex name("run_vtu/\\w+_(\\d+)\\.vtu");
  for (std::sregex_iterator i(text.begin(), text.end(), name), end; i != end; ++i) {
    found.insert(std::stoi((*i)[1]));
    EXPECT_TRUE(std::filesystem::exists(collection.parent_path() / i->str()));
  }
  return {found.begin(), found.end()};
}

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder),
                                                std::filesystem::directory_iterator()));
}

TEST(Vtu, OfManyStepsSomeThatLieEvenlyAreShownAndTheLastOfEachAnalysis) {
  const TemporaryFolder folder;
  const StructureState state{{Vec3::Zero()}, {Mat3::Identity()}, {}, {}};
  const auto picture = [&](int i) {
    return Picture{.index = i,
                   .time = 1.0 * i,
                   .analysis = i < 3 ? 0 : 1,
                   .structures = {state},
                   .arrays = {}};
  };
  const auto open = [&] {
    return Pictures(folder.path(), "run", std::vector{body_mesh()}, {"first", "second"}, 4);
  };
  const auto add = [&](Pictures& pictures, int i) {
    if (pictures.lacks_last_before(picture(i).analysis)) pictures.draw(picture(i - 1));
    const bool is_shown = pictures.shows_next(picture(i).analysis);
    pictures.add(picture(i));
    EXPECT_EQ(pictures.lacks_last(), !is_shown) << i;
  };
  {
    Pictures pictures = open();
    for (int i = 0; i < 16; ++i) add(pictures, i);
    EXPECT_FALSE(pictures.lacks_last()) << "the last one is the fourth after the one before";
    pictures.write();
    EXPECT_EQ(pictures.added(), 16);
    EXPECT_EQ(pictures.shown(), 7);
  }
  // of the second analysis, whose steps are 3 to 15, every fourth
  EXPECT_THAT(listed_in(folder / "run.pvd"), ::testing::ElementsAre(0, 1, 2, 3, 7, 11, 15));
  EXPECT_THAT(listed_in(folder / "run.second.pvd"), ::testing::ElementsAre(3, 7, 11, 15));
  EXPECT_EQ(files_in(folder / "run_vtu"), 7) << "nothing that no collection names";
  {
    // as where a run goes on after its 15th step
    Pictures pictures = open();
    for (int i = 0; i < 15; ++i) pictures.add_earlier(i, 1.0 * i, i < 3 ? 0 : 1);
    for (int i = 15; i < 22; ++i) add(pictures, i);
    ASSERT_TRUE(pictures.lacks_last());
    pictures.draw(picture(21));
    pictures.write();
  }
  EXPECT_THAT(listed_in(folder / "run.pvd"), ::testing::ElementsAre(0, 1, 2, 3, 11, 19, 21));
  EXPECT_EQ(files_in(folder / "run_vtu"), 7);
  // as where a run is killed behind the last step of an analysis, and goes on from there
  {
    Pictures pictures = open();
    for (int i = 0; i < 11; ++i) add(pictures, i);
    ASSERT_TRUE(pictures.lacks_last());
    pictures.draw(picture(10));
  }
  Pictures pictures = open();
  for (int i = 0; i < 11; ++i) pictures.add_earlier(i, 1.0 * i, i < 3 ? 0 : 1);
  pictures.write();
  EXPECT_THAT(listed_in(folder / "run.pvd"), ::testing::ElementsAre(0, 1, 2, 3, 5, 7, 9, 10));
}

TEST(Vtu, WithoutOutlinesThereIsNoSkinCollection) {
  const TemporaryFolder folder;
  const Pictures pictures(folder.path(), "run", std::vector{body_mesh()});
  EXPECT_TRUE(std::filesystem::exists(folder / "run.pvd"));
  EXPECT_FALSE(std::filesystem::exists(folder / "run_skin.pvd"));
}

TEST(Vtu, CollectionIsCompleteWhenARunEndsByAnError) {
  const TemporaryFolder folder;
  {
    Pictures pictures(folder.path(), "run", std::vector{body_mesh()});
    StructureState state{{Vec3::Zero()}, {Mat3::Identity()}, {}, {}};
    for (int i = 0; i < 12; ++i) {
      pictures.add({.index = i, .time = 1.0 * i, .structures = {state}, .arrays = {}});
    }
  }
  EXPECT_THAT(read_text_file(folder / "run.pvd"), ::testing::HasSubstr("timestep=\"11\""));
}

TEST(Vtu, UnwritablePlacesAreFileErrors) {
  const TemporaryFolder folder;
  EXPECT_THROW(Pictures(folder / "missing", "run", std::vector{body_mesh()}), FileError);
  std::ofstream(folder / "run_vtu") << "a file where the folder should be";
  EXPECT_THROW(Pictures(folder.path(), "run", std::vector{body_mesh()}), FileError);
}

TEST(Vtu, InconsistentMeshesAreABug) {
  const TemporaryFolder folder;
  StructureMesh mesh = body_mesh();
  mesh.cells[0].nodes = {1};
  EXPECT_THROW(Pictures(folder.path(), "run", std::vector{mesh}), InternalError);
  mesh.cells = {{CellType::line, {0}}};
  EXPECT_THROW(Pictures(folder.path(), "run", std::vector{mesh}), InternalError);
}

}  // namespace
}  // namespace culm::output
