#include "command.hpp"

namespace culm::app {

void replay(const parallel::Comm& comm, ReplayArguments& arguments) {
  run(comm, arguments, arguments.record);
}

}  // namespace culm::app
