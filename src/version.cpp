#include "version.hpp"

#include <culm/base/version.hpp>
#include <culm/deck/format.hpp>

#include "build_info.hpp"

namespace culm::app {

std::string version_text() {
  return std::string(version) + "\ncommit: " + build_info::commit + "\nbuild: " + build_info::type +
         ", " + build_info::compiler + "\ndeck format: " + std::to_string(deck::format_version);
}

}  // namespace culm::app
