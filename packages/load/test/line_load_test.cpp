#include <culm/load/register_load.hpp>
#include <culm/math/lagrange.hpp>
#include <culm/math/quadrature.hpp>

#include "../src/line_table.hpp"

#include <culm_kit/deck_list.hpp>
#include <culm_kit/load_contract.hpp>
#include <culm_kit/temporary_folder.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace culm::load {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Numbers = std::vector<double>;

constexpr double round_off_of_sums = 1e-13;
const Vec3 force(1.3, -2.1, 0.7);
const Vec3 moment(0.4, 0.9, -1.1);

Numbers numbers_of(const std::vector<Vec3>& vectors) {
  Numbers numbers;
  for (const Vec3& v : vectors) numbers.insert(numbers.end(), v.begin(), v.end());
  return numbers;
}

/// An element of the order with Gauss points as those of a beam, its nodes from `first` on.
template <int Order>
std::vector<model::LinePoint> element(int first, double length) {
  std::vector<model::LinePoint> points;
  for (const auto& [xi, weight] : gauss_legendre(Order + 1)) {
    model::LinePoint point;
    for (int a = 0; a <= Order; ++a) point.marker.nodes.push_back(first + a);
    const auto N = Lagrange<Order>::values(xi);
    point.marker.weights.assign(N.begin(), N.end());
    point.length = 0.5 * weight * length;
    points.push_back(point);
  }
  return points;
}

/// Three elements of order 2, of 1, 3 and 2 m.
std::vector<model::LinePoint> line_of_three() {
  std::vector<model::LinePoint> line = element<2>(0, 1.0);
  for (const auto& next : {element<2>(2, 3.0), element<2>(4, 2.0)}) {
    line.insert(line.end(), next.begin(), next.end());
  }
  return line;
}
constexpr double length = 6.0;

/// Starts within the first element, kinks and jumps within the second and ends within the third.
LineTable rough_table() {
  kit::Random random(4);
  LineTable table{{0.3, 1.7, 1.9, 2.8, 2.8, 5.5}, {}};
  for (std::size_t i = 0; i < table.positions.size(); ++i) {
    table.values.push_back(random.matrix<6, 1>());
  }
  return table;
}

/// int f(s) g(s) ds over the table between two places, in many steps with a kink at none of them.
template <class Function>
Vec6 integral(const LineTable& table, double from, double to, Function g) {
  Vec6 sum = Vec6::Zero();
  for (std::size_t i = 0; i + 1 < table.positions.size(); ++i) {
    const double a = std::max(from, table.positions[i]);
    const double b = std::min(to, table.positions[i + 1]);
    if (b <= a) continue;
    for (const auto& [xi, weight] : gauss_legendre(6)) {
      const double s = a + 0.5 * (1.0 + xi) * (b - a);
      const double t = (s - table.positions[i]) / (table.positions[i + 1] - table.positions[i]);
      sum +=
          0.5 * weight * (b - a) * g(s) * ((1.0 - t) * table.values[i] + t * table.values[i + 1]);
    }
  }
  return sum;
}

TEST(LineTable, WorksOnShapeFunctionsExactlyWhereverItKinks) {
  const auto line = line_of_three();
  const LineTable table = rough_table();
  const std::vector<Vec6> f = intensities(table, line);
  const double ends[] = {0.0, 1.0, 4.0, 6.0};
  for (std::size_t e = 0; e < 3; ++e) {
    for (int a = 0; a < 3; ++a) {
      Vec6 work = Vec6::Zero();
      for (std::size_t k = 3 * e; k < 3 * e + 3; ++k) {
        work += line[k].length * line[k].marker.weights[static_cast<std::size_t>(a)] * f[k];
      }
      const Vec6 exact = integral(table, ends[e], ends[e + 1], [&](double s) {
        return Lagrange<2>::values(2.0 * (s - ends[e]) / (ends[e + 1] - ends[e]) - 1.0)[a];
      });
      EXPECT_LT((work - exact).norm(), round_off_of_sums) << "element " << e << ", node " << a;
    }
  }
}

// The middle node of an element of 1 m stands at 0.35 m.
TEST(LineTable, SumsToItsIntegralsWhereNodesAreUneven) {
  const double nodes[] = {0.0, 0.35, 1.0};
  const auto place = [&](const auto& N) {
    return N[0] * nodes[0] + N[1] * nodes[1] + N[2] * nodes[2];
  };
  std::vector<model::LinePoint> line = element<2>(0, 1.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& [xi, weight] = gauss_legendre(3)[k];
    line[k].length = weight * place(Lagrange<2>::derivatives(xi));
  }
  const LineTable table{{0.1, 0.7, 0.7, 1.0},
                        {Vec6::Ones(), 3.0 * Vec6::Ones(), Vec6::Zero(), 2.0 * Vec6::Ones()}};
  const std::vector<Vec6> f = intensities(table, line);
  Vec6 force = Vec6::Zero();
  Vec6 moment = Vec6::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    force += line[k].length * f[k];
    moment += place(line[k].marker.weights) * line[k].length * f[k];
  }
  EXPECT_LT((force - integral(table, 0.0, 1.0, [](double) { return 1.0; })).norm(), 1e-13);
  EXPECT_LT((moment - integral(table, 0.0, 1.0, [](double s) { return s; })).norm(), 1e-13);
}

