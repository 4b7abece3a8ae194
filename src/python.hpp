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

/// Whether a word of the command line is one of them.
bool is_python_verb(const std::string& word);

/// Runs `culm VERB arguments` in Python, in a process of its own, and waits for it. Must not be
/// called while MPI is running.
/// @return its exit code; 6, with a line on standard error, if it cannot be started
int call_python(const std::vector<std::string>& words);

}  // namespace culm::app
