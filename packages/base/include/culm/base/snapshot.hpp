#pragma once

#include <culm/base/row_ranges.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
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
    shared,  ///< the same, but what is large is found when it is written, by each rank its own rows
    memory,  ///< what each rank has, to go back within a run: no communication
  };
  explicit Snapshot(Use use = Use::files) : use_(use) {}
  bool is_for_memory() const { return use_ == Use::memory; }
  bool is_shared() const { return use_ == Use::shared; }

  void set(std::string_view name, std::span<const double> numbers);
  void set(std::string_view name, std::vector<double>&& numbers);
  void set(std::string_view name, std::initializer_list<double> numbers);
  void set(std::string_view name, double number);
  void set_text(std::string_view name, std::string text);

  /// The rows that this rank has of a table that all ranks have together.
  struct Table {
    std::string name;
    std::size_t rows = 0;  ///< of all ranks
    std::size_t width = 1;
    RowRanges own;
    /// Finds them, row after row; shape (count_rows(own) * width).
    std::function<std::vector<double>()> find;
  };
  /// All ranks add the same tables in the same order. Once decoded, each is numbers of its name.
  /// What a table is found from has to stay until it is written.
  void add_table(Table table) { tables_.push_back(std::move(table)); }
  const std::vector<Table>& tables() const { return tables_; }

  /// Good until something is set. Throws FileError if there is nothing of this name.
  std::span<const double> numbers(std::string_view name) const;
  /// The same, of a known length.
  std::span<const double> numbers(std::string_view name, std::size_t count) const;
  /// A copy of them.
  std::vector<double> copy(std::string_view name) const;
  double number(std::string_view name) const;
  int integer(std::string_view name) const;
  const std::string& text(std::string_view name) const;
  bool has(std::string_view name) const;

  /// As bytes, in the order of this machine, a multiple of eight of them; but the numbers of
  /// tables, which are to follow, one table after the other.
  std::string encode() const;
  /// The same piece by piece.
  void encode(const std::function<void(std::string_view)>& take) const;
  /// Throws FileError if the bytes are not what encode() made.
  static Snapshot decode(std::string_view bytes);

 private:
  // Steps are saved and restored as often as they are tried, so that small things cost no memory of
  // their own: their names and numbers follow each other.
  struct Entry {
    std::size_t name = 0;    ///< where it begins in names_
    std::size_t length = 0;  ///< of the name
    std::size_t first = 0;   ///< number in small_
    std::size_t count = 0;
    std::vector<double> large;
  };
  std::string_view name_of(const Entry& entry) const;
  std::span<const double> numbers_of(const Entry& entry) const;
  /// Its number; that of all entries if there is none.
  std::size_t find(std::string_view name) const;
  Entry& make(std::string_view name);

  Use use_;
  std::vector<Entry> entries_;
  std::vector<std::uint64_t> marks_;     ///< of their names, most of which differ in it
  std::array<std::uint64_t, 4> seen_{};  ///< a bit for each mark: who has none there is new
  std::string names_;
  std::vector<double> small_;
  std::map<std::string, std::string, std::less<>> texts_;
  std::vector<Table> tables_;
};

}  // namespace culm
