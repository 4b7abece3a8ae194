#include "file_end.hpp"

#include "headings.hpp"

namespace culm::openfast {

void check_end(const InputFile& file, Report& report) {
  if (file.has_line("END")) return;
  report.add(unknown, file.path().string() + ": has no line END; it may have been cut off");
}

}  // namespace culm::openfast
