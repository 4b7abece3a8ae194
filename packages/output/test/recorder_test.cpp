#include <culm/base/error.hpp>
#include <culm/output/checksum.hpp>
#include <culm/output/recorder.hpp>
#include <culm/output/state_tables.hpp>

#include "read_back.hpp"
#include "sample_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <array>
#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <thread>

namespace culm::output {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const RunInfo info{"bent tube", "0.1.0", "<ParameterList name=\"µ\"/>\n", "4711"};

Recorder make_recorder(const std::filesystem::path& path) {
  return {path, info, sample_meshes(4), {{"energy", "J"}, {"drift", ""}}};
}

void record_sample(Recorder& recorder, int index) {
  const std::vector<StructureMesh> meshes = sample_meshes(4);
  recorder.record(meshes, sample_picture(meshes, index));
}

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Recorder, StepsReadBackWhileTheFileIsOpen) {
  const TemporaryFolder folder;
  const std::vector<StructureMesh> meshes = sample_meshes(4);
  Recorder recorder = make_recorder(folder / "run.h5");
  for (int i = 0; i < 3; ++i) recorder.record(meshes, sample_picture(meshes, i));
  recorder.commit();
  const auto read = [&](const std::string& name) {
    return read_dataset(folder / "run.h5", "/steps/000002/" + name);
  };
  const StructureState state = sample_picture(meshes, 2).structures[0];
  for (std::size_t n = 0; n < 5; ++n) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      EXPECT_EQ(read("position").at(3 * n + k), state.positions[n][i]);
      EXPECT_EQ(read("displacement").at(3 * n + k),
                state.positions[n][i] - meshes[0].positions[n][i]);
      EXPECT_EQ(read("director2").at(3 * n + k), state.triads[n](i, 1));
    }
  }
  EXPECT_THAT(read("temperature"), ElementsAre(300, 301, 302, 303, 304));
  EXPECT_EQ(read("resultants").at(6 * 3 + 5), 35.0);
  EXPECT_THAT(read("resultants%2F2"), ElementsAre(7.5));  // other columns: of the patch
  const std::vector<double> d1 = read("director1");       // of the tube, then of the body
  EXPECT_EQ(d1.size(), 18U);
  EXPECT_THAT(std::vector(d1.end() - 3, d1.end()), ElementsAre(1, 0, 0));
  EXPECT_THAT(read("%arrays/multipliers"), ElementsAre(1, 2, 3));
}

TEST(Recorder, AFileThatVanishesOrIsReplacedIsAFileErrorAtTheNextCommit) {
  const TemporaryFolder folder;
  const auto path = folder / "run.h5";
  const auto add = [&](auto change) {
    Recorder recorder = make_recorder(path);
    recorder.add_history({0.0, std::array{1.0, 2.0}});
    change();
    recorder.commit();
  };
  EXPECT_THROW(add([&] { std::filesystem::remove(path); }), FileError);
  EXPECT_THROW(add([&] {
                 std::filesystem::rename(path, folder / "other.h5");
                 std::ofstream(path) << "mine";
               }),
               FileError);
  EXPECT_EQ(read_text_file(path), "mine");
}

TEST(Recorder, FindingsStandInTheReport) {
  const TemporaryFolder folder;
  Recorder recorder = make_recorder(folder / "run.h5");
  const Finding finding{Finding::Grade::broken, "path", "ended early", "bend", 0.5};
  recorder.write_report("done", {}, {}, std::array{finding, finding});
  recorder.close();
  EXPECT_EQ(count_links(folder / "run.h5", "/report/findings"), 2);
  if (!has_python("h5py")) GTEST_SKIP() << "no h5py";
  EXPECT_EQ(
      run_python("import h5py, sys\n"
                 "print(sorted(h5py.File(sys.argv[1])['report/findings/000001'].attrs.items()))\n",
                 folder / "run.h5"),
      "[('analysis', 'bend'), ('grade', 'broken'), ('kind', 'path'), ('text', 'ended early'), "
      "('time', 0.5)]\n");
}

