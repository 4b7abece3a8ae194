#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace culm {

/// What a part of a run needs to go on as if it had never stopped: numbers and texts by name. Each
/// part writes under names that begin with its own, such as "certificate" or "output/frames".
/// Doubles are kept bit by bit; whole numbers fit in them.
class Snapshot {
 public:
  /// What it is good for.
  enum class Use {
    files,   ///< whole on rank 0, and the same for any number of ranks
    memory,  ///< what each rank has, to go back within a run: no communication
  };
  explicit Snapshot(Use use = Use::files) : use_(use) {}
  bool is_for_memory() const { return use_ == Use::memory; }

  void set(const std::string& name, std::vector<double> numbers);
  void set(const std::string& name, double number);
  void set_text(const std::string& name, std::string text);

  /// Throws FileError if there is nothing of this name.
  const std::vector<double>& numbers(const std::string& name) const;
  /// The same, of a known length.
  const std::vector<double>& numbers(const std::string& name, std::size_t count) const;
  double number(const std::string& name) const;
  int integer(const std::string& name) const;
  const std::string& text(const std::string& name) const;
  bool has(const std::string& name) const;

  /// As bytes, in the order of this machine.
  std::string encode() const;
  /// Throws FileError if the bytes are not what encode() made.
  static Snapshot decode(std::string_view bytes);

 private:
  Use use_;
  std::map<std::string, std::vector<double>> numbers_;
  std::map<std::string, std::string> texts_;
};

}  // namespace culm
