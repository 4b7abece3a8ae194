#include <culm/water/morison_load.hpp>
#include <culm/water/register_water.hpp>

#include "sea_kit.hpp"

#include <culm_kit/dense_assembly.hpp>

#include <numbers>

namespace culm::water {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

// Loads of a deck on one node at the origin, in still water of 50 m.
class MorisonDeck : public testing::Test {
 protected:
  MorisonDeck() {
    register_water_loads(registry_);
    model::NodeSlots slots;
    slots << Vec3::Zero(), Mat3::Identity();
    const int node = model_.nodes().add(slots);
    model::Structure& body = model_.add_structure("body");
    body.nodes = {node};
    body.sets = {{"first", {node}}, {"last", {node}}, {"all", {node}}};
    body.cells.push_back({{node}, nullptr, 0});
  }

  static kit::GivenValues column(const kit::GivenValues& more) {
    kit::GivenValues values = {{"Node", std::string("body")},
                               {"From", std::vector{0.0, 0.0, -20.0}},
                               {"To", std::vector{0.0, 0.0, 10.0}},
                               {"Flow", std::string("sea")}};
    values.insert(values.end(), more.begin(), more.end());
    return values;
  }
  Schema schema() const { return registry_.variants().at("Morison"); }
  std::vector<std::string> mistakes(const kit::GivenValues& more) const {
    return kit::mistakes_in(schema(), kit::deck_list(schema(), column(more), "waves"));
  }
  /// Messages of what is wrong with the model.
  std::vector<std::string> build(const kit::GivenValues& values) {
    InputIssues issues;
    model::BuildContext context{model_, functions_, issues};
    flow::FluidContext fluids(context, {{"sea", test::make_sea("Still Water", {{"Depth", 50.0}})}},
                              1e9);
    registry_.make("Morison", kit::deck_list(schema(), values, "waves"), fluids);
    std::vector<std::string> messages;
    for (const InputIssue& issue : issues.sorted()) messages.push_back(issue.message);
    return messages;
  }
  /// Of the load on the body at rest.
  Vec3 force() {
    model_.freeze(model::Form::multipliers);
    kit::DenseAssembly dense(model_);
    auto* load = dynamic_cast<MorisonLoad*>(model_.loads().back().get());
    const model::State state = model_.initial_state();
    return -dense.residual(state, Stencil::statics(), {load}).head<3>();
  }