TEST(Recorder, MeshReadsBack) {
  const TemporaryFolder folder;
  const Recorder recorder = make_recorder(folder / "run.h5");
  const auto read = [&](const std::string& name) {
    return read_dataset(folder / "run.h5", "/mesh/" + name);
  };
  EXPECT_THAT(read("main tube/connectivity"), ElementsAre(0, 1, 1, 2, 2, 3, 3, 4));
  EXPECT_THAT(read("main tube/cell_offsets"), ElementsAre(2, 4, 6, 8));
  EXPECT_THAT(read("main tube/cell_types"), ElementsAre(4, 4, 4, 4));
  EXPECT_THAT(read("patch/field_rows"), ElementsAre(5, 9, 5, 9, 5, 9, 0, 1, 0, 1));
  EXPECT_THAT(read("hub%2Fleft/field_rows"), ElementsAre(9, 10, 9, 10, 5, 6, 5, 6, 9, 10));
  EXPECT_THAT(read("patch/director3").size(), 12U);
  EXPECT_TRUE(read("patch/director1").empty());
  EXPECT_THAT(read_dataset(folder / "run.h5", "/topologies/000001"), ElementsAre(5, 0, 1, 2, 3));
  EXPECT_THAT(read_dataset(folder / "run.h5", "/topologies/000002"), ElementsAre(1, 1, 0));
}

TEST(Recorder, OutlinesThatRepeatStandOnce) {
  const TemporaryFolder folder;
  std::vector<StructureMesh> meshes = {tube_mesh(4)};
  meshes[0].outlines[2].clear();
  meshes[0].outlines[4] = regular_polygon(tube_corners, 2.0 * tube_radius);
  const Recorder recorder(folder / "run.h5", info, meshes, {});
  const auto read = [&](const std::string& name) {
    return read_dataset(folder / "run.h5", "/mesh/main tube/" + name);
  };
  EXPECT_THAT(read("outline_of_node"), ElementsAre(0, 0, -1, 0, 1));
  EXPECT_THAT(read("outline_ends"), ElementsAre(tube_corners, 2 * tube_corners));
  const std::vector<double> points = read("outline_points");
  ASSERT_EQ(points.size(), 4U * tube_corners);
  EXPECT_EQ(points[0], tube_radius);
  EXPECT_EQ(points[2 * tube_corners], 2.0 * tube_radius);
}

TEST(Recorder, HeldNodesStandBesideTheMesh) {
  if (!has_python("h5py")) GTEST_SKIP() << "no h5py";
  const TemporaryFolder folder;
  make_recorder(folder / "run.h5").close();
  EXPECT_EQ(run_python("import h5py, sys\n"
                       "held = h5py.File(sys.argv[1])['mesh/main tube/constraints/000000']\n"
                       "print(held[()], held.attrs['name'], held.attrs['type'])\n",
                       folder / "run.h5"),
            "[0] foot Rigid Support\n");
}

TEST(Recorder, HistoryGrowsRowByRow) {
  const TemporaryFolder folder;
  Recorder recorder = make_recorder(folder / "run.h5");
  std::vector<double> expected;
  for (int i = 0; i < 1000; ++i) {  // several chunks
    recorder.add_history({0.5 * i, std::array{1.0 * i, -2.0 * i}, i / 500, i % 500});
    expected.insert(expected.end(), {0.5 * i, 1.0 * i, -2.0 * i, 1.0 * (i / 500), 1.0 * (i % 500)});
  }
  EXPECT_EQ(recorder.commit().rows, 1000U);
  EXPECT_EQ(read_dataset(folder / "run.h5", "/history/values"), expected);
}

