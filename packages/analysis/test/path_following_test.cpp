#include <culm/analysis/path_following.hpp>
#include <culm/base/error.hpp>
#include <culm/mechanics/linear_law.hpp>
#include <culm/model/element_batch.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>

namespace culm::analysis {
namespace {

// A bar with the Green strain of its length.
class Bar {
 public:
  static constexpr NodeKind node_kind = NodeKind::node12;
  static constexpr int num_nodes = 2;
  static constexpr int num_slots = 8;
  static constexpr int num_points = 1;
  static constexpr int num_strains = 1;
  static constexpr int num_resultants = 1;
  using Nodes = Slots<num_slots>;
  using Strain = Eigen::Matrix<double, 1, 1>;

  Bar(const Nodes& reference, double stiffness)
      : length_((reference.col(4) - reference.col(0)).norm()) {
    law_.C(0, 0) = stiffness * length_;
  }
  void strain(int, const Nodes& q, Strain& y) const noexcept {
    y[0] = 0.5 * ((q.col(4) - q.col(0)).squaredNorm() / (length_ * length_) - 1.0);
  }
  void gradient(int, const Nodes& q, Gradient<8, 1>& B) const noexcept {
    B.setZero();
    const Vec3 chord = (q.col(4) - q.col(0)) / (length_ * length_);
    B.block<3, 1>(0, 0) = -chord;
    B.block<3, 1>(12, 0) = chord;
  }
  void add_curvature(int, const Strain& S, SlotMatrix<8>& A) const noexcept {
    const double s = S[0] / (length_ * length_);
    A(0, 0) += s;
    A(4, 4) += s;
    A(0, 4) -= s;
    A(4, 0) -= s;
  }
  Verdict respond(int, const Strain& prev, const Strain& next, const Stencil& stencil,
                  Response<1>& response) const noexcept {
    law_.respond(prev, next, stencil, response);
    return Verdict::ok;
  }
  double energy(int, const Strain& y) const noexcept { return law_.energy(y); }
  SlotMatrix<8> mass() const noexcept { return SlotMatrix<8>::Identity(); }
  Strain resultants(int, const Strain& y) const noexcept { return law_.C * y; }
  static constexpr std::array<const char*, 1> resultant_names() { return {"N"}; }

 private:
  double length_;
  LinearLaw<1> law_;
};

// Energy y^2 / 2 of y = -sin of the angle by which the second of two nodes turns about x.
class Twist {
 public:
  static constexpr NodeKind node_kind = NodeKind::node12;
  static constexpr int num_nodes = 2;
  static constexpr int num_slots = 8;
  static constexpr int num_points = 1;
  static constexpr int num_strains = 1;
  static constexpr int num_resultants = 1;
  using Nodes = Slots<num_slots>;
  using Strain = Eigen::Matrix<double, 1, 1>;

  Twist() { law_.C(0, 0) = 1.0; }
  void strain(int, const Nodes& q, Strain& y) const noexcept { y[0] = q.col(2).dot(q.col(7)); }
  void gradient(int, const Nodes& q, Gradient<8, 1>& B) const noexcept {
    B.setZero();
    B.block<3, 1>(6, 0) = q.col(7);
    B.block<3, 1>(21, 0) = q.col(2);
  }
  void add_curvature(int, const Strain& S, SlotMatrix<8>& A) const noexcept {
    A(2, 7) += S[0];
    A(7, 2) += S[0];
  }
  Verdict respond(int, const Strain& prev, const Strain& next, const Stencil& stencil,
                  Response<1>& response) const noexcept {
    law_.respond(prev, next, stencil, response);
    return Verdict::ok;
  }
  double energy(int, const Strain& y) const noexcept { return law_.energy(y); }
  SlotMatrix<8> mass() const noexcept { return SlotMatrix<8>::Identity(); }
  Strain resultants(int, const Strain& y) const noexcept { return law_.C * y; }
  static constexpr std::array<const char*, 1> resultant_names() { return {"T"}; }

