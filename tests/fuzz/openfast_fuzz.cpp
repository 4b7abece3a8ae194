// Files of OpenFAST. An input is one text, in which a line "%%% NAME" begins the file NAME; the
// first file is the one to import.

#include <culm/openfast/import.hpp>

#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace culm;
  const auto first = fuzz::write_files(fuzz::text_of(data, size));
  if (!first.empty()) fuzz::survive([&] { (void)openfast::import_file(first); });
  fuzz::empty_scratch();
  return 0;
}
