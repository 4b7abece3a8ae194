#include "serial_matrix.hpp"

#include <Teuchos_DefaultSerialComm.hpp>

namespace culm::solver {
namespace {

// Tpetra copies what it is given.
template <class T>
Teuchos::ArrayRCP<T> view(std::span<const T> values) {
  using Size = typename Teuchos::ArrayRCP<T>::size_type;
  return {const_cast<T*>(values.data()), 0, static_cast<Size>(values.size()), false};
}

}  // namespace

Teuchos::RCP<assembly::CrsMatrix> make_serial_matrix(std::span<const std::size_t> begin,
                                                     std::span<const int> columns) {
  using assembly::CrsGraph;
  using assembly::CrsMatrix;
  using assembly::Map;
  const auto self = Teuchos::rcp(new Teuchos::SerialComm<int>());
  const auto rows = static_cast<Tpetra::global_size_t>(begin.size() - 1);
  const auto map = Teuchos::rcp(new Map(rows, 0, self));
  const auto graph = Teuchos::rcp(new CrsGraph(map, map, view(begin), view(columns)));
  graph->expertStaticFillComplete(map, map);
  const auto matrix = Teuchos::rcp(new CrsMatrix(graph));
  matrix->fillComplete(map, map);
  return matrix;
}

}  // namespace culm::solver
