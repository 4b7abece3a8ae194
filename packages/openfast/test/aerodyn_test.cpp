#include <culm/base/error.hpp>
#include <culm/openfast/aerodyn.hpp>
#include <culm/openfast/import.hpp>
#include <culm/openfast/inflow.hpp>

#include "sample_files.hpp"
#include "sample_scene.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

namespace culm::openfast {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double degree = std::numbers::pi / 180.0;

class AeroDynFiles : public SampleFiles {
 protected:
  AeroDynFiles() {
    for (const auto& [name, text] : scene_files()) write(name, text);
    aero_ = path_of("aero.dat");
    scene_ = path_of("scene.fst");
  }
  AeroDyn read() { return read_aerodyn(aero_, 2, 1.2, report_); }
  std::string told() const { return report_.text("air"); }
  Wind inflow(const std::string& text) {
    return read_inflow(write("wind.dat", text), 22.0, report_);
  }
  template <class Act>
  static std::string message_of(const Act& act) {
    try {
      act();
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  Report report_;
  std::filesystem::path aero_, scene_;
};

TEST_F(AeroDynFiles, PrimaryFileBecomesOptions) {
  const AeroDyn read = AeroDynFiles::read();
  EXPECT_EQ(read.density, 1.2);
  EXPECT_EQ(read.induction, "Dynamic");
  EXPECT_EQ(read.yaw, "Pitt Peters");
  EXPECT_EQ(read.lag, "Four States");
  EXPECT_TRUE(read.tip_loss);
  EXPECT_FALSE(read.hub_loss);
  EXPECT_FALSE(read.drag_induces);
  ASSERT_EQ(read.tower.size(), 3U);
  EXPECT_EQ(read.tower[2].drag, 0.7);
  ASSERT_EQ(read.airfoils.size(), 2U);
  EXPECT_EQ(read.airfoils[0].name, "round");
}

TEST_F(AeroDynFiles, OlderKeywordsMeanTheSame) {
  std::string old = change(aero, "2          Wake_Mod ", "1          WakeMod  ");
  old = change(old, "======  Environ", "2 AFAeroMod - (switch)\n======  Environ");
  old = change(old, "4          UA_Mod ", "6          UAMod  ");
  old = change(old, "1          Skew_Mod ", "1          SkewMod  ");
  old = change(old, "default    SkewRedistr_Mod - (switch)\n", "");
  write("aero.dat", old);
  const AeroDyn read = AeroDynFiles::read();
  EXPECT_EQ(read.induction, "Steady");
  EXPECT_EQ(read.lag, "Oye");
  EXPECT_THAT(told(), HasSubstr("lags by 6 half chords; AeroDyn's by 3"));
  EXPECT_EQ(read.yaw, "None");
  write("aero.dat", change(old, "2 AFAeroMod", "1 AFAeroMod"));
  EXPECT_EQ(AeroDynFiles::read().lag, "None");
}

TEST_F(AeroDynFiles, WhatHasNoPlaceInTheDeckIsTold) {
  const std::string more =
      "4          UA_Mod    - (switch)\n0.25       UAStartRad - start\n"
      "1.0        UAEndRad   - end\n3.0        SkewRedistrFactor - factor";
  write("aero.dat", change(aero, "4          UA_Mod    - (switch)", more));
  (void)AeroDynFiles::read();
  EXPECT_THAT(told(), HasSubstr("UAStartRad = 0.25: unsteady aerodynamics from the root on"));
  EXPECT_THAT(told(), HasSubstr("SkewRedistrFactor = 3: skewed wakes with 15 pi / 32"));
  EXPECT_THAT(told(), Not(HasSubstr("UAEndRad")));
}

TEST_F(AeroDynFiles, TablesOfAirfoilsHaveTheirColumns) {
  const AeroDyn read = AeroDynFiles::read();
  const std::vector<AirfoilRow>& rows = read.airfoils[1].rows;
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_DOUBLE_EQ(rows[1].angle, -90.0 * degree);
  EXPECT_EQ(rows[2].lift, 0.4);
  EXPECT_EQ(rows[2].drag, 0.01);
  EXPECT_EQ(rows[2].moment, -0.05);
  EXPECT_THAT(told(),
              HasSubstr("1 of 2 tables, for Re = 3 million: the first one, for 0.75, counts"));
  EXPECT_THAT(told(), HasSubstr("A1 = 0.2; lags and stall have constants of their own"));
}

TEST_F(AeroDynFiles, TheTowerChangesTheWind) {
  EXPECT_FALSE(read().tower_influence);
  std::string text = change(aero, "0          TwrPotent", "2          TwrPotent");
  write("aero.dat", change(text, "False      TwrShadow", "True       TwrShadow"));
  const std::optional<AeroTowerInfluence> influence = read().tower_influence;
  ASSERT_TRUE(influence);
  EXPECT_EQ(influence->upstream, "Bak");
  EXPECT_EQ(influence->downstream, "Powles");
  ASSERT_EQ(influence->shape.size(), 3U);
  EXPECT_EQ(influence->shape[1].diameter, 1.5);
  EXPECT_EQ(influence->shape[1].turbulence, 0.1);
  write("aero.dat", change(text, "False      TwrShadow", "3          TwrShadow"));
  EXPECT_THAT(message_of([&] { (void)read(); }),
              HasSubstr("TwrShadow: must be from 0 to 2, got 3"));
}

TEST_F(AeroDynFiles, WhatIsOnAndNotThereIsNamed) {
  std::string text = change(aero, "2          Wake_Mod", "3          Wake_Mod");
  text = change(text, "True       TanInd", "False      TanInd");
  text = change(text, "1          AFTabMod", "2          AFTabMod");
  write("aero.dat", change(text, "4          UA_Mod", "3          UA_Mod"));
  (void)read();
  for (const char* part :
       {"Wake_Mod = 3: the vortex wake of OLAF",
        "TanInd False: ", "AFTabMod = 2: coefficients do not",
        "UA_Mod = 3: the nearest model of unsteady airfoils is taken, four states (4)"}) {
    EXPECT_THAT(told(), HasSubstr(part));
  }
}

TEST_F(AeroDynFiles, MistakesHaveTheirPlaces) {
  const auto message = [&](const std::string& name, const char* text, const char* old,
                           const char* by) {
    write(name, change(text, old, by));
    const std::string found = message_of([&] { (void)read(); });
    write(name, text);
    return found;
  };
  EXPECT_THAT(message("aero.dat", aero, "2          NumAF", "3          NumAF"),
              HasSubstr("AFNames: must be 3 lines with a name in quotes, found 2"));
  EXPECT_THAT(message("aero.dat", aero, "2          Wake_Mod", "5          Wake_Mod"),
              HasSubstr("Wake_Mod: must be from 0 to 3, got 5"));
  EXPECT_THAT(message("aero.dat", aero, "Wake_Mod  ", "Wake_Mud  "),
              HasSubstr("Wake_Mod: is missing"));
  EXPECT_THAT(message("foils/wing.dat", airfoil, "2           NumTabs", "3           NumTabs"),
              HasSubstr("NumAlf: stands there 2 times, NumTabs announces 3 tables"));
  EXPECT_THAT(message("foils/wing.dat", airfoil, "90    1.2   0.1", "90    1.2   x"),
              HasSubstr("wing.dat:17: Cl: must be a number in column 3"));
  EXPECT_THAT(
      message("foils/wing.dat", airfoil, "  180   0.1   0.0  0\n! data", "  170 0 0 0\n! data"),
      HasSubstr("must reach from -180 to 180 degrees in at least three rows, got -180 to 170"));
  EXPECT_THAT(message("aero_blade.dat", aero_blade, "1.5     2", "1.5     3"),
              HasSubstr("aero_blade.dat:8: BlAFID: must be a whole number from 1 to 2, got 3"));
  EXPECT_THAT(message("aero_blade.dat", aero_blade, " 4     0 ", " 14    0 "),
              HasSubstr("aero_blade.dat:9: BlSpn: must rise from 0, got 10"));
  EXPECT_THAT(
      message("aero_blade.dat", aero_blade, " 10    0 ", "\n! a line of the user\n 10    0 "),
      HasSubstr("blade must be 3 lines of 7 numbers, found 2"));
}

TEST_F(AeroDynFiles, AreaAndItsCentreAreIntegrals) {
  (void)read();
  // trapezia 2 to 1.5 over 4 m and 1.5 to 1 over 6 m: 7 + 7.5, moments 13.33 + 51
  EXPECT_THAT(told(), HasSubstr("blade of 10 m, area 14.5 m^2, its centre 4.43678 m"));
}

TEST_F(AeroDynFiles, SteadyWindHasItsDirection) {
  const Wind read = inflow(wind);
  EXPECT_EQ(read.kind, Wind::Kind::power_law);
  EXPECT_EQ(read.speed, 8.0);
  EXPECT_EQ(read.height, 20.0);
  EXPECT_EQ(read.exponent, 0.2);
  EXPECT_DOUBLE_EQ(read.direction, 90.0 * degree);
}

TEST_F(AeroDynFiles, UniformWindAndBoxesNameTheirFiles) {
  write("gust.wnd", "0 8 0 0 0 0 0 0\n");
  // 3 points upwards, 4 m apart, from 15 m on
  std::string header(42, '\0');
  const auto put = [&header](std::size_t place, auto number) {
    std::memcpy(header.data() + place, &number, sizeof number);
  };
  put(2, std::int32_t{3});
  put(18, 4.0F);
  put(38, 15.0F);
  write("box.bts", header);
  const std::string type = "1   WindType";
  const Wind table = inflow(change(wind, type, "2   WindType"));
  EXPECT_EQ(table.kind, Wind::Kind::table);
  EXPECT_EQ(table.file.filename(), "gust.wnd");
  EXPECT_EQ(table.height, 22.0);
  EXPECT_EQ(table.length, 20.0);
  const Wind box = inflow(change(wind, type, "3   WindType"));
  EXPECT_EQ(box.kind, Wind::Kind::box);
  EXPECT_EQ(box.file.filename(), "box.bts");
  EXPECT_EQ(box.centre, 19.0);
  EXPECT_THAT(told(), HasSubstr("the middle of the box is 19 m high, the hub 22 m"));
  write("box.bts", "short");
  EXPECT_THAT(message_of([&] { (void)inflow(change(wind, type, "3   WindType")); }),
              HasSubstr("box.bts: is no box of TurbSim"));
}

TEST_F(AeroDynFiles, WindsThatAreNotKnownAreNamedWithWhatIsNearest) {
  const std::string type = "1   WindType";
  const Wind still = inflow(change(wind, type, "6   WindType"));
  EXPECT_EQ(still.speed, 0.0);
  EXPECT_EQ(still.height, 22.0);
  EXPECT_THAT(told(), HasSubstr("WindType = 6: a wind of a user's routine; the air stands still"));
  for (const char* other : {"3   WindType", "4   WindType", "5   WindType", "7   WindType"}) {
    const Wind gone = inflow(change(wind, type, other));
    EXPECT_EQ(gone.kind, Wind::Kind::power_law);
    EXPECT_EQ(gone.speed, 0.0);
    EXPECT_TRUE(gone.file.empty());
    EXPECT_DOUBLE_EQ(gone.direction, other[0] == '7' ? 0.0 : 90.0 * degree);
  }
  for (const char* file : {"box.bts", "style.wnd", "mann_u.bin", "style"}) {
    EXPECT_THAT(told(), HasSubstr(std::string(file) + ", which is not there"));
  }
  EXPECT_THAT(message_of([&] { (void)inflow(change(wind, type, "8   WindType")); }),
              HasSubstr("WindType: must be from 1 to 7, got 8"));
}

TEST_F(AeroDynFiles, SceneBecomesFlowStripsAndRotor) {
  const Imported made = import_file(scene_);
  for (
      const char* part :
      {R"(<Variable name="V" value="8"/>)", R"(<Variable name="W" value="30" unit="rpm"/>)",
       R"(<Variable name="end" value="12"/>)", R"(<Parameter name="Density" value="1.2"/>)",
       R"(<Parameter name="Direction" value="{6.12323399574e-17, -1, 0}"/>)",
       R"(<Parameter name="Positions" value="{0, 0.4, 1}"/>)",
       R"(<Parameter name="Chords" value="{2, 1.5, 1}"/>)",
       R"(<Parameter name="Airfoils" value="{round, wing, wing}"/>)",
       // the structure is turned by 10, 5.2 and -2 degrees
       R"(<Parameter name="Twists" value="{0, -1.8, -2}" unit="deg"/>)",
       R"(<Parameter name="Axes At" value="{0.25, 0.25, 0.25}"/>)",
       // of the tower
       R"(<Parameter name="Positions" value="{0, 0.5, 1}"/>)",
       R"(<Parameter name="Type" value="Strip Drag"/>)",
       R"(<Parameter name="Diameters" value="{2, 1.5, 1.16666666667}"/>)",
       R"(<Parameter name="Drags" value="{0.5, 0.5, 0.633333333333}"/>)",
       R"(<Parameter name="Losses" value="{Tip}"/>)",
       R"(<Parameter name="Inactive" value="{rotation, induction, air on blade 1, air on blade 2, air on the tower}"/>)"}) {
    EXPECT_THAT(made.deck, HasSubstr(part));
  }
  EXPECT_EQ(made.only_modes, std::vector<std::string>{"end=step"});
}

// An offset of the quarter chord along the turned chord is a place of the axis, one across it is
// told.
TEST_F(AeroDynFiles, QuarterChordsHaveTheirPlaces) {
  const std::string text = aero_blade;
  const double s = std::sin(7.0 * degree), c = std::cos(7.0 * degree);
  char line[200];
  std::snprintf(line, sizeof line, " 4     %.15g %.15g 0        7       1.5     2", -0.15 * s,
                -0.15 * c);
  write("aero_blade.dat",
        change(text, " 4     0         0       0        7       1.5     2", line));
  Imported made = import_file(scene_);
  EXPECT_THAT(made.deck, HasSubstr(R"(<Parameter name="Axes At" value="{0.25, 0.35, 0.25}"/>)"));
  EXPECT_THAT(made.report, Not(HasSubstr("beside the chord line")));
  std::snprintf(line, sizeof line, " 4     %.15g %.15g 0        7       1.5     2", 0.15 * c,
                -0.15 * s);
  write("aero_blade.dat",
        change(text, " 4     0         0       0        7       1.5     2", line));
  made = import_file(scene_);
  EXPECT_THAT(made.deck, HasSubstr(R"(<Parameter name="Axes At" value="{0.25, 0.25, 0.25}"/>)"));
  EXPECT_THAT(made.report, HasSubstr("lies up to 0.1 chords beside the chord line"));
}

TEST_F(AeroDynFiles, ModulesThatAreNotImportedAreNamed) {
  const std::string wet = change(scene, "0     CompHydro", "1     CompHydro");
  write("scene.fst", wet);
  EXPECT_THAT(message_of([&] { (void)import_file(scene_); }), HasSubstr("HydroFile: is missing"));
  write("scene.fst", wet + "\"sea.dat\" HydroFile - (quoted string)\n1 CompSoil - (switch)\n");
  const Imported made = import_file(scene_);
  EXPECT_THAT(made.report, HasSubstr("HydroDyn, CompHydro = 1 (sea.dat): no water"));
  EXPECT_THAT(made.report, HasSubstr("soil, CompSoil = 1: the base stands on rock"));
}

TEST_F(AeroDynFiles, ScenesThatCannotBeAreRefused) {
  const auto message = [&](const char* old, const char* by) {
    write("scene.fst", change(scene, old, by));
    return message_of([&] { (void)import_file(scene_); });
  };
  EXPECT_THAT(message("1     CompElast", "3     CompElast"), HasSubstr("CompElast: must be 1"));
  EXPECT_THAT(message("2     CompAero", "7     CompAero"), HasSubstr("must be from 0 to 3, got 7"));
  EXPECT_THAT(message("1.2   AirDens ", "1.2   AirDans "),
              HasSubstr("the .fst file has no AirDens"));
  EXPECT_THAT(message("0     CompServo", "True MirrorRotor - x\n0     CompServo"),
              HasSubstr("MirrorRotor: rotors that turn the other way"));
}

TEST_F(AeroDynFiles, WithoutItsFilesThereIsNoAirAndNoSilence) {
  std::filesystem::remove(aero_);
  const Imported made = import_file(scene_);
  EXPECT_THAT(made.deck, Not(HasSubstr("Flows")));
  EXPECT_THAT(made.report, HasSubstr("names AeroDyn's file"));
  EXPECT_TRUE(made.only_modes.empty());
}

TEST_F(AeroDynFiles, SwitchesThatAreMisspeltAreTold) {
  write("scene.fst", change(scene, "CompAero ", "CompAxro "));
  EXPECT_THAT(message_of([&] { (void)import_file(scene_); }), HasSubstr("CompAero: is missing"));
  write("scene.fst", change(scene, "Gravity ", "Gravety "));
  EXPECT_THAT(import_file(scene_).report, HasSubstr("Gravety: unknown entry, left out: '9.81'"));
}

}  // namespace
}  // namespace culm::openfast
