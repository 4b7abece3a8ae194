#include <culm/base/error.hpp>
#include <culm/base/read_file.hpp>
#include <culm/base/text.hpp>
#include <culm/simulation/memory.hpp>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

namespace culm::simulation {
namespace {

double soft_limit(int resource) {
  rlimit limit{};
  const bool is_known = ::getrlimit(static_cast<__rlimit_resource>(resource), &limit) == 0;
  return is_known && limit.rlim_cur != RLIM_INFINITY ? static_cast<double>(limit.rlim_cur)
                                                     : INFINITY;
}

// What a container leaves its processes (control groups, version 2); it says "max" for no limit.
double group_limit() {
  const std::string text = find_text("/sys/fs/cgroup/memory.max").text;
  double bytes = INFINITY;
  std::from_chars(text.data(), text.data() + text.size(), bytes);
  return bytes;
}

}  // namespace

double machine_memory(int processes) {
  const double physical =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  const double of_each = std::min(soft_limit(RLIMIT_AS), soft_limit(RLIMIT_DATA));
  return std::min({physical, processes * of_each, group_limit()});
}

double read_memory(const std::string& text, int processes) {
  if (text.empty()) return machine_memory(processes);
  static const std::map<std::string, double, std::less<>> units = {
      {"kb", 1e3}, {"mb", 1e6}, {"gb", 1e9}, {"tb", 1e12}};
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const auto unit = units.find(to_lower(trim(std::string_view(end, text.data() + text.size()))));
  if (error != std::errc() || unit == units.end() || !(number > 0.0) || !std::isfinite(number)) {
    throw UsageError("--max-memory needs a size such as '500 MB' or '16 GB', got '" + text + "'");
  }
  return number * unit->second;
}

double least_memory(double bytes, const parallel::Comm& comm) { return -comm.max(-bytes); }

void limit_memory(double bytes) {
#ifndef __SANITIZE_ADDRESS__     // which reserves far more than it uses
  constexpr double least = 1e9;  // for the program and its libraries
  bytes = std::max(bytes, least);
  rlimit limit{};
  if (::getrlimit(RLIMIT_DATA, &limit) != 0) return;
  if (bytes >= std::min(static_cast<double>(limit.rlim_cur), 1e18)) return;
  limit.rlim_cur = static_cast<rlim_t>(bytes);
  ::setrlimit(RLIMIT_DATA, &limit);
#else
  static_cast<void>(bytes);
#endif
}

}  // namespace culm::simulation