// The reader that users have, too.
TEST(Recorder, PythonReadsTheWholeFile) {
  if (!has_python("h5py")) GTEST_SKIP() << "no h5py";
  const TemporaryFolder folder;
  Recorder recorder = make_recorder(folder / "run.h5");
  record_sample(recorder, 0);
  record_sample(recorder, 7);
  recorder.add_history({0.25, std::array{1.0, std::numeric_limits<double>::quiet_NaN()}, 1, 4});
  recorder.write_report("first", {});
  const NamedScalar scalars[] = {{"energy drift", "J", 1e-12}, {"a/b", "", 2.0}};
  recorder.write_report("finished\n", scalars);
  recorder.close();
  const std::string text = run_python(R"(
import h5py, sys
f = h5py.File(sys.argv[1], 'r')
print(f.attrs['format'], f.attrs['format_version'])
print(f['deck'].attrs['title'], f['deck'].attrs['version'], repr(f['deck/xml'].asstr()[()]))
print(sorted(f['steps']), [f['steps'][s].attrs['time'] for s in f['steps']])
print(f['mesh/main tube'].attrs['type'], list(f['mesh/main tube'].attrs['resultant_names']))
print(f['mesh/hub%2Fleft'].attrs['name'], len(f['mesh/hub%2Fleft'].attrs['resultant_names']))
print(f['steps/000007/position'].shape, f['steps/000007/resultants'].shape)
print(list(f['mesh/patch'].attrs['fields']), list(f['mesh/patch'].attrs['tables']))
h = f['history/values']
print(list(h.attrs['names']), list(h.attrs['units']), h[...].tolist())
s = f['report/scalars']
print(repr(f['report/text'].asstr()[()]), {k: (s[k][()], s[k].attrs['unit']) for k in s})
)",
                                      folder / "run.h5");
  EXPECT_EQ(text,
            "culm run 4\n"
            "bent tube 0.1.0 '<ParameterList name=\"µ\"/>\\n'\n"
            "['000000', '000007'] [0.0, 0.7000000000000001]\n"
            "Beam ['N1', 'N2', 'N3', 'M1', 'M2', 'M3']\n"
            "hub/left 0\n"
            "(10, 3) (4, 6)\n"
            "['position', 'displacement', 'director3', 'resultants', 'stress'] "
            "['position', 'displacement', 'director3', 'resultants%2F2', 'stress']\n"
            "['time', 'energy', 'drift', 'analysis', 'step'] ['s', 'J', '', '', ''] "
            "[[0.25, 1.0, nan, 1.0, 4.0]]\n"
            "'finished\\n' {'a%2Fb': (2.0, ''), 'energy drift': (1e-12, 'J')}\n");
}

TEST(Recorder, WhatIsAddedIsInTheFileWithinATenthOfASecond) {
  const TemporaryFolder folder;
  Recorder recorder = make_recorder(folder / "run.h5");
  recorder.add_history({0.0, std::array{1.0, 2.0}});
  recorder.add_history({1.0, std::array{1.0, 2.0}});
  std::this_thread::sleep_for(std::chrono::milliseconds(101));
  recorder.add_history({2.0, std::array{1.0, 2.0}});
  EXPECT_EQ(read_dataset(folder / "run.h5", "/history/values").size(), 15U);
}

TEST(Recorder, WithoutACloseTheFileIsCompleteAllTheSame) {
  const TemporaryFolder folder;
  {
    Recorder recorder = make_recorder(folder / "run.h5");
    for (int i = 0; i < 50; ++i) {
      record_sample(recorder, i);
      recorder.add_history({1.0 * i, std::array{1.0, 2.0}});
    }
  }
  EXPECT_EQ(count_links(folder / "run.h5", "/steps"), 50);
  EXPECT_EQ(read_dataset(folder / "run.h5", "/history/values").size(), 250U);
}

