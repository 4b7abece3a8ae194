#include "../src/teuchos_gate.hpp"

#include <culm/base/schema.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace culm::deck {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

Schema schema() {
  return Schema("culm")
      .add(number("Mass", "kg", "").positive())
      .add(integer("Count", "").greater_than(0).less_than(4).optional(1))
      .add(numbers("Axes", "", "").at_most(1).optional(std::vector<double>{}))
      .add(choice("Shape", {"box", "tube"}, "").optional("box"));
}

/// Options as the validator would make them, with one value after the caller's wish.
Options options(const std::string& name, Value value) {
  Options options("culm");
  options.set("Mass", 1.0).set("Count", 1).set("Axes", std::vector<double>{});
  options.set("Shape", std::string("box")).set(name, std::move(value));
  return options;
}

TEST(TeuchosGate, AcceptsWhatTheSchemaAllows) {
  EXPECT_THAT(teuchos_objection(options("Mass", 1e-300), schema()), IsEmpty());
  EXPECT_THAT(teuchos_objection(options("Count", 3), schema()), IsEmpty());
  EXPECT_THAT(teuchos_objection(options("Axes", std::vector{1.0}), schema()), IsEmpty());
  EXPECT_THAT(teuchos_objection(options("Shape", std::string("tube")), schema()), IsEmpty());
}

TEST(TeuchosGate, ObjectsToWhatTheSchemaForbids) {
  EXPECT_THAT(teuchos_objection(options("Mass", 0.0), schema()), HasSubstr("Mass"));
  EXPECT_THAT(teuchos_objection(options("Count", 0), schema()), HasSubstr("Count"));
  EXPECT_THAT(teuchos_objection(options("Count", 4), schema()), HasSubstr("Count"));
  EXPECT_THAT(teuchos_objection(options("Axes", std::vector{1.5}), schema()), HasSubstr("Axes"));
  EXPECT_THAT(teuchos_objection(options("Shape", std::string("orb")), schema()),
              HasSubstr("Shape"));
  EXPECT_THAT(teuchos_objection(options("Mass", 1), schema()), HasSubstr("Mass"));
  EXPECT_THAT(teuchos_objection(options("Colour", 1), schema()), HasSubstr("Colour"));
}

TEST(TeuchosGate, NoticesADefaultThatIsNotTheSchemas) {
  Options wrong = options("Mass", 1.0);
  wrong.set("Count", 2, false, {});
  EXPECT_EQ(teuchos_objection(wrong, schema()), "'Count' of 'culm' differs");
}

}  // namespace
}  // namespace culm::deck
