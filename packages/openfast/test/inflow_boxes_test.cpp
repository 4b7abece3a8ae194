// Boxes of turbulence that InflowWind names: what becomes of their parameters, and damaged files.
#include <culm/base/error.hpp>
#include <culm/openfast/import.hpp>
#include <culm/openfast/inflow.hpp>

#include "sample_files.hpp"
#include "sample_scene.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <optional>
#include <random>
#include <tuple>

namespace culm::openfast {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string summary = R"~(
TurbSim - a summary of ours
   True      Clockwise rotation when looking downwind?
   90.000    Hub height [m]
   Normalizing Parameters for Binary Data (approximate statistics):
   UBar  =  12.5000 m/s
   TI(u) =  16.0000 %
   TI(v) =  12.0000 %
   TI(w) =   8.0000 %
   Height Offset =   2.5000 m
   Grid Base     =  20.0000 m
 Creating a PERIODIC output file.
)~";

const std::string scaling = R"~(UBAR  12
REFHT  90
TI  0.15
0.1 TI_V
TI_W  0.05
WDIR  0.5
FLINC  0.1
WINDF    "boxes/native.wnd"
WSHEAR    .2
XOFFSET  24
)~";

class InflowBoxes : public SampleFiles {
 protected:
  InflowBoxes() {
    for (const auto& [name, text] : scene_files()) write(name, text);
    for (const char* name : {"mann_u.bin", "mann_v.bin", "mann_w.bin"}) write(name, "");
    write("style.wnd", std::string("\x9d\xff\x04\x00 and so on", 14));
    write("style.sum", summary);
    write("boxes/native.wnd", "");
    write("style", scaling);
  }

