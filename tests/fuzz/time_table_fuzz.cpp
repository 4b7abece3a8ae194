// Points of a function of time, from a file.

#include "fuzz_target.hpp"
#include "time_table.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace culm;
  const auto path = fuzz::write_scratch("table.csv", fuzz::text_of(data, size));
  fuzz::survive([&] {
    const model::TimeTable table = model::read_time_table(path.string(), {});
    for (const double time : table.times) (void)table.value(0.5 * time);
  });
  return 0;
}