  model::Model model_;
  const std::map<std::string, model::Amplitude> functions_{
      {"Constant", model::Amplitude::constant()}};
  flow::FluidLoadRegistry registry_;
};

TEST_F(MorisonDeck, DiametersMayJump) {
  EXPECT_THAT(build(column({{"Positions", std::vector{0.0, 0.4, 0.4, 1.0}},
                            {"Diameters", std::vector{4.0, 4.0, 2.0, 2.0}},
                            {"Segments", 7}})),
              ElementsAre());
  const double volume = std::numbers::pi * (4.0 * 12.0 + 1.0 * 8.0);
  EXPECT_NEAR(force()[2], 1025.0 * 9.81 * volume, 1e-6);
}

TEST_F(MorisonDeck, GrowthWidensAndWeighs) {
  EXPECT_THAT(build(column({{"Diameter", 2.0}, {"Growth", 0.1}, {"Growth Density", 1300.0}})),
              ElementsAre());
  const double area = std::numbers::pi * 1.1 * 1.1, ring = area - std::numbers::pi;
  EXPECT_NEAR(force()[2], 9.81 * (1025.0 * area * 20.0 - 1300.0 * ring * 30.0), 1e-6);
}

TEST_F(MorisonDeck, RangeLimitsIt) {
  EXPECT_THAT(build(column({{"Diameter", 2.0},
                            {"Range", std::vector{0.5, 1.0}},
                            {"Dry Ends", std::vector<std::string>{"first"}}})),
              ElementsAre());
  // from 5 m of depth on, with a dry foot: 5 m of volume less the pressure there
  EXPECT_NEAR(force()[2], 0.0, 1e-7);
}

TEST_F(MorisonDeck, NothingCarriesTheWaterTwice) {
  const auto part = [](double begin, double end) {
    return column({{"Diameter", 2.0}, {"Range", std::vector{begin, end}}});
  };
  EXPECT_THAT(build(part(0.0, 0.5)), ElementsAre());
  EXPECT_THAT(build(part(0.5, 1.0)), ElementsAre());
  EXPECT_THAT(build(part(0.2, 0.3)), ElementsAre(HasSubstr("the water twice")));
  kit::GivenValues beside = column({{"Diameter", 2.0}});
  beside[1].second = std::vector{5.0, 0.0, -20.0};
  EXPECT_THAT(build(beside), ElementsAre());
}

// A range that ends 5 m under water, on a member that goes on to 10 m above it.
TEST_F(MorisonDeck, RangeShouldReachAboveTheWater) {
  EXPECT_THAT(build(column({{"Diameter", 2.0}, {"Range", std::vector{0.0, 0.5}}})), ElementsAre());
  auto* load = dynamic_cast<MorisonLoad*>(model_.loads().back().get());
  force();
  model::State state = model_.initial_state();
  load->accept(state);
  EXPECT_NEAR(load->range_used(), 6.0, 1e-12);
  EXPECT_THAT(load->range_warning(6.0), HasSubstr("5 m above the upper end of 'Range'"));
}

// Where the next load goes on there is no end, and nothing is missing.
TEST_F(MorisonDeck, PartsOfAMemberHaveNoFacesBetweenThem) {
  EXPECT_THAT(build(column({{"Diameter", 2.0}, {"Range", std::vector{0.0, 0.5}}})), ElementsAre());
  auto* lower = dynamic_cast<MorisonLoad*>(model_.loads().back().get());
  EXPECT_THAT(build(column({{"Diameter", 2.0}, {"Range", std::vector{0.5, 1.0}}})), ElementsAre());
  force();
  model::State state = model_.initial_state();
  lower->accept(state);
  EXPECT_LT(lower->range_used(), 1.0);
}

TEST_F(MorisonDeck, MistakesAreNamed) {
  EXPECT_THAT(mistakes({}), Contains(HasSubstr("give one of 'Diameter' and 'Diameters'")));
  EXPECT_THAT(mistakes({{"Diameter", 1.0}, {"Structure", std::string("pile")}}),
              Contains(HasSubstr("give one of 'Structure' and 'Node'")));
  EXPECT_THAT(mistakes({{"Diameter", 1.0}, {"Growth", 0.1}}),
              ElementsAre(HasSubstr("needs 'Growth Density'")));
  EXPECT_THAT(mistakes({{"Diameter", 1.0}, {"Drags", std::vector{1.0, 0.5}}}),
              ElementsAre(HasSubstr("'Drags' needs 'Positions'")));
  EXPECT_THAT(mistakes({{"Diameter", 1.0}, {"Positions", std::vector{0.0, 1.0}}}),
              ElementsAre(HasSubstr("needs lists with values")));
  EXPECT_THAT(
      mistakes({{"Diameters", std::vector{1.0, 2.0}}, {"Positions", std::vector{0.1, 1.0}}}),
      ElementsAre(HasSubstr("rise from 0 to 1")));
  EXPECT_THAT(
      mistakes({{"Diameter", 1.0}, {"End Drag", 1.0}, {"End Drags", std::vector{1.0, 0.5}}}),
      ElementsAre(HasSubstr("give one of 'End Drag' and 'End Drags'")));
  kit::GivenValues deep = column({{"Diameter", 1.0}});
  deep[1].second = std::vector{0.0, 0.0, -60.0};
  EXPECT_THAT(build(deep), ElementsAre(HasSubstr("reaches 10 m below the bed of 'sea'")));
  kit::GivenValues elsewhere = column({{"Diameter", 1.0}});
  elsewhere[3].second = std::string("se");
  EXPECT_THAT(build(elsewhere), ElementsAre(HasSubstr("did you mean 'sea'")));
}

}  // namespace
}  // namespace culm::water
