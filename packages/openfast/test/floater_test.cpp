#include <culm/base/error.hpp>
#include <culm/openfast/import.hpp>

#include "offshore_files.hpp"
#include "sample_files.hpp"
#include "sample_turbine.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>

namespace culm::openfast {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

constexpr const char* afloat = R"~(--- OpenFAST ---
Our platform
1         CompElast   - {1=ElastoDyn}
0         CompInflow  - {0=still air}
0         CompAero    - {0=None}
0         CompServo   - {0=None}
1         CompSeaSt   - {1=SeaState}
1         CompHydro   - {1=HydroDyn}
0         CompSub     - {0=None}
3         CompMooring - {1=MAP++; 3=MoorDyn}
0         CompIce     - {0=None}
9.8       Gravity     - (m/s^2)
1025      WtrDens     - (kg/m^3)
200       WtrDpth     - (m)
0         MSL2SWL     - (m)
--- INPUT FILES ---
"turbine.dat"  EDFile      - Name of file
"sea.dat"      SeaStFile   - Name of file
"waves.dat"    HydroFile   - Name of file
"lines.dat"    MooringFile - Name of file
"unused"       ServoFile   - Name of file
"unused"       SubFile     - Name of file
)~";

// It cannot sway.
constexpr const char* platform = R"~(True  PtfmSgDOF   - (flag)
False PtfmSwDOF   - (flag)
True  PtfmHvDOF   - (flag)
True  PtfmRDOF    - (flag)
True  PtfmPDOF    - (flag)
True  PtfmYDOF    - (flag)
-8    PtfmCMzt    - (m)
5E5   PtfmMass    - (kg)
1E7   PtfmRIner   - (kg m^2)
2E7   PtfmPIner   - (kg m^2)
3E7   PtfmYIner   - (kg m^2)
--- INITIAL CONDITIONS ---)~";

constexpr const char* flow = R"~(1         PotMod   - Potential flow
1         NBody    - Bodies
"hull"    PotFile  - Files
2         WAMITULEN - Length
800       PtfmVol0 - Volume
0.5       PtfmCOBxt - Centre
0         PtfmCOByt - Centre
)~";

std::string rows(const char* of_first, const char* word, const char* others) {
  std::string text = std::string(of_first) + "  " + word + "\n";
  for (int i = 0; i < 5; ++i) text += std::string(others) + "\n";
  return text;
}

constexpr const char* nothing = "0 0 0 0 0 0";
const std::string added = rows("7", "AddF0 - Preload", "0") +
                          rows("11 0 0 0 13 0", "AddCLin - Stiffness", nothing) +
                          rows(nothing, "AddBLin - Damping", nothing) +
                          rows("9e5 0 0 0 0 0", "AddBQuad - Quadratic", nothing);

class Floaters : public SampleFiles {
 protected:
  Floaters() {
    write("blade.dat", blade);
    write("tower.dat", tower);
    write("turbine.dat", change(turbine, "--- INITIAL CONDITIONS ---", platform));
    write("sea.dat", seastate_file);
    write("waves.dat", water_);
    write("lines.dat", moordyn_file);
    write("scene.fst", afloat);
  }

  std::string water_ =
      change(change(hydrodyn_file, "0         PotMod   - Potential flow\n", flow),
             " 0   AddF0 - Preload\n 0\n 0   0   0   0   0   0   AddCLin - Stiffness\n", added);
};

TEST_F(Floaters, FloatInTheWaterOnTheirLines) {
  TurbineOptions options;
  options.folder = path_of("decks");
  const Imported imported = import_file(path_of("scene.fst"), options);
  for (const std::string& part :
       {parameter("File Name", "../hull.1"), parameter("Length", "2"), parameter("Volume", "800"),
        parameter("Centre", "{0.5, 0, 0}"), parameter("Centre", "{0, 0, -8}"),
        parameter("Preload", "{7, 0, 0, 0, 0, 0}"), parameter("Anchor", "{400, 0, -200}"),
        parameter("Offset", "{20, 0, -14}"), parameter("Rise", "10"), parameter("Pull", "false"),
        parameter("Buoyancy", "true"), parameter("Pull", "true"),  // of members beside the hull
        std::string("name=\"no sway\""), std::string("name=\"platform motion\""),
        std::string("It floats on the platform of")}) {
    EXPECT_THAT(imported.deck, HasSubstr(part));
  }
  for (const char* part : {"foundation", "no surge", "\"Damping\" value=\"{0, 0, 0, 0, 0, 0,"}) {
    EXPECT_THAT(imported.deck, Not(HasSubstr(part)));
  }
  EXPECT_THAT(imported.report, Not(HasSubstr("not imported")));
  EXPECT_THAT(imported.report, Not(HasSubstr("no water")));
}

// Member 2 is filled up to still water: 3 m wide with walls of 0.05 m, 10 m long, from -12 to -4 m.
TEST_F(Floaters, CarryWhatFillsTheirMembers) {
  const Imported imported = import_file(path_of("scene.fst"));
  const double mass = 1025.0 * std::numbers::pi * 1.45 * 1.45 * 10.0;
  std::string body = imported.deck.substr(imported.deck.find("name=\"ballast\""));
  body.resize(body.find("</ParameterList>"));
  EXPECT_THAT(body, HasSubstr(fmt::format("value=\"{:.7g}", mass).substr(0, 13)));
  EXPECT_THAT(body, HasSubstr("{10, 3, -8"));
  EXPECT_THAT(imported.deck, Not(HasSubstr("Flooded")));
}

