// A result file that a run is to go on with.

#include <culm/output/recorded.hpp>
#include <culm/output/recorder.hpp>

#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace culm;
  const auto path = fuzz::write_scratch("run.h5", fuzz::text_of(data, size));
  fuzz::survive([&] {
    (void)output::recover_run(path);
    (void)output::find_recorded(path, 1, 1);
  });
  return 0;
}
