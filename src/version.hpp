#pragma once

#include <string>

namespace culm::app {

/// What `culm --version` prints: the version in the first line, commit, build and format of decks
/// below.
std::string version_text();

}  // namespace culm::app
