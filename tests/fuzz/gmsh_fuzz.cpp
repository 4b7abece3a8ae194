// A mesh of Gmsh.

#include <culm/shell/gmsh_reader.hpp>

#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace culm;
  fuzz::survive(
      [&] { (void)shell::read_gmsh(std::string(fuzz::text_of(data, size)), "mesh.msh"); });
  return 0;
}
