#include <culm/base/error.hpp>
#include <culm/simulation/memory.hpp>

#include <gtest/gtest.h>

namespace culm::simulation {
namespace {

TEST(Memory, IsASizeWithItsUnit) {
  EXPECT_EQ(read_memory("16 GB"), 16e9);
  EXPECT_EQ(read_memory("0.5tb"), 0.5e12);
  EXPECT_EQ(read_memory("20kB"), 20e3);
  EXPECT_EQ(read_memory(""), machine_memory());
  EXPECT_GT(machine_memory(), 1e6);
  for (const char* text : {"16", "GB", "-1 GB", "0 MB", "nan GB", "1 GB or so", "1e400 GB"}) {
    EXPECT_THROW(read_memory(text), UsageError) << text;
  }
}

}  // namespace
}  // namespace culm::simulation