TEST(LineTable, IsTakenAtThePointsWhereItIsLinear) {
  const auto line = line_of_three();
  const Vec6 slope = kit::Random(5).matrix<6, 1>();
  const std::vector<Vec6> f = intensities({{0.0, length}, {Vec6::Zero(), length * slope}}, line);
  const double begin[] = {0.0, 1.0, 4.0};
  const double size[] = {1.0, 3.0, 2.0};
  for (std::size_t k = 0; k < line.size(); ++k) {
    const double s = begin[k / 3] + 0.5 * size[k / 3] * (1.0 + gauss_legendre(3)[k % 3].xi);
    EXPECT_LT((f[k] - s * slope).norm(), round_off_of_sums);
  }
}

TEST(LineTable, AnElementThatASetListsTwiceCountsTwice) {
  std::vector<model::LinePoint> line = element<1>(0, 2.0);
  const auto again = line;
  line.insert(line.end(), again.begin(), again.end());
  const std::vector<Vec6> f = intensities(
      {{0.0, 2.0, 2.0, 4.0}, {Vec6::Zero(), Vec6::Zero(), Vec6::Ones(), Vec6::Ones()}}, line);
  EXPECT_LT(f[0].norm() + f[1].norm(), round_off_of_sums);
  EXPECT_LT((f[2] - Vec6::Ones()).norm() + (f[3] - Vec6::Ones()).norm(), round_off_of_sums);
}

/// A line of three elements on seven nodes, and an edge of shell nodes.
class LineLoads : public testing::Test {
 protected:
  model::BuilderRegistry registry;
  model::Model model;
  std::map<std::string, model::Amplitude> functions;
  InputIssues issues;
  static constexpr int nodes = 7;

  LineLoads() {
    register_loads(registry);
    model::Structure& line = model.add_structure("line");
    for (int seed = 0; seed < nodes; ++seed) {
      line.nodes.push_back(model.nodes().add(kit::random_node(seed)));
    }
    for (const model::LinePoint& point : line_of_three()) line.line_points.push_back(point);
    model::Structure& sheet = model.add_structure("sheet");
    for (int i = 0; i < 2; ++i) {
      model::NodeSlots slots = model::NodeSlots::Zero();
      slots(0, 0) = i;
      slots(2, 1) = 1.0;
      sheet.nodes.push_back(model.nodes().add(slots, NodeKind::node6));
    }
    sheet.edges["u0"] = element<1>(nodes, 1.0);
  }

  Options read(const std::string& type, kit::GivenValues values) const {
    return kit::deck_list(registry.variants().at(type), values, "push");
  }
  void build(const std::string& type, const Options& options) {
    EXPECT_THAT(kit::mistakes_in(registry.variants().at(type), options), IsEmpty());
    model::BuildContext context{model, functions, issues};
    registry.make(type, options, context);
  }
  void build(const std::string& type, kit::GivenValues values) {
    build(type, read(type, std::move(values)));
  }
  std::vector<std::string> messages() const {
    std::vector<std::string> result;
    for (const InputIssue& issue : issues.sorted()) result.push_back(issue.message);
    return result;
  }
  std::vector<std::string> schema_mistakes(kit::GivenValues values) const {
    values.emplace_back("Structure", std::string("line"));
    return kit::mistakes_in(registry.variants().at("Line Load"),
                            read("Line Load", std::move(values)));
  }