TEST(Recorder, KilledRunLosesAtMostWhatCameAfterItsLastCommit) {
  for (int round = 0; round < 8; ++round) {
    const TemporaryFolder folder;
    int progress[2];
    ASSERT_EQ(::pipe(progress), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      Recorder recorder = make_recorder(folder / "run.h5");
      Picture picture = sample_picture(sample_meshes(4), 1);
      for (picture.index = 0;; ++picture.index) {
        recorder.record(sample_meshes(4), picture);
        recorder.add_history({1.0 * picture.index, std::array{1.0 * picture.index, 0.0}});
        if (picture.index % 5 != 4) continue;
        recorder.commit();
        if (::write(progress[1], &picture.index, sizeof picture.index) < 0) ::_exit(1);
      }
    }
    ::close(progress[1]);
    int last = -1;
    while (last < 100 + 7 * round) ASSERT_GT(::read(progress[0], &last, sizeof last), 0);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    while (::read(progress[0], &last, sizeof last) > 0) continue;
    ::close(progress[0]);

    recover_run(folder / "run.h5");
    EXPECT_GE(count_links(folder / "run.h5", "/steps"), last + 1);
    const std::string step = "/steps/" + std::to_string(1000000 + last).substr(1);
    EXPECT_EQ(read_dataset(folder / "run.h5", step + "/position").size(), 30U);
    EXPECT_GE(read_dataset(folder / "run.h5", "/history/values").size(), 5U * (last + 1U));
  }
}

// A file of some steps, and how far it was after the first three of them.
RecordMark write_run(const std::filesystem::path& path, int steps) {
  RecordMark mark;
  Recorder recorder = make_recorder(path);
  for (int i = 0; i < steps; ++i) {
    if (i == 3) {
      recorder.write_results({"modes", {{"table", {"f"}, {{1.5}, {2.5}}, {}}}, {}, {}, {}});
      mark = recorder.commit();
    }
    record_sample(recorder, i);
    recorder.add_history({1.0 * i, std::array{10.0 * i, 0.5}});
  }
  recorder.write_report("stopped", {});
  return mark;
}

std::string failure(const std::function<void()>& action) {
  try {
    action();
  } catch (const FileError& error) {
    return error.what();
  }
  return {};
}

TEST(Recorder, AnEarlierRunGoesOnAsItWasThen) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "run.h5";
  const std::vector<StructureMesh> meshes = sample_meshes(4);
  const std::vector<HistoryColumn> columns = {{"energy", "J"}, {"drift", ""}};
  const RecordMark mark = write_run(path, 500);
  const Recorded recorded = find_recorded(path, info.run, mark);
  EXPECT_EQ(recorded.steps.size(), 3U);
  EXPECT_EQ(recorded.steps.back().index, 2);
  EXPECT_EQ(recorded.history.size(), 15U);
  EXPECT_EQ(recorded.history[11], 20.0);
  {
    Recorder recorder(path, {"longer", "0.2.0", "<deck/>", info.run}, meshes, columns, mark,
                      recorded);
    EXPECT_EQ(count_links(path, "/steps"), 3);
    EXPECT_EQ(count_links(path, "/report"), -1);
    EXPECT_EQ(count_links(path, "/analyses"), 1);
    EXPECT_EQ(read_dataset(path, "/history/values"), recorded.history);
    for (int i = 3; i < 5; ++i) {
      recorder.record(meshes, sample_picture(meshes, i));
      recorder.add_history({1.0 * i, std::array{10.0 * i, 0.5}});
    }
    EXPECT_EQ(find_recorded(path, info.run, recorder.commit()).steps.size(), 5U);
    recorder.close();
  }
  EXPECT_EQ(count_links(path, "/steps"), 5);
  EXPECT_EQ(read_dataset(path, "/history/values").size(), 25U);
  EXPECT_EQ(read_dataset(path, "/history/values")[22], 0.5);
  EXPECT_EQ(read_dataset(path, "/steps/000004/position").size(), 30U);
}