 private:
  LinearLaw<1> law_;
};

// A dead force, or a moment, that is the level times a vector.
class Push final : public model::Batch {
 public:
  Push(int node, const Vec3& force, const Vec3& moment = Vec3::Zero()) : node_(node) {
    load_ << force, moment;
  }
  const model::Effect& effect() const override { return effect_; }
  int size() const override { return 1; }
  std::vector<int> blocks(int, const model::UnknownTable& unknowns) const override {
    return {unknowns.node_block(node_)};
  }
  bool has_tangent() const override { return false; }
  void place(model::Placement placement, model::Form) override {
    placement_ = std::move(placement);
  }
  void prepare(const model::State& state, const Stencil&) override { level_ = state.time; }
  Verdict assemble(const model::State&, const Stencil&, Want, model::Target& target) override {
    const Vec6 values = -level_ * load_;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      placement_.scatter.add_residual(i, 0, values.data(), target);
    }
    target.force_scale = std::max(target.force_scale, values.lpNorm<Eigen::Infinity>());
    return Verdict::ok;
  }
  void extrapolate(const model::State&, const Stencil&, const model::Coordinates&) override {}
  double stored_energy(const model::Coordinates&) const override { return 0.0; }
  model::StepWork step_work(const model::State&, const Stencil&) const override { return {}; }

 private:
  model::Effect effect_{"Push"};
  int node_;
  Vec6 load_;
  model::Placement placement_;
  double level_ = 0.0;
};

// A node as a structure of its own: 'a', 'b', …; `fixed` reads from the last unknown to the first.
int add_node(model::Model& model, const Vec3& x, const char* fixed) {
  model::NodeSlots slots;
  slots << x, Mat3::Identity();
  const int node = model.nodes().add(slots);
  model.add_structure(std::string(1, static_cast<char>('a' + node))).nodes = {node};
  model.nodes().fix(node, std::bitset<6>(fixed));
  return node;
}

// Two bars with EA = 1 from (-a, 0) and (a, 0) to an apex at (0, h), which a unit load pushes down:
//   P = (h^2 - w^2) w / L^3 at the height w of the apex, L^2 = a^2 + h^2.
// Where w^2 = h^2 - 2 a^2 another path begins, x^2 + w^2 = h^2 - 2 a^2 and P = 2 a^2 w / L^3.
class Truss : public Observer {
 public:
  Truss(double a, double h, const Vec3& force = Vec3(0.0, -1.0, 0.0)) : a_(a), h_(h) {
    const auto add = [&](const Vec3& x, const char* fixed) { return add_node(model, x, fixed); };
    const int left = add({-a, 0.0, 0.0}, "111111"), right = add({a, 0.0, 0.0}, "111111");
    apex_ = add({0.0, h, 0.0}, "111100");
    auto& bars = model::elements<Bar>(model, "Bar");
    for (const int foot : {left, right}) {
      Slots<8> reference;
      reference << model::NodeTable::slots(model.nodes().reference(), foot),
          model::NodeTable::slots(model.nodes().reference(), apex_);
      bars.add(Bar(reference, 1.0), {foot, apex_});
    }
    model.add_load(std::make_unique<Push>(apex_, force));
    model.freeze(model::Form::null_space);
    system = std::make_unique<assembly::System>(model, comm, ledger);
    linear = solver::make_rooted_klu2(system->matrix(), comm);
    state = model.initial_state();
    settings.first_increment = 0.01;
    settings.watch = WatchSettings{{}, "c/0", Vec3(0.0, -1.0, 0.0)};
    settings.steps = 100;
  }

  double length() const { return std::sqrt(a_ * a_ + h_ * h_); }
  double load_at(double w) const { return (h_ * h_ - w * w) * w / std::pow(length(), 3); }

  AnalysisReport follow() {
    Context context{*system, *linear, ledger, log, findings};
    PathFollowing path(settings, context, state);
    path.begin();
    return run(path, *this);
  }

  void step(const StepReport& report, model::State& now) override {
    if (!report.accepted) return;
    system->synchronise(now);
    points.push_back(model::NodeTable::slots(now.next, apex_).col(0));
    levels.push_back(now.time);
  }

  parallel::Comm comm;
  Ledger ledger;
  std::ostringstream said;
  Log log{said, LogLevel::info};
  Findings findings{log};
  model::Model model;
  std::unique_ptr<assembly::System> system;
  std::unique_ptr<solver::LinearSolver> linear;
  model::State state;
  PathSettings settings;
  std::vector<Vec3> points;  // of the apex
  std::vector<double> levels;