  model::Coordinates moved() const {
    model::Coordinates q;
    for (int seed = 30; seed < 30 + nodes; ++seed) {
      const model::NodeSlots slots = kit::random_node(seed);
      q.append({slots.data(), static_cast<std::size_t>(slots.size())});
    }
    const auto sheet = model.nodes().reference().begin() + 12 * nodes;
    q.append({sheet, model.nodes().reference().end()});
    return q;
  }
  std::vector<model::Batch*> loads() const {
    std::vector<model::Batch*> loads;
    for (const auto& load : model.loads()) loads.push_back(load.get());
    return loads;
  }
  /// External forces on all slots of the line in that state, at time 1.
  Eigen::VectorXd slot_forces(const std::vector<model::Batch*>& loads) {
    kit::DenseAssembly dense(model);
    model::State state = model.initial_state();
    state.time = 1.0;
    state.prev = state.next = moved();
    return -dense.residual(state, Stencil::statics(), loads).head(12 * nodes);
  }
  /// The forces of the first `count` batches, and of those after them.
  std::pair<Eigen::VectorXd, Eigen::VectorXd> split_forces(std::size_t count) {
    model.freeze(model::Form::multipliers);
    const std::vector<model::Batch*> all = loads();
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(count);
    return {slot_forces({all.begin(), middle}), slot_forces({middle, all.end()})};
  }
  /// Uniform loads, by a table and without one.
  void expect_uniform(const std::string& frame, const kit::GivenValues& turning) {
    kit::GivenValues common = turning;
    common.emplace_back("Structure", std::string("line"));
    kit::GivenValues table = common;
    table.insert(table.end(), {{"Offset", Numbers{0.2, 0.1, -0.4}},
                               {"Positions", Numbers{0.0, 1.0}},
                               {"Forces", numbers_of({force, force})},
                               {"Moments", numbers_of({moment, moment})}});
    build(frame + "Line Load", table);
    kit::GivenValues forces = common;
    forces.insert(forces.end(),
                  {{"Offset", Numbers{0.2, 0.1, -0.4}}, {"Force", numbers_of({force})}});
    build(frame + "Line Force", forces);
    common.emplace_back("Moment", numbers_of({moment}));
    build(frame + "Line Moment", common);
    const auto [by_table, by_two] = split_forces(2);
    EXPECT_GT(by_two.norm(), 1.0);
    EXPECT_LT((by_table - by_two).norm(), round_off_of_sums * by_two.norm());
  }
};

TEST_F(LineLoads, UniformOnesAreLineForceAndLineMoment) { expect_uniform("", {}); }

TEST_F(LineLoads, UniformFollowersAreFollowerLineForceAndMoment) {
  expect_uniform("Follower ", {});
}

TEST_F(LineLoads, FollowersThatDoNotTurnAreThoseWithoutTable) {
  expect_uniform("Follower ", {{"Turning", false}});
}

TEST_F(LineLoads, ResultantIsTheIntegralOfTheTable) {
  const LineTable table = rough_table();
  Numbers fractions;
  std::vector<Vec3> forces;
  std::vector<Vec3> moments;
  for (std::size_t i = 0; i < table.positions.size(); ++i) {
    fractions.push_back(table.positions[i] / length);
    forces.emplace_back(table.values[i].head<3>());
    moments.emplace_back(table.values[i].tail<3>());
  }
  build("Line Load", {{"Structure", std::string("line")},
                      {"Positions", fractions},
                      {"Forces", numbers_of(forces)},
                      {"Moments", numbers_of(moments)}});
  const Vec6 exact = integral(table, 0.0, length, [](double) { return 1.0; });
  const Eigen::VectorXd all = split_forces(2).first;
  Vec3 sum = Vec3::Zero();
  for (int node = 0; node < nodes; ++node) sum += all.segment<3>(12 * node);
  EXPECT_LT((sum - exact.head<3>()).norm(), round_off_of_sums);
  model::Coordinates q = moved();
  q.resize(12 * nodes);
  const Vec3 moment_sum = kit::resultant_of(slot_forces({loads().back()}), q).moment;
  EXPECT_LT((moment_sum - exact.tail<3>()).norm(), round_off_of_sums);
}

TEST_F(LineLoads, PartsThatAreZeroHaveNoBatch) {
  const kit::GivenValues place{{"Structure", std::string("line")},
                               {"Positions", Numbers{0.0, 1.0}}};
  kit::GivenValues forces = place;
  forces.emplace_back("Forces", numbers_of({force, force}));
  build("Line Load", forces);
  EXPECT_EQ(model.loads().size(), 1U);
  kit::GivenValues moments = place;
  moments.emplace_back("Moments", numbers_of({moment, moment}));
  build("Line Load", moments);
  ASSERT_EQ(model.loads().size(), 2U);
  EXPECT_EQ(model.loads()[0]->effect().title(), "Line Load, push");
  EXPECT_EQ(model.loads()[1]->effect().title(), "Line Load, push, moments");
}

TEST_F(LineLoads, ElementsBeyondTheTableCarryNothing) {
  build("Line Load", {{"Structure", std::string("line")},
                      {"Position Measure", std::string("Metres")},
                      {"Positions", Numbers{4.5, 6.0}},
                      {"Forces", numbers_of({force, force})}});
  EXPECT_EQ(model.loads().front()->size(), 1);
}

