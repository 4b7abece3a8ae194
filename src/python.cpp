#include "python.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace culm::app {
namespace {

// The same place relative to the program in the build tree and where it is installed.
std::filesystem::path package_folder(const std::filesystem::path& program) {
  return program.parent_path().parent_path() / "share/culm/python";
}

int replace_process(const std::filesystem::path& program, const std::vector<std::string>& words) {
  const std::filesystem::path folder = package_folder(program);
  const char* others = std::getenv("PYTHONPATH");
  const std::string path = others == nullptr ? folder.string() : folder.string() + ":" + others;
  setenv("PYTHONPATH", path.c_str(), 1);
  setenv("PYTHONDONTWRITEBYTECODE", "1", 1);
  setenv("CULM_PROGRAM", program.c_str(), 1);
  std::vector<std::string> command = {CULM_PYTHON, "-m", "culm"};
  command.insert(command.end(), words.begin(), words.end());
  std::vector<char*> pointers;
  for (std::string& word : command) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(pointers.front(), pointers.data());
  std::fprintf(stderr, "cannot start %s, which '%s' needs\n", CULM_PYTHON, words.front().c_str());
  return 6;
}

int cannot_start(const std::vector<std::string>& words) {
  std::fprintf(stderr, "cannot start a process for '%s'\n", words.front().c_str());
  return 6;
}

}  // namespace

const std::vector<PythonVerb>& python_verbs() {
  static const std::vector<PythonVerb> verbs = {
      {"completion", "Print what bash or zsh needs to complete command lines"},
      {"hard", "Run the hard cases with growing stressors and tell their margins"},
      {"effects", "Tell what the effects of a scene cost, and what changes without each"},
      {"export", "Write a deck with ports as an FMU, which other programs drive step by step"},
      {"manual", "Write the manual as pages for man"},
      {"report", "Draw the page of a run: report.html in its folder"},
      {"study", "Measure what accuracy costs: vary a deck, compare with a reference, advise"},
      {"sweep",
       "Run a deck with many values, several runs at once or in the jobs of an array: sweep.csv"},
      {"view", "Write a page that shows a run in space and time: view.html in its folder"},
  };
  return verbs;
}

bool is_for_python(const std::vector<std::string>& words) {
  if (words.empty()) return false;
  // of all formats only this one is read here
  if (words.front() == "import") return words.size() < 2 || words[1] != "openfast";
  return std::ranges::find(python_verbs(), words.front(), &PythonVerb::name) !=
         python_verbs().end();
}

int become_python(const std::vector<std::string>& words) {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? cannot_start(words) : replace_process(program, words);
}

int call_python(const std::vector<std::string>& words) {
  const pid_t child = fork();
  if (child == 0) _exit(become_python(words));
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) < 0) return cannot_start(words);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace culm::app
