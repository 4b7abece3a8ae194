#include <culm/base/error.hpp>
#include <culm/control/swap_library.hpp>

#include <dlfcn.h>
#include <link.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

namespace culm::control {
namespace {

namespace fs = std::filesystem;

std::string reason() {
  const char* text = dlerror();
  return text != nullptr ? text : "no reason is given";
}

void* open_file(const std::string& path, int more) { return dlopen(path.c_str(), RTLD_NOW | more); }

// A file under a name of its own in a folder, which goes with this.
class Copy {
 public:
  Copy(const fs::path& file, const fs::path& folder)
      : name_((folder / ("." + file.stem().string() + "-XXXXXX.so")).string()) {
    constexpr int behind = 3;  // what stands there
    const int place = mkstemps(name_.data(), behind);
    if (place < 0) throw FileError(folder.string(), "cannot be written to");
    close(place);
    std::error_code failure;
    fs::copy_file(file, name_, fs::copy_options::overwrite_existing, failure);
    if (failure) {
      unlink(name_.c_str());
      throw FileError(folder.string(), failure.message());
    }
  }
  Copy(const Copy&) = delete;
  Copy& operator=(const Copy&) = delete;
  ~Copy() { unlink(name_.c_str()); }
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

// The file of a library that is loaded, wherever the system has found it.
fs::path file_of(void* library, const std::string& path) {
  link_map* map = nullptr;
  const bool is_known = dlinfo(library, RTLD_DI_LINKMAP, static_cast<void*>(&map)) == 0;
  return fs::absolute(is_known && map->l_name[0] != '\0' ? map->l_name : path.c_str());
}

// Beside the file a copy finds what the file finds there ($ORIGIN). That folder may not be
// writable, and that of temporary files may have no programs.
void* load_copy(const fs::path& file) {
  std::string reasons;
  std::error_code failure;
  for (const fs::path& folder : {file.parent_path(), fs::temp_directory_path(failure)}) {
    if (folder.empty()) continue;
    try {
      const Copy copy(file, folder);
      if (void* const library = open_file(copy.name(), RTLD_LOCAL)) return library;
      reasons += "; " + reason();
    } catch (const FileError& error) {
      reasons += std::string("; ") + error.what();
    }
  }
  throw FileError(file.string(),
                  "is in use by another signal, and a copy for this one can be loaded neither from "
                  "beside it nor from the folder of temporary files (TMPDIR)" +
                      reasons);
}

// The system loads a file once, with one memory for all who name it: whoever comes later has a
// copy.
void* load_alone(const std::string& path) {
  void* const other = open_file(path, RTLD_LOCAL | RTLD_NOLOAD);
  if (other == nullptr) return open_file(path, RTLD_LOCAL);
  const fs::path file = file_of(other, path);
  dlclose(other);
  return load_copy(file);
}

// A text that the library may read, with the zero that ends it.
std::vector<char> zero_ended(const std::string& text) {
  std::vector<char> characters(text.begin(), text.end());
  characters.push_back('\0');
  return characters;
}

}  // namespace

void SwapLibrary::Close::operator()(void* handle) const { dlclose(handle); }

SwapLibrary::SwapLibrary(const std::string& path, const std::string& procedure, std::string input,
                         std::string name)
    : path_(path), input_(std::move(input)), name_(std::move(name)), swap_(records, 0.0F) {
  handle_.reset(load_alone(path));
  if (handle_ == nullptr) throw FileError(path, "cannot be loaded: " + reason());
  void* found = dlsym(handle_.get(), procedure.c_str());
  if (found == nullptr) throw FileError(path, "has no procedure '" + procedure + "': " + reason());
  procedure_ = reinterpret_cast<Procedure>(found);
  set(49, message_size);
  set(50, static_cast<double>(input_.size() + 1));
  set(51, static_cast<double>(name_.size() + 1));
  set(64, static_cast<double>(name_.size() + 1));
  set(129, records);
}

std::string SwapLibrary::call(Status status, double time, double since) {
  set(1, static_cast<double>(status));
  set(2, time);
  set(3, since);
  std::vector<char> input = zero_ended(input_);
  std::vector<char> name = zero_ended(name_);
  std::vector<char> message(message_size + 1, '\0');
  int failure = 0;
  procedure_(swap_.data(), &failure, input.data(), name.data(), message.data());
  message.back() = '\0';
  std::string text = message.data();
  text.erase(std::find_if(text.rbegin(), text.rend(), [](char c) { return c != ' '; }).base(),
             text.end());
  if (text.empty()) text = "without a message";
  if (failure < 0) {
    throw NumericalError("the library '" + path_ + "' failed at " + std::to_string(time) +
                         " s, aviFAIL = " + std::to_string(failure) + ": " + text);
  }
  return failure > 0 ? text : std::string();
}

}  // namespace culm::control
