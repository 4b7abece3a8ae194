#include <culm/base/file_pages.hpp>

#include <sys/mman.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

namespace culm {
namespace {

// A stretch of addresses, as /proc/self/smaps tells them.
struct Mapping {
  std::uintptr_t begin = 0, end = 0;
  std::string rights;
  unsigned long file = 0;     // its inode; 0 if there is none
  std::size_t resident = 0;   // bytes
  std::size_t anonymous = 0;  // bytes that are no longer those of the file

  // Relocated constants and breakpoints of a debugger would be lost.
  bool can_come_again() const {
    return file != 0 && anonymous == 0 && rights.starts_with("r-") && rights.ends_with('p');
  }
};

std::size_t kilobytes(const std::string& line) {
  return 1024 * std::stoul(line.substr(line.find(':') + 1));
}

// Which lines follow the first one of a mapping depends on the system; VmFlags ends them.
template <class Visit>
void for_mappings(const Visit& visit) {
  std::ifstream file("/proc/self/smaps");
  Mapping mapping;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("Rss:")) {
      mapping.resident = kilobytes(line);
    } else if (line.starts_with("Anonymous:")) {
      mapping.anonymous = kilobytes(line);
    } else if (line.starts_with("VmFlags:")) {
      visit(mapping);
    } else if (line.find(':') > line.find(' ')) {
      std::istringstream words(line);
      char dash = 0;
      std::string offset, device;
      mapping = {};
      words >> std::hex >> mapping.begin >> dash >> mapping.end >> mapping.rights >> offset >>
          device >> std::dec >> mapping.file;
    }
  }
}

}  // namespace

std::size_t give_back_file_pages() {
  std::size_t bytes = 0;
  for_mappings([&](const Mapping& mapping) {
    if (!mapping.can_come_again()) return;
    void* const first = reinterpret_cast<void*>(mapping.begin);
    const bool is_done = ::madvise(first, mapping.end - mapping.begin, MADV_DONTNEED) == 0;
    if (is_done) bytes += mapping.resident;
  });
  return bytes;
}

}  // namespace culm