const std::string map_file = R"~(---- LINE DICTIONARY ----
LineType Diam MassDenInAir EA CB CIntDamp Ca Cdn Cdt
(-) (m) (kg/m) (N) (-) (Pa-s) (-) (-) (-)
chain 0.09 77.7 3.8E8 0.001 1.0E8 0.6 -1.0 0.05
---- NODE PROPERTIES ----
ID Attachment X Y Z M B FX FY FZ
(-) (-) (m) (m) (m) (kg) (m^3) (N) (N) (N)
1 fix 800 0 depth 0 0 # # #
2 Vessel 5 0 -70.0 0 0 # # #
---- LINE PROPERTIES ----
ID LineType UnstrLen NodeAnch NodeFair Flags
(-) (-) (m) (-) (-) (-)
1 chain 830 1 2 tension_fair
---- SOLVER OPTIONS ----
Option
(-)
repeat 90 180
)~";

TEST_F(Floaters, TakeTheLinesOfMap) {
  write("scene.fst", change(afloat, "3         CompMooring", "1         CompMooring"));
  write("lines.dat", map_file);
  const Imported imported = import_file(path_of("scene.fst"));
  EXPECT_THAT(imported.deck, HasSubstr(parameter("Anchor", "{800, 0, -200}")));
  EXPECT_THAT(imported.deck, HasSubstr("name=\"line 3\""));
  EXPECT_THAT(imported.deck, HasSubstr(parameter("Friction", "0.001")));
  EXPECT_THAT(imported.deck, HasSubstr("800, -200}"));
  EXPECT_THAT(imported.deck, HasSubstr(R"("Anchor" value="{-800, )"));
  EXPECT_THAT(imported.report, Not(HasSubstr("seabed there")));
}

TEST_F(Floaters, WatchTheLinesThatAreThere) {
  write("scene.fst", change(afloat, "3         CompMooring", "1         CompMooring"));
  write("lines.dat", change(change(map_file, "---- LINE PROPERTIES",
                                   "3 Vessel -5 0 -70 0 0 # # #\n"
                                   "---- LINE PROPERTIES"),
                            "---- SOLVER", "2 chain 12 3 2 tension_fair\n---- SOLVER"));
  const Imported imported = import_file(path_of("scene.fst"));
  EXPECT_THAT(imported.report, HasSubstr("line 2: does not lead from a fixed point"));
  EXPECT_THAT(imported.deck, HasSubstr(parameter("Load", "line 1")));
  EXPECT_THAT(imported.deck, Not(HasSubstr(parameter("Load", "line 2"))));
}

TEST_F(Floaters, TellWhatLinesOfMapAreNot) {
  write("scene.fst", change(afloat, "3         CompMooring", "1         CompMooring"));
  write("lines.dat", change(map_file, "tension_fair", "tension_fair OMIT_CONTACT"));
  EXPECT_THAT(import_file(path_of("scene.fst")).report,
              HasSubstr("line 1 hangs through the seabed there"));
  write("lines.dat", change(map_file, "tension_fair", "linear_spring"));
  EXPECT_THAT([&] { import_file(path_of("scene.fst")); },
              ThrowsMessage<InputError>(HasSubstr("line 1 is a linear spring")));
}

TEST_F(Floaters, RefuseWhatWouldMakeAnotherPlatform) {
  const auto expect = [&](const std::string& file, const std::string& text, const char* message) {
    const std::string whole = file == "lines.dat"   ? moordyn_file
                              : file == "waves.dat" ? water_
                                                    : std::string();
    write(file, text);
    EXPECT_THAT([&] { import_file(path_of("scene.fst")); },
                ThrowsMessage<InputError>(HasSubstr(message)));
    write(file, whole);
  };
  expect("lines.dat", change(moordyn_file, "4      Coupled", "4      Free   "),
         "point 4 is 'free'; lines that end there are not in the deck");
  expect("lines.dat",
         change(moordyn_file, "2       wire        4        2", "2       wire        R1A      2"),
         "line 2 ends on a rod");
  expect("waves.dat", change(water_, "1         NBody", "2         NBody"), "one body is imported");
  expect("waves.dat", change(water_, "1         PotMod", "2         PotMod"), "by WAMIT, got 2");
  expect("waves.dat", change(water_, "9e5 0 0 0 0 0", "9e5 0 0 0 0"),
         "must be 114 numbers, found 113");
  write("turbine.dat", change(turbine, "--- INITIAL CONDITIONS ---",
                              std::string("-3 PtfmRefzt - (m)\n") + platform));
  EXPECT_THAT([&] { import_file(path_of("scene.fst")); },
              ThrowsMessage<InputError>(HasSubstr("PtfmRefzt: must be 0")));
}

TEST_F(Floaters, WithoutFreedomStandOnTheirFoundation) {
  std::string held = platform;
  for (std::size_t at = held.find("True "); at != std::string::npos; at = held.find("True ")) {
    held.replace(at, 5, "False");
  }
  write("turbine.dat", change(turbine, "--- INITIAL CONDITIONS ---", held));
  const Imported imported = import_file(path_of("scene.fst"));
  EXPECT_THAT(imported.deck, HasSubstr("foundation"));
  EXPECT_THAT(imported.report, HasSubstr("no water: its inertia"));
  EXPECT_THAT(imported.report, HasSubstr("nothing moors the platform"));
}

}  // namespace
}  // namespace culm::openfast