TEST(Recorder, WhatDoesNotBelongToTheMarkIsRefusedAndStaysAsItIs) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "run.h5";
  const RecordMark mark = write_run(path, 4);
  const std::string before = read_bytes(path);
  const std::string name = path.string();
  EXPECT_EQ(failure([&] { find_recorded(path, "another", mark); }),
            name + ": is not the result file of this checkpoint: it belongs to run " + info.run +
                ", the checkpoint to run another");
  RecordMark more = mark;
  more.steps = 5;
  EXPECT_EQ(failure([&] { find_recorded(path, info.run, more); }),
            name + ": holds 4 states, fewer than the 5 of the checkpoint");
  more = mark;
  more.rows = 5;
  EXPECT_EQ(failure([&] { find_recorded(path, info.run, more); }),
            name + ": holds 4 steps of the history, fewer than the 5 of the checkpoint");
  const Recorded recorded = find_recorded(path, info.run, mark);
  EXPECT_EQ(
      failure([&] {
        Recorder(path, info, sample_meshes(5), {{"energy", "J"}, {"drift", ""}}, mark, recorded);
      }),
      name + ": is of another model: its meshes or its columns differ");
  EXPECT_EQ(read_bytes(path), before);
  EXPECT_FALSE(std::filesystem::exists(name + ".part"));
}

// One bit after the other, spread over the file: a run goes on with what was written, or not at
// all.
TEST(Recorder, AFlippedBitIsFoundOrHarmless) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "run.h5";
  const RecordMark mark = write_run(path, 4);
  const std::string sound = read_bytes(path);
  const Recorded expected = find_recorded(path, info.run, mark);
  int refused = 0;
  constexpr std::size_t flips = 160;
  for (std::size_t k = 0; k < flips; ++k) {
    std::string damaged = sound;
    const std::size_t bit = k * 8 * sound.size() / flips + k % 8;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    std::ofstream(path, std::ios::binary) << damaged;
    try {
      const Recorded found = find_recorded(path, info.run, mark);
      EXPECT_EQ(found.history, expected.history) << "bit " << bit;
      Recorder recorder(path, info, sample_meshes(4), {{"energy", "J"}, {"drift", ""}}, mark,
                        found);
      recorder.close();
      EXPECT_NO_THROW(find_recorded(path, info.run, mark)) << "bit " << bit;
    } catch (const FileError&) {
      ++refused;
      EXPECT_EQ(read_bytes(path), damaged) << "bit " << bit;
    }
  }
  EXPECT_GT(refused, 20);
}

TEST(Recorder, NothingButTheFinishedFileStaysInTheFolder) {
  const TemporaryFolder folder;
  { Recorder recorder = make_recorder(folder / "run.h5"); }
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    EXPECT_EQ(entry.path().filename(), "run.h5");
  }
}

TEST(Recorder, MissingFolderIsAFileErrorWithTheReason) {
  const TemporaryFolder folder;
  try {
    make_recorder(folder / "missing/run.h5");
    FAIL() << "no error";
  } catch (const FileError& error) {
    EXPECT_THAT(error.what(), HasSubstr((folder / "missing/run.h5").string()));
    EXPECT_THAT(error.what(), HasSubstr("No such file or directory"));
  }
}

TEST(Recorder, ReadOnlyFolderIsAFileError) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryFolder folder;
  std::filesystem::permissions(
      folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_THROW(make_recorder(folder / "run.h5"), FileError);
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

TEST(Recorder, FileInPlaceOfTheFolderIsAFileError) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "text";
  EXPECT_THROW(make_recorder(folder / "file/run.h5"), FileError);
}

TEST(Recorder, OldFileStaysIfTheNewOneCannotBeMade) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "run.h5.part");
  std::ofstream(folder / "run.h5") << "old";
  EXPECT_THROW(make_recorder(folder / "run.h5"), FileError);
  EXPECT_EQ(read_text_file(folder / "run.h5"), "old");
}

// In a process of its own, because the limit cannot be lifted again.
TEST(Recorder, FullDiskIsAFileErrorAndKeepsEarlierCommits) {
  const TemporaryFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100000, 100000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    int code = 1;
    try {
      Recorder recorder = make_recorder(folder / "run.h5");
      Picture picture = sample_picture(sample_meshes(4), 1);
      for (picture.index = 0; picture.index < 1000; ++picture.index) {
        recorder.record(sample_meshes(4), picture);
        if (picture.index == 2) recorder.commit();
      }
    } catch (const FileError& error) {
      code = std::string(error.what()).find("File too large") != std::string::npos ? 6 : 2;
    }
    if (::H5close() < 0) code = 3;  // as at the end of a program, where HDF5 must not crash
    ::_exit(code);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 6);
  recover_run(folder / "run.h5");
  EXPECT_GE(count_links(folder / "run.h5", "/steps"), 3);
  EXPECT_EQ(read_dataset(folder / "run.h5", "/steps/000001/position").size(), 30U);
}