TEST_F(LineLoads, MistakesOfTheListsAreNamed) {
  const Numbers two = numbers_of({force, force});
  EXPECT_THAT(schema_mistakes({{"Forces", two}}),
              ElementsAre("give one of 'Positions' and 'File Name'"));
  EXPECT_THAT(schema_mistakes({{"Positions", Numbers{0.0, 1.0}}}),
              ElementsAre("'Positions' needs 'Forces' or 'Moments', or both"));
  EXPECT_THAT(schema_mistakes({{"File Name", std::string("wind.csv")}, {"Moments", two}}),
              ElementsAre("the values stand in the file of 'File Name'"));
  EXPECT_THAT(schema_mistakes({{"Positions", Numbers{0.0, 0.5, 1.0}}, {"Forces", two}}),
              ElementsAre("must have three components for each of 3 positions, 9 numbers, got 6"));
  const kit::GivenValues line{{"Structure", std::string("line")}, {"Forces", two}};
  const auto with = [&](const Numbers& positions, const char* measure) {
    kit::GivenValues values = line;
    values.insert(values.end(),
                  {{"Positions", positions}, {"Position Measure", std::string(measure)}});
    build("Line Load", values);
  };
  with({0.0, 6.0}, "Fraction");
  with({0.0, 6.1}, "Metres");
  with({0.7, 0.2}, "Fraction");
  EXPECT_THAT(messages(),
              ElementsAre("positions must lie between 0 and 1, as fractions of the length of the "
                          "line, got 6; 'Position Measure' Metres takes lengths",
                          "positions must lie between 0 and the length of the line, 6 m, got 6.1 m",
                          "positions must not descend, got 0.2 after 0.7"));
  EXPECT_THAT(model.loads(), IsEmpty());
}

TEST_F(LineLoads, FollowersOnAShellPullAlongItsDirector) {
  const kit::GivenValues edge{{"Structure", std::string("sheet/u0")},
                              {"Positions", Numbers{0.0, 1.0}}};
  kit::GivenValues forces = edge;
  forces.emplace_back("Forces", numbers_of({Vec3(1.0, 0.0, 0.0), Vec3(2.0, 0.0, 0.1)}));
  build("Follower Line Load", forces);
  kit::GivenValues moments = edge;
  moments.emplace_back("Moments", numbers_of({moment, moment}));
  build("Follower Line Load", moments);
  EXPECT_THAT(messages(),
              ElementsAre("node 'sheet/0' of a shell has one director: only the first component "
                          "may differ from zero",
                          "node 'sheet/0' of a shell has one director, which no moment can follow; "
                          "a Moment fixed in space is possible"));
}

class LineFile : public LineLoads {
 protected:
  kit::TemporaryFolder folder;

  std::string write(const std::string& text) const {
    const std::string path = (folder / "wind.csv").string();
    std::ofstream(path) << text;
    return path;
  }
  void build_file() {
    Options options = read("Line Load", {{"Structure", std::string("line")},
                                         {"Position Measure", std::string("Metres")}});
    options.set("File Name", std::string("wind.csv"), true,
                {(folder / "deck.xml").string(), 7, "Loads / wind / File Name"});
    build("Line Load", options);
  }
};

TEST_F(LineFile, IsTheTableOfTheLists) {
  write(
      "# r, Fx, Fy, Fz, Mx, My, Mz\n0.3, 1, 2, 3, 4, 5, 6\n\n2, 0, 0, 1, 0, 0, 0 # kink\n"
      "6, 1, 1, 1, 1, 1, 1\n");
  build_file();
  build("Line Load", {{"Structure", std::string("line")},
                      {"Positions", Numbers{0.05, 2.0 / 6.0, 1.0}},
                      {"Forces", Numbers{1, 2, 3, 0, 0, 1, 1, 1, 1}},
                      {"Moments", Numbers{4, 5, 6, 0, 0, 0, 1, 1, 1}}});
  const auto [by_file, by_lists] = split_forces(2);
  EXPECT_GT(by_lists.norm(), 1.0);
  EXPECT_LT((by_file - by_lists).norm(), round_off_of_sums * by_lists.norm());
}

TEST_F(LineFile, MistakesNameFileAndLine) {
  const std::string path = write("0, 1, 2\n1, 0, 0, 1\n0.5, 0, 0, 1\n0.2, 0, 0, 1\n");
  build_file();
  const std::vector<InputIssue> found = issues.sorted();
  ASSERT_EQ(found.size(), 2U);  // of positions the first mistake only
  EXPECT_EQ(to_string(found[0]), path +
                                     ":1: must be 'position, Fx, Fy, Fz' or 'position, Fx, Fy, "
                                     "Fz, Mx, My, Mz', got '0, 1, 2'");
  EXPECT_EQ(to_string(found[1]), path + ":3: positions must not descend, got 0.5 after 1");
}

TEST_F(LineFile, OnePositionIsTooFew) {
  const std::string path = write("1, 0, 0, 1\n");
  build_file();
  ASSERT_EQ(issues.size(), 1U);
  EXPECT_EQ(to_string(issues.sorted().front()), path + ": must have at least two positions, got 1");
}

}  // namespace
}  // namespace culm::load