  std::string wind_of_type(int type) const {
    return change(wind, "1   WindType", std::to_string(type) + "   WindType");
  }
  Wind inflow(const std::string& text) {
    return read_inflow(write("wind.dat", text), 22.0, report_);
  }
  Wind inflow(int type) { return inflow(wind_of_type(type)); }
  std::string told() const { return report_.text("air"); }
  std::string objection(const std::string& text) {
    try {
      (void)inflow(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  }
  // The deck of the scene in such a wind.
  Imported deck(int type) {
    write("wind.dat", wind_of_type(type));
    return import_file(path_of("scene.fst"));
  }

  // The winds of a deck.
  static std::string winds(const Imported& made) {
    const std::size_t begin = made.deck.find(R"(<ParameterList name="Flows">)");
    return made.deck.substr(begin, made.deck.find(R"(<ParameterList name="Airfoils">)") - begin);
  }

  Report report_;
};

TEST_F(InflowBoxes, OfHawc2HaveAMeanWindAndFactorsOrDeviations) {
  const Wind factors = inflow(5);
  EXPECT_EQ(factors.kind, Wind::Kind::mann);
  EXPECT_EQ(factors.speed, 13.0);
  EXPECT_EQ(factors.height, 25.0);
  EXPECT_EQ(factors.exponent, 0.1);
  EXPECT_EQ(factors.ahead, 6.5);
  EXPECT_THAT(factors.mann.points, ElementsAre(4, 3, 2));
  EXPECT_THAT(factors.mann.spacing, ElementsAre(5.0, 10.0, 20.0));
  EXPECT_THAT(factors.mann.factors, ElementsAre(1.5, 0.7, 0.5));
  EXPECT_THAT(factors.mann.deviations, IsEmpty());
  const std::string method = "1   ScaleMethod";
  const Wind deviations = inflow(change(wind_of_type(5), method, "2   ScaleMethod"));
  EXPECT_THAT(deviations.mann.deviations, ElementsAre(2.5, 2.0, 1.0));
  EXPECT_THAT(deviations.mann.factors, IsEmpty());
  EXPECT_THAT(told(), HasSubstr("components get these deviations over the whole box"));
  const Wind logarithmic = inflow(change(wind_of_type(5), "2   WindProfile", "1   WindProfile"));
  EXPECT_EQ(logarithmic.roughness, 0.03);
  for (const char* part :
       {R"("Mann Box")", "/mann_u.bin, ", "/mann_w.bin}\"", R"(name="Points" value="{4, 3, 2}")",
        R"(name="Factors" value="{1.5, 0.7, 0.5}")", R"(name="Speed" value="V")",
        R"(name="Exponent" value="0.1")", R"(name="Centre" value="{0, 0, 25}")",
        R"(name="Delay" value="0.5")", R"(name="Without Means" value="true")"}) {
    EXPECT_THAT(winds(deck(5)), HasSubstr(part));
  }
  EXPECT_FALSE(inflow(change(wind_of_type(5), method, "0   ScaleMethod")).mann.loses_means);
}

TEST_F(InflowBoxes, OfTurbSimInBladedsFormatFollowTheirSummary) {
  const Wind read = inflow(4);
  EXPECT_EQ(read.kind, Wind::Kind::bladed);
  EXPECT_EQ(read.file.filename(), "style.wnd");
  EXPECT_EQ(read.speed, 0.0);
  EXPECT_EQ(read.centre, 87.5);
  EXPECT_TRUE(read.bladed.is_clockwise);
  EXPECT_TRUE(read.bladed.is_periodic);
  EXPECT_FALSE(read.bladed.is_left_handed);
  EXPECT_THAT(read.bladed.intensities, IsEmpty());
  for (const char* part :
       {R"("Bladed Box")", "/style.wnd\"", R"(name="Components Across" value="Left")",
        R"(name="Points From" value="Left")", R"(name="Periodic" value="true")",
        R"(name="Centre" value="{0, 0, 87.5}")", R"(name="Delay" value="0")"}) {
    EXPECT_THAT(winds(deck(4)), HasSubstr(part));
  }
  EXPECT_THAT(winds(deck(4)), Not(HasSubstr("Exponent")));
  write("style.wnd", std::string("\x9d\xff\x07\x00 and so on", 14));
  write("style.sum", change(change(summary, "True", "F"), "PERIODIC", "BLADED LEFT-HAND RULE"));
  const Wind other = inflow(4);
  EXPECT_THAT(other.bladed.intensities, ElementsAre(0.16, 0.12, 0.08));
  EXPECT_FALSE(other.bladed.is_clockwise);
  EXPECT_FALSE(other.bladed.is_periodic);
  EXPECT_TRUE(other.bladed.is_left_handed);
  EXPECT_THAT(winds(deck(4)), Not(HasSubstr("Delay")));
}

TEST_F(InflowBoxes, OfBladedFollowTheFileWithTheirScaling) {
  const Wind read = inflow(7);
  EXPECT_EQ(read.kind, Wind::Kind::bladed);
  EXPECT_EQ(read.file, path_of("boxes/native.wnd"));
  EXPECT_EQ(read.speed, 12.0);
  EXPECT_EQ(read.exponent, 0.2);
  EXPECT_EQ(read.direction, 0.5);
  EXPECT_EQ(read.upflow, 0.1);
  EXPECT_THAT(read.bladed.intensities, ElementsAre(0.15, 0.1, 0.05));
  for (const char* part :
       {"/boxes/native.wnd\"", R"(name="Intensities" value="{0.15, 0.1, 0.05}")",
        R"(name="Speed" value="V")", R"(name="Height" value="90")", R"(name="Delay" value="2")",
        R"(name="Components Across" value="Right")"}) {
    EXPECT_THAT(winds(deck(7)), HasSubstr(part));
  }
}

TEST_F(InflowBoxes, WhatAScalingSaysBesideIsTold) {
  write("style", scaling + "VLINSHEAR  0.1\nHLINSHEAR 0\nREFLENGTH  120\nTWRSHADE  2\n");
  (void)inflow(7);
  EXPECT_THAT(told(), HasSubstr("style:11: VLINSHEAR = 0.1: the mean wind has no shear but"));
  EXPECT_THAT(told(), HasSubstr("style:14: twrshade: unknown entry, left out: '2'"));
  EXPECT_THAT(told(), Not(HasSubstr("HLINSHEAR")));
  EXPECT_THAT(told(), Not(HasSubstr("reflength")));
}

TEST_F(InflowBoxes, MistakesAreNamedWithTheirPlace) {
  EXPECT_THAT(objection(change(wind_of_type(5), "4   nx", "1   nx")),
              HasSubstr("nx: must be at least 2, got 1"));
  EXPECT_THAT(objection(change(wind_of_type(5), "1   ScaleMethod", "3   ScaleMethod")),
              HasSubstr("ScaleMethod: must be 0, 1 or 2, got 3"));
  write("style.sum", change(summary, "UBar", "mean"));
  EXPECT_THAT(objection(wind_of_type(4)), HasSubstr("style.sum: has no line with UBar"));
  write("style.sum", change(summary, " 16.0000 %", "?"));
  EXPECT_THAT(objection(wind_of_type(4)),
              HasSubstr("style.sum:7: must hold a number: the turbulence intensities"));
  std::filesystem::remove(path_of("style.sum"));
  EXPECT_THAT(objection(wind_of_type(4)), HasSubstr("style.sum"));
  write("style", change(scaling, "REFHT  90", "REFHT  0"));
  EXPECT_THAT(objection(wind_of_type(7)), HasSubstr("style:2: REFHT: must be positive, got 0"));
  write("style", change(scaling, "WSHEAR", "SHEAR"));
  EXPECT_THAT(objection(wind_of_type(7)), HasSubstr("WSHEAR: is missing"));
}

// Cut or with a flipped bit: a message, or a deck with all parameters that follow from the file; if
// it is cut, the same deck, or one about which the report says something else.
TEST_F(InflowBoxes, DamagedSummariesChangeNothingInSilence) {
  const auto lines = [](const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
  };
  for (const auto& [type, name, text] :
       {std::tuple(4, "style.sum", summary), std::tuple(7, "style", scaling)}) {
    const Imported whole = deck(type);
    const auto import_damaged = [&](const std::string& damaged) -> std::optional<Imported> {
      write(name, damaged);
      try {
        return import_file(path_of("scene.fst"));
      } catch (const Error& error) {
        EXPECT_FALSE(std::string(error.what()).empty());
        return std::nullopt;
      }
    };
    for (std::size_t percent = 0; percent < 100; percent += 5) {
      const auto made = import_damaged(text.substr(0, text.size() * percent / 100));
      EXPECT_TRUE(!made || made->deck == whole.deck || made->report != whole.report)
          << name << " cut at " << percent << " %";
    }
    std::mt19937 generator(1);
    for (int i = 0; i < 500; ++i) {
      std::string damaged = text;
      const std::size_t place = generator() % text.size();
      damaged[place] = static_cast<char>(damaged[place] ^ (1 << (generator() % 8)));
      const auto made = import_damaged(damaged);
      EXPECT_TRUE(!made || lines(made->deck) == lines(whole.deck) || made->report != whole.report)
          << name << ", byte " << place;
    }
    write(name, text);
  }
}

}  // namespace
}  // namespace culm::openfast