TEST(Recorder, TablesMayBeWrittenByOthersRowByRow) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "run.h5";
  const std::vector<StructureMesh> meshes = sample_meshes(4);
  const StateTables tables(fields_of(meshes));
  const Picture picture = sample_picture(meshes, 0);
  RecordMark mark;
  {
    Recorder recorder = make_recorder(path);
    recorder.begin(picture);
    for (std::size_t t = 0; t < tables.tables().size(); ++t) {
      const std::vector<double> values = tables.values(t, meshes, picture.structures);
      const auto room = recorder.room_of(t);
      if (t % 2 == 0 || !room) {  // what is tiny may stand among what counts already
        recorder.put(t, values);
        continue;
      }
      std::fstream other(path, std::ios::binary | std::ios::in | std::ios::out);
      other.seekp(static_cast<std::streamoff>(*room));
      other.write(reinterpret_cast<const char*>(values.data()),
                  static_cast<std::streamsize>(values.size() * sizeof(double)));
      recorder.note(t, sum_of_numbers(values));
    }
    recorder.end();
    record_sample(recorder, 1);
    mark = recorder.commit();
  }
  EXPECT_EQ(find_recorded(path, info.run, mark).steps.size(), 2U);
  for (std::size_t t = 0; t < tables.tables().size(); ++t) {
    EXPECT_EQ(read_dataset(path, "/steps/000000/" + tables.tables()[t].name),
              tables.values(t, meshes, picture.structures));
  }
  mark.steps_sum += 1;
  EXPECT_THROW(find_recorded(path, info.run, mark), FileError);
}

TEST(Recorder, RowsOfPartsAreThoseOfTheWholeTable) {
  const std::vector<StructureMesh> meshes = {tube_mesh(4), tube_mesh(2)};
  const StateTables tables(fields_of(meshes));
  const std::vector<StructurePart> parts = {{{{1, 2}, {4, 1}}, {{0, 1}}}, {{{0, 3}}, {}}};
  const auto rows = [&](std::size_t table) {
    std::vector<std::size_t> all;
    for (const RowRange& range : tables.rows(table, parts)) {
      for (std::size_t i = 0; i < range.count; ++i) all.push_back(range.first + i);
    }
    return all;
  };
  for (std::size_t t = 0; t < tables.tables().size(); ++t) {
    if (tables.tables()[t].name == "resultants") {
      EXPECT_THAT(rows(t), ElementsAre(0));
    } else {
      EXPECT_THAT(rows(t), ElementsAre(1, 2, 4, 5, 6, 7)) << tables.tables()[t].name;
    }
  }
}

TEST(Recorder, StepsAreNotOverwritten) {
  const TemporaryFolder folder;
  Recorder recorder = make_recorder(folder / "run.h5");
  record_sample(recorder, 0);
  EXPECT_THROW(record_sample(recorder, 0), FileError);
}

TEST(Recorder, WrongSizesAreABug) {
  const TemporaryFolder folder;
  Recorder recorder = make_recorder(folder / "run.h5");
  Picture picture = sample_picture(sample_meshes(4), 0);
  picture.structures[0].positions.pop_back();
  EXPECT_THROW(recorder.record(sample_meshes(4), picture), InternalError);
  EXPECT_THROW(recorder.add_history({0.0, std::array{1.0}}), InternalError);
  recorder.close();
  EXPECT_THROW(record_sample(recorder, 0), InternalError);
  std::vector<StructureMesh> twins = {body_mesh(), body_mesh()};
  EXPECT_THROW(Recorder(folder / "twins.h5", info, twins, {}), InternalError);
}

}  // namespace
}  // namespace culm::output