 private:
  double a_, h_;
  int apex_ = -1;
};

double number(const AnalysisReport& report, const std::string& name) {
  for (const auto& [key, value] : report.numbers) {
    if (key == name) return value;
  }
  ADD_FAILURE() << "no " << name << " in\n" << report.text;
  return 0.0;
}

class EachControl : public testing::TestWithParam<PathControl> {};
INSTANTIATE_TEST_SUITE_P(PathFollowing, EachControl,
                         testing::Values(PathControl::linearised_sphere, PathControl::normal_plane,
                                         PathControl::sphere, PathControl::displacement));

TEST_P(EachControl, TracesTheClosedForm) {
  Truss truss(1.0, 0.5);
  truss.settings.control = GetParam();
  truss.settings.final_level = 0.3;
  truss.settings.largest_length = 5.0;
  const AnalysisReport report = truss.follow();
  ASSERT_EQ(truss.levels.back(), 0.3);
  ASSERT_GT(truss.points.size(), 10U);
  double height = 0.5;
  for (std::size_t i = 0; i < truss.points.size(); ++i) {
    const double w = truss.points[i][1];
    EXPECT_LT(w, height) << "the path turned back";
    height = w;
    EXPECT_NEAR(truss.levels[i], truss.load_at(w), 1e-10);
    EXPECT_NEAR(truss.points[i][0], 0.0, 1e-12);
  }
  // by interpolation, with an error of the fourth order of the step
  const double w = 0.5 / std::sqrt(3.0);
  EXPECT_NEAR(number(report, "limit point 1, level"), truss.load_at(w), 1e-3 * truss.load_at(w));
  EXPECT_NEAR(number(report, "limit point 2, level"), -truss.load_at(w), 1e-3 * truss.load_at(w));
  EXPECT_NEAR(number(report, "limit point 1, displacement"), 0.5 - w, 5e-3);
  EXPECT_EQ(report.text.find("bifurcation"), std::string::npos);
}

TEST(PathFollowing, InterpolationOfLimitPointsIsOfHighOrder) {
  const auto error = [](double largest) {
    Truss truss(1.0, 0.5);
    truss.settings.first_increment = 0.001;
    truss.settings.largest_length = largest;
    truss.settings.steps = 1000;
    truss.settings.limit_points = 1;
    const double exact = truss.load_at(0.5 / std::sqrt(3.0));
    return std::abs(number(truss.follow(), "limit point 1, level") - exact) / exact;
  };
  EXPECT_LT(error(4.0), error(8.0) / 4.0 + 1e-10);
}

TEST(PathFollowing, EndsAfterALimitPointAndAtADisplacement) {
  Truss truss(1.0, 0.5);
  truss.settings.limit_points = 1;
  truss.follow();
  EXPECT_LT(truss.points.back()[1], 0.5 / std::sqrt(3.0));
  EXPECT_GT(truss.points.back()[1], 0.0);

  Truss other(1.0, 0.5);
  other.settings.final_displacement = 0.7;
  other.follow();
  EXPECT_NEAR(other.points.back()[1], -0.2, 1e-10);
}

TEST(PathFollowing, FindsABifurcationAndFollowsIt) {
  Truss truss(1.0, 2.0);
  truss.settings.final_level = -0.05;
  const double w = std::sqrt(2.0);
  const double level = 2.0 * w / std::pow(truss.length(), 3);
  truss.settings.largest_length = 2.0;
  EXPECT_NEAR(number(truss.follow(), "bifurcation 1, level"), level, 1e-3 * level);
  for (const Vec3& x : truss.points) EXPECT_NEAR(x[0], 0.0, 1e-9);

  Truss stopped(1.0, 2.0);
  stopped.settings.at_bifurcation = AtBifurcation::stop;
  stopped.follow();
  EXPECT_NEAR(stopped.points.back()[1], w, 0.3);

  Truss branch(1.0, 2.0);
  branch.settings.at_bifurcation = AtBifurcation::follow;
  branch.settings.final_displacement = 1.5;
  branch.follow();
  const Vec3 end = branch.points.back();
  EXPECT_NEAR(end[1], 0.5, 1e-9);
  EXPECT_NEAR(end.squaredNorm(), 2.0, 1e-9);
  EXPECT_NEAR(branch.levels.back(), 2.0 * end[1] / std::pow(branch.length(), 3), 1e-10);
}

// A small truss pushed through a long bar that is far softer: at a limit point of the truss the bar
// springs back, and the path turns by nearly 180 degrees within a small share of the first step.
class SoftlyPushedTruss : public Observer {
 public:
  static constexpr double size = 1e-3;     // of the truss
  static constexpr double softness = 1e3;  // of the bar, over that of the truss

