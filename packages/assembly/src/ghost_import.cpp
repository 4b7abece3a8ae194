#include <culm/assembly/ghost_import.hpp>
#include <culm/assembly/tpetra.hpp>
#include <culm/base/error.hpp>

namespace culm::assembly {
namespace {

Rows others_of(const Rows& rows, const Rows& columns) {
  internal_check(begin_with_rows(rows, columns), "columns of a rank begin with its rows");
  const auto all = tpetra(columns)->getNodeElementList();
  const auto own = static_cast<Teuchos::ArrayView<const GlobalIndex>::size_type>(rows.size());
  const auto sum = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return rows_of(
      Teuchos::rcp(new Map(sum, all.view(own, all.size() - own), 0, tpetra(rows)->getComm())));
}

}  // namespace

struct GhostImport::Stored {
  Import import;
};

GhostImport::GhostImport(const Rows& rows, const Rows& columns)
    : others_(others_of(rows, columns)),
      stored_(std::make_unique<Stored>(Import(tpetra(rows), tpetra(others_.rows())))) {}

GhostImport::~GhostImport() = default;

ColumnValues GhostImport::operator()(const Vector& vector) {
  tpetra(others_).doImport(tpetra(vector), stored_->import, Tpetra::INSERT);
  return {vector.values(), others_.values()};
}

bool begin_with_rows(const Rows& rows, const Rows& columns) {
  if (columns.size() < rows.size()) return false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows.global(i) != columns.global(i)) return false;
  }
  return true;
}

}  // namespace culm::assembly
