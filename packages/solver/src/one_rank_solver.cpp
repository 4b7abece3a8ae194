#include "one_rank_solver.hpp"

#include <culm/parallel/shared_failure.hpp>

#include "rooted_matrix.hpp"

#include <array>
#include <span>
#include <vector>

namespace culm::solver {
namespace {

class OneRankSolver final : public LinearSolver {
 public:
  OneRankSolver(const Teuchos::RCP<const assembly::CrsMatrix>& matrix, const MakeSerialSolver& make,
                const parallel::Comm& comm)
      : comm_(comm), rooted_(matrix, comm) {
    on_root([&] { serial_ = make(rooted_.matrix(), parallel::Comm(MPI_COMM_SELF)); });
    name_ = comm_.broadcast(serial_ ? serial_->name() : std::string());
  }

  std::string name() const override { return name_; }

  bool factor() override {
    rooted_.gather_values();
    bool sound = true;
    on_root([&] { sound = serial_->factor(); });
    return comm_.max(sound ? 0 : 1) == 0;
  }

  LinearResidual solve(const Vector& b, Vector& x) override {
    rooted_.gather_rhs(b);
    LinearResidual left;
    on_root([&] { left = serial_->solve(rooted_.rhs(), rooted_.solution()); });
    rooted_.scatter_solution(x);
    std::array<double, 2> numbers = {left.size, left.allowed};
    comm_.broadcast(numbers);
    return {numbers[0], numbers[1]};
  }

  Determinant determinant() override {
    Determinant found;
    on_root([&] { found = serial_->determinant(); });
    constexpr int unknown = -1;
    std::array<double, 3> numbers = {static_cast<double>(found.sign), found.log_size,
                                     static_cast<double>(found.negative.value_or(unknown))};
    comm_.broadcast(numbers);
    found = {static_cast<int>(numbers[0]), numbers[1], static_cast<int>(numbers[2])};
    if (found.negative == unknown) found.negative.reset();
    return found;
  }

  double weakest_direction(Vector& v) override {
    rooted_.gather_values();
    std::array<double, 1> ratio = {0.0};
    on_root([&] { ratio[0] = serial_->weakest_direction(rooted_.solution()); });
    rooted_.scatter_solution(v);
    comm_.broadcast(ratio);
    return ratio[0];
  }

  std::vector<int> pivots() const override {
    return serial_ ? serial_->pivots() : std::vector<int>{};
  }
  void remember_pivots() override {
    if (serial_) serial_->remember_pivots();
  }
  void restore_pivots() override {
    if (serial_) serial_->restore_pivots();
  }
  bool set_pivots(std::span<const int> pivots) override {
    bool fit = true;
    on_root([&] { fit = serial_->set_pivots(pivots); });
    return comm_.max(fit ? 0 : 1) == 0;
  }

  std::string remark() const override { return serial_ ? serial_->remark() : std::string(); }

 private:
  template <class Work>
  void on_root(const Work& work) const {
    parallel::together(comm_, [&] {
      if (comm_.is_root()) work();
    });
  }

  parallel::Comm comm_;
  RootedMatrix rooted_;
  std::unique_ptr<LinearSolver> serial_;  // on the root
  std::string name_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_one_rank_solver(
    const Teuchos::RCP<const assembly::CrsMatrix>& matrix, const MakeSerialSolver& make,
    const parallel::Comm& comm) {
  if (comm.size() == 1) return make(matrix, comm);
  return std::make_unique<OneRankSolver>(matrix, make, comm);
}

}  // namespace culm::solver