  SoftlyPushedTruss() {
    const auto add = [&](const Vec3& x, const char* fixed) { return add_node(model, x, fixed); };
    const int left = add({-size, 0.0, 0.0}, "111111"), right = add({size, 0.0, 0.0}, "111111");
    const int apex = add({0.0, 0.5 * size, 0.0}, "111101");
    const int pushed = add({0.0, 0.5 * size + length, 0.0}, "111101");
    auto& bars = model::elements<Bar>(model, "Bar");
    const auto join = [&](int from, int to, double stiffness) {
      Slots<8> reference;
      reference << model::NodeTable::slots(model.nodes().reference(), from),
          model::NodeTable::slots(model.nodes().reference(), to);
      bars.add(Bar(reference, stiffness), {from, to});
    };
    join(left, apex, 1.0);
    join(right, apex, 1.0);
    join(apex, pushed, length / (softness * size));
    model.add_load(std::make_unique<Push>(pushed, Vec3(0.0, -1.0, 0.0)));
    model.freeze(model::Form::null_space);
  }

  AnalysisReport follow(const PathSettings& settings) {
    assembly::System system(model, comm, ledger);
    const auto linear = solver::make_rooted_klu2(system.matrix(), comm);
    model::State state = model.initial_state();
    Context context{system, *linear, ledger, log, findings};
    PathFollowing path(settings, context, state);
    path.begin();
    return run(path, *this);
  }

  void step(const StepReport& report, model::State& now) override {
    if (!report.accepted) return;
    heights.push_back(model::NodeTable::slots(now.next, 2)(1, 0) / size);
    levels.push_back(now.time);
  }

  std::vector<double> heights;  // of the apex, over the size
  std::vector<double> levels;

 private:
  static constexpr double length = 10.0;
  parallel::Comm comm;
  Ledger ledger;
  std::ostringstream said;
  Log log{said, LogLevel::info};
  Findings findings{log};
  model::Model model;
};

TEST(PathFollowing, TurnsBackSharplyWhereASmallPartUnloadsALargeOne) {
  SoftlyPushedTruss truss;
  PathSettings settings;
  settings.first_increment = 0.05;
  settings.limit_points = 2;
  settings.steps = 1000;
  const AnalysisReport report = truss.follow(settings);
  const double w = 0.5 / std::sqrt(3.0);
  const double limit = (0.25 - w * w) * w / std::pow(1.25, 1.5);
  EXPECT_NEAR(number(report, "limit point 1, level"), limit, 1e-3 * limit);
  EXPECT_NEAR(number(report, "limit point 2, level"), -limit, 1e-3 * limit);
  for (std::size_t i = 0; i < truss.heights.size(); ++i) {
    const double h = truss.heights[i];
    EXPECT_NEAR(truss.levels[i], (0.25 - h * h) * h / std::pow(1.25, 1.5), 1e-8);
  }
}

TEST(PathFollowing, TellsWhatMovesWhereThePathEnds) {
  SoftlyPushedTruss truss;
  PathSettings settings;
  settings.first_increment = 0.05;
  settings.smallest_length = 0.1;
  try {
    truss.follow(settings);
    FAIL() << "no step is short enough";
  } catch (const NumericalError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("bends more sharply"), std::string::npos) << text;
    EXPECT_NE(text.find("c/0, y"), std::string::npos) << text;
    EXPECT_EQ(text.find("d/0, x"), std::string::npos) << text;
  }
}

