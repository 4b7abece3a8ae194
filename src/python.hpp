/// Verbs that are written in Python: the package src/python/culm, installed beside the program.
#pragma once

#include <string>
#include <vector>

namespace culm::app {

/// A verb and what its line in the help says.
struct PythonVerb {
  std::string name;
  std::string summary;
};

/// Verbs of the package; each is a module of this name.
const std::vector<PythonVerb>& python_verbs();

/// Whether a command line is one for Python: one of these verbs, or `import` of a format that is
/// read there.
bool is_for_python(const std::vector<std::string>& words);

/// Runs `culm VERB arguments` in Python in place of this program, so that signals reach it. Returns
/// only if it cannot be started: 6, with a line on standard error.
int become_python(const std::vector<std::string>& words);

/// The same in a process of its own, for which it waits. Must not be called while MPI is running.
/// @return its exit code; 6, with a line on standard error, if it cannot be started
int call_python(const std::vector<std::string>& words);

}  // namespace culm::app
