#include <culm/base/error.hpp>
#include <culm/model/size_budget.hpp>

#include <gtest/gtest.h>

namespace culm::model {
namespace {

TEST(SizeBudget, IsSharedByAllThatAsk) {
  const Where where{"deck.xml", 7, "Structures / beam / Curve"};
  SizeBudget budget(1e9);
  budget.take(1000, 6e8, where);
  budget.take(1000, 4e8, where);
  try {
    budget.take(1.5e9, 2.4e12, where);
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "deck.xml:7: Structures / beam / Curve: asks for 1500000000 elements, with which "
        "the model needs about 2.4 TB of memory and 1 GB are allowed: take fewer elements, "
        "or allow more with --max-memory");
  }
}

}  // namespace
}  // namespace culm::model
