/// Numbers of all nodes, of which a rank may need few.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>

namespace culm::model {

/// Director coordinates of all nodes, node after node as the NodeTable lays them out, or anything
/// else of that shape. Zero at first; memory stands only behind pages that something else was
/// written to. So every rank numbers nodes as the model does, and holds those that it needs: what
/// is zero page by page is left out by copies and by `combine`, and `release` gives pages back.
class Coordinates {
 public:
  /// Numbers that are left out together, as many as the smallest page of memory holds.
  static constexpr std::size_t page = 512;

  /// Of what is made from then on in this process: whether something is written to all pages, which
  /// large pages of memory are for. Otherwise, as at first, a large page would be had for a number.
  static void expect_all(bool all) { are_all_expected = all; }

  Coordinates() = default;
  explicit Coordinates(std::size_t size, double value = 0.0);
  Coordinates(const double* first, const double* last);
  Coordinates(std::initializer_list<double> values);
  explicit Coordinates(std::span<const double> values);
  Coordinates(const Coordinates& other) : Coordinates(std::span<const double>(other)) {}
  Coordinates(Coordinates&& other) noexcept { swap(other); }
  Coordinates& operator=(const Coordinates& other) {
    return assign(std::span<const double>(other));
  }
  Coordinates& operator=(Coordinates&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Coordinates() = default;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  double* data() { return numbers_.get(); }
  const double* data() const { return numbers_.get(); }
  double* begin() { return data(); }
  double* end() { return data() + size_; }
  const double* begin() const { return data(); }
  const double* end() const { return data() + size_; }
  double& operator[](std::size_t i) { return numbers_[i]; }
  double operator[](std::size_t i) const { return numbers_[i]; }

  Coordinates& assign(std::span<const double> values);
  void assign(std::size_t size, double value);
  /// What is new is zero.
  void resize(std::size_t size);
  void append(std::span<const double> values);
  void swap(Coordinates& other) noexcept;

  /// Sets numbers from `first` to before `last` to zero and gives back whole pages among them.
  void release(std::size_t first, std::size_t last);
  /// Whether all from `first` to before `last` are zero, and not minus zero.
  bool is_zero(std::size_t first, std::size_t last) const;

 private:
  struct Free {
    Free() : room(0) {}
    explicit Free(std::size_t numbers) : room(numbers) {}
    std::size_t room;
    void operator()(double* numbers) const;
  };
  using Memory = std::unique_ptr<double[], Free>;
  static Memory make(std::size_t room);

  inline static bool are_all_expected = false;

  Memory numbers_;
  std::size_t size_ = 0;
};

/// result_i = action(result_i, source_i, …) where result or a source holds anything, by page; what
/// an action makes of zeros must be zero. @pre all are as long as the result
template <class Action, class... Sources>
void combine(Coordinates& result, Action action, const Sources&... sources) {
  for (std::size_t first = 0; first < result.size(); first += Coordinates::page) {
    const std::size_t last = std::min(first + Coordinates::page, result.size());
    if (result.is_zero(first, last) && (sources.is_zero(first, last) && ...)) continue;
    for (std::size_t i = first; i < last; ++i) result[i] = action(result[i], sources[i]...);
  }
}

}  // namespace culm::model
