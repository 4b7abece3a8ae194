#include <culm/base/error.hpp>
#include <culm/control/swap_library.hpp>

#include <dlfcn.h>

#include <algorithm>
#include <utility>

namespace culm::control {
namespace {

std::string reason() {
  const char* text = dlerror();
  return text != nullptr ? text : "no reason is given";
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
  handle_.reset(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL));
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