TEST(PathFollowing, SaysWhereStepsEndedThePathBeforeItsTarget) {
  Truss truss(1.0, 0.5);
  truss.settings.steps = 3;
  truss.settings.final_displacement = 1.0;
  truss.settings.limit_points = 1;
  truss.follow();
  ASSERT_EQ(truss.findings.all().size(), 1u);
  const Finding& finding = truss.findings.all().front();
  EXPECT_EQ(finding.grade, Finding::Grade::broken);
  EXPECT_EQ(finding.kind, "path");
  EXPECT_EQ(finding.time, truss.levels.back());
  EXPECT_NE(finding.text.find("after 3 steps"), std::string::npos) << finding.text;
  EXPECT_NE(finding.text.find("displacement 1 m of 'c/0' or limit point 1"), std::string::npos)
      << finding.text;
}

TEST(PathFollowing, HasNothingToSayWhereItArrivesOrStepsAreItsOnlyEnd) {
  Truss arrives(1.0, 0.5);
  arrives.settings.limit_points = 1;
  arrives.follow();
  EXPECT_TRUE(arrives.findings.all().empty());
  Truss counts(1.0, 0.5);
  counts.settings.steps = 3;
  counts.follow();
  EXPECT_TRUE(counts.findings.all().empty());
}

// A shaft under a unit moment, of which no point moves: its moment is sin(2 phi) / 2.
class Shaft : public Observer {
 public:
  Shaft() {
    const int held = add_node(model, Vec3::Zero(), "111111");
    end_ = add_node(model, Vec3::UnitX(), "110111");
    model::elements<Twist>(model, "Twist").add(Twist(), {held, end_});
    model.add_load(std::make_unique<Push>(end_, Vec3::Zero(), Vec3::UnitX()));
    model.freeze(model::Form::null_space);
    system.emplace(model, comm, ledger);
    settings.first_increment = 0.05;
    settings.limit_points = 1;
    settings.watch = WatchSettings{{}, "b/0", Vec3::UnitY()};
  }

  AnalysisReport follow() {
    const auto linear = solver::make_rooted_klu2(system->matrix(), comm);
    model::State state = model.initial_state();
    Findings findings(log);
    Context context{*system, *linear, ledger, log, findings};
    PathFollowing path(settings, context, state);
    path.begin();
    return run(path, *this);
  }

  void step(const StepReport& report, model::State& now) override {
    if (!report.accepted) return;
    system->synchronise(now);  // on other ranks too
    const auto d = model::NodeTable::slots(now.next, end_);
    angles.push_back(std::atan2(d(2, 2), d(1, 2)));
    levels.push_back(now.time);
  }

  PathSettings settings;
  std::vector<double> angles, levels;

 private:
  parallel::Comm comm;
  Ledger ledger;
  std::ostringstream said;
  Log log{said, LogLevel::info};
  model::Model model;
  std::optional<assembly::System> system;
  int end_ = -1;
};

TEST_P(EachControl, FollowsPureTorsionThroughItsLimitPoint) {
  Shaft shaft;
  shaft.settings.control = GetParam();
  if (GetParam() == PathControl::displacement) {
    EXPECT_THROW(shaft.follow(), NumericalError);  // nothing moves that could be prescribed
    return;
  }
  const AnalysisReport report = shaft.follow();
  EXPECT_NEAR(number(report, "limit point 1, level"), 0.5, 5e-4);
  EXPECT_EQ(report.text.find("turning point"), std::string::npos) << report.text;
  EXPECT_GT(shaft.angles.back(), 0.25 * std::numbers::pi);
  for (std::size_t i = 0; i < shaft.angles.size(); ++i) {
    EXPECT_NEAR(shaft.levels[i], 0.5 * std::sin(2.0 * shaft.angles[i]), 1e-10);
    EXPECT_GT(shaft.angles[i], i > 0 ? shaft.angles[i - 1] : 0.0) << "the path turned back";
  }
}

TEST(PathFollowing, RefusesAPathOnWhichNothingChanges) {
  Truss truss(1.0, 0.5, Vec3::Zero());
  EXPECT_THROW(truss.follow(), NumericalError);
}

}  // namespace
}  // namespace culm::analysis
