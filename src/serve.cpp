#include "command.hpp"

namespace culm::app {

void serve(const parallel::Comm& comm, ServeArguments& arguments) {
  run(comm, arguments, {}, {arguments.address, arguments.port, arguments.patience});
}

}  // namespace culm::app
