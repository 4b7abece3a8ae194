#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>

namespace culm {

/// Numbers of up to four nodes, in place.
class CellNodes {
 public:
  CellNodes() = default;
  CellNodes(std::initializer_list<int> nodes) : CellNodes(nodes.begin(), nodes.end()) {}
  template <std::input_iterator Iterator>
  CellNodes(Iterator first, Iterator last) {
    for (; first != last; ++first) push_back(*first);
  }
  /// Throws std::out_of_range if there are four.
  void push_back(int node) { nodes_.at(size_++) = node; }

  std::size_t size() const { return size_; }
  int operator[](std::size_t a) const { return nodes_[a]; }
  int front() const { return nodes_.front(); }
  int back() const { return nodes_[size_ - 1U]; }
  const int* data() const { return nodes_.data(); }
  const int* begin() const { return data(); }
  const int* end() const { return data() + size_; }
  int* begin() { return nodes_.data(); }
  int* end() { return nodes_.data() + size_; }

 private:
  std::array<int, 4> nodes_{};
  std::uint8_t size_ = 0;
};

}  // namespace culm
