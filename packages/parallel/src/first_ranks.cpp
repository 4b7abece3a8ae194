#include <culm/base/error.hpp>
#include <culm/parallel/first_ranks.hpp>

#include <string>

namespace culm::parallel {

Comm first_ranks(int count) {
  const Comm launched;
  if (count < 1 || count > launched.size()) {
    throw UsageError(std::to_string(count) + " processes are to work together, and " +
                     std::to_string(launched.size()) + " were started");
  }
  if (count == launched.size()) return launched;
  MPI_Group all = MPI_GROUP_NULL, first = MPI_GROUP_NULL;
  MPI_Comm_group(MPI_COMM_WORLD, &all);
  int range[1][3] = {{0, count - 1, 1}};
  MPI_Group_range_incl(all, 1, range, &first);
  MPI_Comm comm = MPI_COMM_NULL;
  MPI_Comm_create_group(MPI_COMM_WORLD, first, 0, &comm);
  MPI_Group_free(&first);
  MPI_Group_free(&all);
  if (comm == MPI_COMM_NULL) {
    throw UsageError(
        "culm takes the first processes: name it first in the command of the launcher");
  }
  return Comm(comm);
}

}  // namespace culm::parallel
