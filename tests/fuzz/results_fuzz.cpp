// A result file that a run is to go on with, damaged. An input is a list of edits, four bytes each:
// a place, 24 bits wide, and what its byte is changed by. What is read is what was written, or an
// error.

#include <culm/output/recorder.hpp>

#include "fuzz_target.hpp"
#include "sample_model.hpp"

#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace {

using namespace culm;

struct SoundRun {
  std::string bytes;
  output::RecordMark mark;
  output::Recorded content;
};

constexpr const char* name = "4711";

SoundRun record_run() {
  const auto path = fuzz::scratch_folder() / "sound.h5";
  const auto meshes = output::sample_meshes(4);
  output::Recorder recorder(path, {"bent tube", "0", "<ParameterList/>", name}, meshes,
                            {{"energy", "J"}, {"drift", ""}});
  for (int i = 0; i < 2; ++i) {
    recorder.record(meshes, output::sample_picture(meshes, i));
    recorder.add_history({0.5 * i, std::array{1.0 + i, 2.0}, 0, i});
  }
  SoundRun run;
  run.mark = recorder.commit();
  recorder.close();
  std::ifstream file(path, std::ios::binary);
  run.bytes.assign(std::istreambuf_iterator<char>(file), {});
  run.content = output::find_recorded(path, name, run.mark);
  return run;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  static const SoundRun sound = record_run();
  std::string bytes = sound.bytes;
  for (std::size_t i = 0; i + 4 <= size && i < 256; i += 4) {
    const std::size_t place = data[i] + 256u * (data[i + 1] + 256u * data[i + 2]);
    char& byte = bytes[place % bytes.size()];
    byte = static_cast<char>(byte ^ data[i + 3]);
  }
  const auto path = fuzz::write_scratch("run.h5", bytes);
  fuzz::survive([&] {
    (void)output::recover_run(path);
    if (output::find_recorded(path, name, sound.mark).history != sound.content.history) {
      std::fprintf(stderr, "another history was read than the one that was written\n");
      std::abort();
    }
  });
  return 0;
}
