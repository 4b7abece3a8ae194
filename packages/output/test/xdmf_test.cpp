#include <culm/base/error.hpp>
#include <culm/output/recorder.hpp>
#include <culm/output/xdmf.hpp>

#include "read_back.hpp"
#include "sample_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

namespace culm::output {
namespace {

using ::testing::HasSubstr;

void record_run(const TemporaryFolder& folder, int steps) {
  const std::vector<StructureMesh> meshes = sample_meshes(4);
  Recorder recorder(folder / "run.h5", {"t", "v", "d"}, meshes, {});
  XdmfFile xdmf(folder / "run.xdmf", "run.h5", meshes);
  for (int i = 0; i < steps; ++i) {
    const Picture picture = sample_picture(meshes, i);
    recorder.record(meshes, picture);
    xdmf.add_step(picture.index, picture.time);
  }
  xdmf.write();
}

// Follows every reference of the index and compares lengths, as a viewer does.
TEST(Xdmf, EveryReferenceLeadsToADatasetOfThatSize) {
  if (!has_python("h5py")) GTEST_SKIP() << "no h5py";
  const TemporaryFolder folder;
  record_run(folder, 3);
  const std::string text = run_python(R"(
import h5py, os, sys
import xml.etree.ElementTree as E
folder = os.path.dirname(sys.argv[1])
root = E.parse(sys.argv[1]).getroot()
times = [float(t.get('Value')) for t in root.iter('Time')]
items = [item for item in root.iter('DataItem') if item.get('Format') == 'HDF']
for slab in root.iter('DataItem'):
    if slab.get('ItemType') != 'HyperSlab': continue
    rows, table = (item for item in slab)
    numbers = [int(n) for n in rows.text.split()]
    wanted = [int(n) for n in slab.get('Dimensions').split()]
    whole = [int(n) for n in table.get('Dimensions').split()]
    rank = len(wanted)
    first, stride, count = (numbers[rank * i:rank * i + rank] for i in range(3))
    fits = all(f + c <= w for f, c, w in zip(first, count, whole))
    if count != wanted or set(stride) != {1} or not fits: print('wrong rows', rows.text)
for item in items:
    name, path = item.text.split(':')
    data = h5py.File(os.path.join(folder, name), 'r')[path]
    size = 1
    for n in item.get('Dimensions').split(): size *= int(n)
    if size != data.size: print('wrong size', item.text)
print(root.get('Version'), times, len(items))
)",
                                      folder / "run.xdmf");
  EXPECT_EQ(text, "3.0 [0.0, 0.1, 0.2] 63\n");
}

// Many bodies are one grid, so that the index does not grow with them.
TEST(Xdmf, StructuresOfATypeAreOneGrid) {
  const TemporaryFolder folder;
  std::vector<StructureMesh> meshes = sample_meshes(4);
  for (int i = 0; i < 100; ++i) {
    meshes.push_back(body_mesh());
    meshes.back().name = std::to_string(i);
  }
  XdmfFile xdmf(folder / "run.xdmf", "run.h5", meshes);
  xdmf.add_step(0, 0.0);
  const std::string text = read_text_file(folder / "run.xdmf");
  EXPECT_THAT(text, HasSubstr(R"(<Grid Name="Rigid Body" GridType="Uniform">)"));
  EXPECT_THAT(text, HasSubstr(R"(NumberOfElements="101")"));
  EXPECT_LT(text.size(), 8000U);
}

TEST(Xdmf, CanBeMadeFromTheResultFileAlone) {
  const TemporaryFolder folder;
  record_run(folder, 3);
  const std::string original = read_text_file(folder / "run.xdmf");
  std::filesystem::remove(folder / "run.xdmf");
  EXPECT_EQ(write_xdmf_for(folder / "run.h5"), folder / "run.xdmf");
  EXPECT_EQ(read_text_file(folder / "run.xdmf"), original);
}

TEST(Xdmf, ForeignFilesAreFileErrors) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_xdmf_for(folder / "none.h5"), FileError);
  std::ofstream(folder / "text.h5") << "not HDF5";
  EXPECT_THROW(write_xdmf_for(folder / "text.h5"), FileError);
}

TEST(Xdmf, NamesAreEscaped) {
  const TemporaryFolder folder;
  StructureMesh mesh = body_mesh();
  mesh.type = "a<b&\"c\"";
  XdmfFile xdmf(folder / "run.xdmf", "run.h5", {mesh});
  xdmf.add_step(0, 0.0);
  EXPECT_THAT(read_text_file(folder / "run.xdmf"),
              HasSubstr("<Grid Name=\"a&lt;b&amp;&quot;c&quot;\""));
}

TEST(Xdmf, IndexOfALongRunIsWrittenInLinearTime) {
  const TemporaryFolder folder;
  XdmfFile xdmf(folder / "run.xdmf", "run.h5", {body_mesh()});
  const auto start = std::chrono::steady_clock::now();
  std::uintmax_t written = 0;
  std::uintmax_t last = 0;
  for (int i = 0; i < 2000; ++i) {
    xdmf.add_step(i, i);
    const std::uintmax_t size = std::filesystem::file_size(folder / "run.xdmf");
    if (size != last) written += size;
    last = size;
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(101));
  xdmf.add_step(2000, 2000);
  last = std::filesystem::file_size(folder / "run.xdmf");
  xdmf.write();
  const std::uintmax_t size = std::filesystem::file_size(folder / "run.xdmf");
  // Each rewriting is an eighth longer than the last: 1 / (1 - 8/9) = 9 times the file in all.
  if (std::chrono::steady_clock::now() - start < std::chrono::seconds(10)) {
    EXPECT_LT(written, 10 * size);
  }
  EXPECT_GE(9 * last, 8 * size - size / 100);  // never far behind
}

TEST(Xdmf, MissingFolderIsAFileError) {
  const TemporaryFolder folder;
  EXPECT_THROW(XdmfFile(folder / "missing/run.xdmf", "run.h5", sample_meshes(1)), FileError);
}

}  // namespace
}  // namespace culm::output
