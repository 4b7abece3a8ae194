// Files of OpenFAST. An input is one text, in which a line "%%% NAME" begins the file NAME; the
// first file is the one to import.

#include <culm/openfast/import.hpp>

#include "fuzz_target.hpp"

#include <string>

namespace {

constexpr std::string_view mark = "%%% ";

// A name that stays in the folder, or none.
std::string plain_name(std::string_view line) {
  std::string name(line.substr(0, 40));
  while (!name.empty() && name.back() == '\r') name.pop_back();
  const bool leaves = name.find_first_of(std::string("/\0", 2)) != std::string::npos;
  return leaves || name == "." || name == ".." ? std::string() : name;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace culm;
  std::string_view rest = fuzz::text_of(data, size);
  std::filesystem::path first;
  while (rest.starts_with(mark)) {
    const auto line_end = std::min(rest.find('\n'), rest.size() - 1);
    const std::string name = plain_name(rest.substr(mark.size(), line_end - mark.size()));
    rest.remove_prefix(line_end + 1);
    const auto next = rest.find("\n%%% ");
    const std::string_view content =
        next == std::string_view::npos ? rest : rest.substr(0, next + 1);
    rest.remove_prefix(content.size());
    if (name.empty()) continue;
    const auto path = fuzz::write_scratch(name, content);
    if (first.empty()) first = path;
  }
  if (!first.empty()) fuzz::survive([&] { (void)openfast::import_file(first); });
  for (const auto& entry : std::filesystem::directory_iterator(fuzz::scratch_folder())) {
    std::filesystem::remove(entry.path());
  }
  return 0;
}
