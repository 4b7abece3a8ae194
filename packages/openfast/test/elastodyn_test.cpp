#include <culm/base/error.hpp>
#include <culm/openfast/elastodyn.hpp>
#include <culm/openfast/import.hpp>

#include "offshore_files.hpp"
#include "sample_files.hpp"
#include "sample_turbine.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace culm::openfast {
namespace {

using testing::ContainsRegex;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

class ElastoDynFiles : public SampleFiles {
 protected:
  ElastoDynFiles() {
    write("blade.dat", blade);
    write("tower.dat", tower);
    path_ = write("turbine.dat", turbine);
  }
  ElastoDyn read() const {
    Report report;
    return read_elastodyn(path_, report);
  }
  std::string message_of(const std::string& name, const std::string& text) const {
    const auto path = write(name, text);
    try {
      import_file(name == "turbine.dat" ? path : path_);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  std::filesystem::path path_;
};

TEST_F(ElastoDynFiles, MainFileNamesGeometryAndMasses) {
  const ElastoDyn read = ElastoDynFiles::read();
  EXPECT_EQ(read.tower_top, 20.0);
  EXPECT_EQ(read.nacelle_centre, Vec3(0.2, 0.0, 1.0));
  EXPECT_DOUBLE_EQ(read.azimuth, 0.5 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(read.rotor_speed, std::numbers::pi);
  ASSERT_EQ(read.blades.size(), 2U);
  const auto& stations = read.blades[1].beam.blade.stations;
  ASSERT_EQ(stations.size(), 2U);
  EXPECT_EQ(stations[0].mass(0, 0), 24.0);      // AdjBlMs
  EXPECT_EQ(stations[0].stiffness(4, 4), 6e5);  // AdjFlSt; flap bends about y
  EXPECT_EQ(stations[0].stiffness(3, 3), 8e5);
  EXPECT_EQ(read.blades[0].beam.key_points[1].position, Vec3(0.0, 0.0, 10.0));
  EXPECT_EQ(read.tower.stations[0].fore_aft, 1e8);
  EXPECT_FALSE(read.tower.stations[0].torsion);
}

TEST_F(ElastoDynFiles, OlderFilesHaveTorsionAndStretch) {
  std::string old =
      change(blade, "FlpStff EdgStff", "FlpStff EdgStff GJStff EAStff FlpIner EdgIner");
  old =
      change(old, "  0.0     10        12       2E5     8E5", "  0 10 12 2E5 8E5 7E4 5E6 1.5 2.5");
  old =
      change(old, "  1.0     -2        6        2E5     8E5", "  1 -2 6  2E5 8E5 7E4 5E6 1.5 2.5");
  write("blade.dat", old);
  const BladeStation station = read().blades[0].beam.blade.stations[0];
  EXPECT_EQ(station.stiffness(2, 2), 5e6);
  EXPECT_EQ(station.stiffness(5, 5), 7e4);
  EXPECT_EQ(station.mass(3, 3), 2.5);
  EXPECT_EQ(station.mass(4, 4), 1.5);
}

// Azimuth 90 degrees: the first blade lies along -y, as x is downwind and the rotor turns clockwise
// seen from upwind, about x.
TEST_F(ElastoDynFiles, DeckPutsEverythingInItsPlace) {
  const std::string deck = import_file(path_).deck;
  for (const char* part :
       {R"(<Parameter name="To" value="{0, 0, 20}"/>)",         // tower
        R"(<Parameter name="Position" value="{0, 0, 22}"/>)",   // generator
        R"(<Parameter name="Position" value="{-3, 0, 22}"/>)",  // hub
        R"(<Parameter name="From" value="{-3, -1, 22}"/>)",
        R"(<Parameter name="To" value="{-3, -11, 22}"/>)",
        R"(<Parameter name="From" value="{-3, 1, 22}"/>)",
        R"(<Parameter name="Pre-Twist" value="{-10, 2}" unit="deg"/>)",
        R"(<Parameter name="Inertia" value="{100, 100, 200}"/>)",  // generator, ratio squared
        R"(<Parameter name="Mass" value="30"/>)", R"(<Parameter name="Mass" value="5"/>)",
        R"(<Parameter name="Stiffness" value="1000000"/>)",
        R"(<Parameter name="Node" value="blade 2/last"/>)"}) {
    EXPECT_THAT(deck, HasSubstr(part));
  }
  EXPECT_THAT(deck, Not(HasSubstr("blade 2 station")));  // one file, one set of sections
}

TEST_F(ElastoDynFiles, OlderFilesHaveTheirGravity) {
  const std::string old = "3.7  Gravity  - (m/s^2)\n--- INITIAL CONDITIONS ---";
  write("turbine.dat", change(turbine, "--- INITIAL CONDITIONS ---", old));
  const Imported imported = import_file(path_);
  EXPECT_THAT(imported.deck, HasSubstr(R"(name="Acceleration" value="{0, 0, -3.7}")"));
  EXPECT_THAT(imported.report, Not(HasSubstr("gravity 9.80665")));
}

// With phi = x^2: int EI phi''^2 = 4 EI, int m phi^2 = 24 (1/5) - 12 (1/6) = 2.8 kg/m.
TEST_F(ElastoDynFiles, ReportHasFrequenciesMassesAndAssumptions) {
  const std::string report = import_file(path_).report;
  const double flap = std::sqrt(4.0 * 6e5 / 1e3 / (2.8 * 10.0)) / (2.0 * std::numbers::pi);
  char line[80];
  std::snprintf(line, sizeof line, "blade 1, flap: %.4f Hz; damping 0.01 of the critical one",
                flap);
  EXPECT_THAT(report, HasSubstr(line));
  EXPECT_THAT(report, HasSubstr("tower: 2000 kg, centre 10 m above its base"));
  EXPECT_THAT(report, HasSubstr("mass 180 kg"));
  EXPECT_THAT(report, HasSubstr("rotor 465 kg, head of the tower 1495 kg"));
  EXPECT_THAT(report, HasSubstr("ElastoDyn has no stretch, shear and torsion"));
}

// Flap: 4 EI = 2.4e6, m phi^2 = 2.8 L; edge: EI 8e5. eta = 2 zeta / omega each, bending about y is
// flap.
TEST_F(ElastoDynFiles, EachDirectionHasItsOwnDamping) {
  const std::string deck = import_file(path_).deck;
  const double flap = 2.0 * 0.01 / std::sqrt(4.0 * 6e5 / 1e3 / 28.0);
  const double edge = 2.0 * 0.02 / std::sqrt(4.0 * 8e5 / 1e3 / 28.0);
  const double other = std::min(flap, edge);
  EXPECT_THAT(
      deck,
      HasSubstr(fmt::format(
          R"(<Parameter name="Strain Damping" value="{{{:.12g}, {:.12g}, {:.12g}, {:.12g}, {:.12g}, {:.12g}}}"/>)",
          other, other, other, edge, flap, other)));
  // the tower: twice the stiffness across, hence the smaller factor there, about d1
  const double mass = 2000.0 / 5.0 + 1495.0;  // int m phi^2 over 20 m, and the head
  const double along = 2.0 * 0.01 / std::sqrt(4.0 * 1e8 / 8e3 / mass);
  const double across = along / std::sqrt(2.0);
  EXPECT_THAT(
      deck,
      HasSubstr(fmt::format(
          R"(<Parameter name="Strain Damping" value="{{{:.12g}, {:.12g}, {:.12g}, {:.12g}, {:.12g}, {:.12g}}}"/>)",
          across, across, across, across, along, across)));
}

TEST_F(ElastoDynFiles, SecondModesAreReportedWithWhatTheyGet) {
  std::string more = blade;
  more = change(more, "2    BldEdDmp(1) - (%)", "3    BldFlDmp(2) - (%)\n2    BldEdDmp(1) - (%)");
  for (int k = 2; k <= 6; ++k) {
    more += fmt::format("{} BldFl2Sh({}) - x^{}\n", k == 2 ? 1 : k == 3 ? -1 : 0, k, k);
  }
  write("blade.dat", more);
  EXPECT_THAT(import_file(path_).report, HasSubstr("blade 1, second flap:"));
  EXPECT_THAT(import_file(path_).report, HasSubstr("damping 0.03 in the file, "));
}

constexpr const char* yawing =
    "--- DEGREES OF FREEDOM ---\nTrue YawDOF - Yaw DOF (flag)\n"
    "--- INITIAL CONDITIONS ---";

constexpr const char* servodyn = R"~(--- SERVODYN ---
Our yaw drive
--- NACELLE-YAW CONTROL ---
0     YCMode   - Yaw control mode
90    YawNeut  - Neutral yaw position (degrees)
4E6   YawSpr   - (N-m/rad)
5E4   YawDamp  - (N-m/(rad/s))
)~";

constexpr const char* glue = R"~(--- OpenFAST ---
Our scene
--- FEATURES ---
1         CompElast   - {1=ElastoDyn}
0         CompInflow  - {0=still air; 1=InflowWind}
0         CompAero    - {0=None; 2=AeroDyn}
1         CompServo   - {0=None; 1=ServoDyn}
1         CompHydro   - {0=None; 1=HydroDyn}
1         CompSub     - {0=None; 1=SubDyn}
0         CompMooring - {0=None; 1=MAP++}
0         CompIce     - {0=None; 1=IceFloe}
9.7       Gravity     - (m/s^2)
--- INPUT FILES ---
"turbine.dat"  EDFile      - Name of file
"servo.dat"    ServoFile   - Name of file
"waves.dat"    HydroFile   - Name of file
"jacket.dat"   SubFile     - Name of file
"unused"       MooringFile - Name of file
)~";

TEST_F(ElastoDynFiles, YawIsLockedWhereTheFileSaysSo) {
  const Imported imported = import_file(path_);
  EXPECT_THAT(imported.deck, HasSubstr("Yaw is locked, as YawDOF says."));
  EXPECT_THAT(imported.report, HasSubstr("Yaw is locked, as YawDOF says."));
  EXPECT_THAT(imported.deck, Not(HasSubstr("yaw spring")));
}

TEST_F(ElastoDynFiles, YawWithoutItsSpringIsLockedAloud) {
  write("turbine.dat", change(turbine, "--- INITIAL CONDITIONS ---", yawing));
  const Imported imported = import_file(path_);
  EXPECT_THAT(imported.deck, HasSubstr("Yaw is locked although YawDOF is True"));
  const auto at = imported.report.find("not in these files, and what that does");
  ASSERT_NE(at, std::string::npos);
  EXPECT_THAT(imported.report.substr(at), HasSubstr("Name it by --servodyn"));
}

// The nacelle stands at the neutral angle, 90 degrees from x to y: the hub, 3 m upwind, at -y.
TEST_F(ElastoDynFiles, YawTurnsAgainstTheSpringOfServoDyn) {
  write("turbine.dat", change(turbine, "--- INITIAL CONDITIONS ---", yawing));
  const Imported imported =
      import_file(path_, {.blade = {}, .blade_mass = 0.0, .servodyn = write("yaw.dat", servodyn)});
  for (const char* part : {R"(<ParameterList name="yaw spring">)", R"(value="4000000"/>)",
                           R"(<ParameterList name="yaw damper">)", R"(value="50000"/>)"}) {
    EXPECT_THAT(imported.deck, HasSubstr(part));
  }
  EXPECT_THAT(imported.deck, Not(HasSubstr("Yaw is locked")));
  EXPECT_THAT(imported.deck, HasSubstr("-3, 22}"));
  ASSERT_EQ(imported.variants.size(), 2u);
  EXPECT_EQ(imported.variants.front().name, "yaw locked");
}

TEST_F(ElastoDynFiles, DampersWithMassesOfServoDynAreMissedAloud) {
  const std::string text = std::string(servodyn) +
                           "1        NumNStC  - Number of nacelle structural controllers\n"
                           "\"n.dat\"  NStCfiles - their files\n"
                           "True     CompTTMD - Compute tower tuned mass damper\n";
  const Imported imported =
      import_file(path_, {.blade = {}, .blade_mass = 0.0, .servodyn = write("yaw.dat", text)});
  const auto at = imported.report.find("not in these files, and what that does");
  ASSERT_NE(at, std::string::npos);
  const std::string missed = imported.report.substr(at);
  EXPECT_THAT(missed, HasSubstr("NumNStC = 1: structural controllers"));
  EXPECT_THAT(missed, HasSubstr("CompTTMD: the tuned mass damper is not there"));
  EXPECT_THAT(missed, Not(HasSubstr("NumBStC")));
}

// Rigid: nacelle 500 kg m^2 and hub 100 kg 3 m away, two blades of 180 kg each and 5 kg at a tip,
// on a tower whose GJ is (1e8 + 2e8) / 2.6 over 20 m.
TEST_F(ElastoDynFiles, FrequencyOfYawIsComputed) {
  // along y: m = 24 - 12 x, from 1 m on, int m (1 + 10 x)^2 10 dx
  const double blades =
      2.0 * 10.0 * (24.0 * (1.0 + 10.0 + 100.0 / 3.0) - 12.0 * (0.5 + 20.0 / 3.0 + 25.0)) +
      5.0 * 121.0 + 365.0 * 9.0;
  const double inertia = 500.0 + 100.0 * 9.0 + blades;
  const double torsion = 3e8 / 2.6 / 20.0;
  EXPECT_THAT(import_file(path_).report,
              HasSubstr(fmt::format("{:.4g} Hz with yaw locked",
                                    std::sqrt(torsion / inertia) / (2.0 * std::numbers::pi))));
}

TEST_F(ElastoDynFiles, TheFileOfAllModulesIsFoundOrGiven) {
  write("turbine.dat", change(turbine, "--- INITIAL CONDITIONS ---", yawing));
  write("servo.dat", servodyn);
  const auto all = write("scene.fst", glue);
  for (const auto& path : {path_, all}) {
    const Imported imported = import_file(path);
    EXPECT_THAT(imported.deck, HasSubstr("yaw spring"));
    EXPECT_THAT(imported.deck, HasSubstr("{0, 0, -9.7}"));
    EXPECT_THAT(imported.report,
                HasSubstr("not imported: HydroDyn (waves.dat), SubDyn (jacket.dat)"));
    EXPECT_THAT(imported.deck, HasSubstr("SubDyn (jacket.dat)"));
  }
}

// A leg of the frame is a member of HydroDyn that goes the other way; a brace of HydroDyn has no
// beam.
TEST_F(ElastoDynFiles, TowersStandOnTheMembersOfSubDynInTheWaterOfHydroDyn) {
  write("turbine.dat",
        change(turbine, "20    TowerHt     - (m)", "30.5 TowerHt - (m)\n10.5 TowerBsHt - (m)\n"));
  write("jacket.dat", subdyn_file);
  write("sea.dat", seastate_file);
  std::string water = change(hydrodyn_file, "  1        0.0     0.0   -20.0001   1         0",
                             "  1        5.0     0.0    10.0      1         0");
  water = change(water, "  2        0.0     0.0    10.0      1         0",
                 "  2        5.0     0.0   -20.0      1         0");
  write("waves.dat", water);
  const Imported imported = import_file(write("scene.fst", glue));
  for (const char* part :
       {R"(<Parameter name="Sections" value="{tube 1, tube 2}"/>)",
        R"(<Parameter name="Structure" value="member 2"/>)",
        R"(<Parameter name="Node" value="tower/first"/>)",
        R"(<Parameter name="Master" value="member 1/last"/>)", R"(name="joint 11, held")",
        R"(<Parameter name="Type" value="Irregular Waves"/>)",
        "It stands on the substructure of"}) {
    EXPECT_THAT(imported.deck, HasSubstr(part));
  }
  EXPECT_THAT(imported.deck, Not(HasSubstr("foundation")));
  std::string load = imported.deck.substr(imported.deck.find("water on member 2, member 1"));
  load.resize(load.find("</ParameterList>"));
  std::erase_if(load, [](char c) { return c == ' ' || c == '\n'; });
  // 3 m at the bed, 6 m above the water
  EXPECT_THAT(load, ContainsRegex("Diameters\"value=\"[{]3,[^}]*,6[}]"));
  EXPECT_THAT(imported.report, HasSubstr("member 2 of HydroDyn: 10 m of 10 m lie along no"));
  EXPECT_THAT(imported.report, HasSubstr("0.5 m between the foot of the tower and joint 13"));
  EXPECT_THAT(imported.report, Not(HasSubstr("not imported")));
  write("ground.dat", ground_file);
  write("jacket.dat", on_ground(subdyn_file));
  EXPECT_THAT(import_file(path_of("scene.fst")).deck, HasSubstr("joint 12, ground"));
  // a second beam in the place of a leg
  write("jacket.dat",
        change(subdyn_file, " 6          15        12         2           2         1     -1",
               " 6          12        14         2           2         1     -1"));
  EXPECT_THAT([&] { import_file(path_of("scene.fst")); },
              ThrowsMessage<InputError>(HasSubstr("beams of SubDyn that lie upon each other")));
  write("jacket.dat", change(subdyn_file, "2            NInterf", "0            NInterf"));
  EXPECT_THROW(import_file(path_of("scene.fst")), InputError);
}

TEST_F(ElastoDynFiles, BladesOfBeamDynNeedAFileEach) {
  const std::string scene = change(glue, "1         CompElast", "2 CompElast");
  write("scene.fst", scene + "\"blade1.inp\" BDBldFile(1) - (-)\n");
  EXPECT_THAT([&] { import_file(path_of("scene.fst")); },
              ThrowsMessage<InputError>(HasSubstr("BDBldFile(2): is missing: the turbine has 2")));
}

TEST_F(ElastoDynFiles, AServoDynFileThatIsNotThereIsMissed) {
  write("turbine.dat", change(turbine, "--- INITIAL CONDITIONS ---", yawing));
  write("scene.fst", glue);
  EXPECT_THAT(import_file(path_).report, HasSubstr("servo.dat, which is not there"));
}

TEST_F(ElastoDynFiles, TowersOnAPileSayWhatIsMissing) {
  write("turbine.dat", change(turbine, "20    TowerHt     - (m)",
                              "30 TowerHt - (m)\n10 TowerBsHt - (m)\n-20 PtfmRefzt - (m)"));
  const Imported imported = import_file(path_);
  EXPECT_THAT(imported.deck, HasSubstr("the foot of the tower is at z = 10 m"));
  EXPECT_THAT(imported.deck, HasSubstr(R"(<Parameter name="From" value="{0, 0, 10}"/>)"));
  for (const std::string& text : {imported.deck, imported.report}) {
    EXPECT_THAT(text, HasSubstr("the tower is clamped at its base, z = 10 m"));
    EXPECT_THAT(text, HasSubstr("what is between there and z = -20 m is not in ElastoDyn's files"));
    EXPECT_THAT(text, HasSubstr("if its lowest section went down to z = -20 m"));
  }
}

TEST_F(ElastoDynFiles, PlatformsAreImportedAndHeldAloud) {
  std::string afloat = change(turbine, "--- INITIAL CONDITIONS ---",
                              "True PtfmSgDOF - surge\nTrue PtfmPDOF - pitch\n"
                              "--- INITIAL CONDITIONS ---");
  afloat = change(afloat, "--- BLADE ---",
                  "4E5 PtfmMass - (kg)\n1E8 PtfmRIner - (kg m^2)\n2E8 PtfmPIner - (kg m^2)\n"
                  "3E8 PtfmYIner - (kg m^2)\n-8 PtfmCMzt - (m)\n--- BLADE ---");
  write("turbine.dat", afloat);
  const Imported imported = import_file(path_);
  for (const char* part :
       {R"(<ParameterList name="platform">)", R"(<Parameter name="Mass" value="400000"/>)",
        R"(<Parameter name="Centre" value="{0, 0, -8}"/>)",
        R"(<Parameter name="Inertia" value="{100000000, 200000000, 300000000}"/>)",
        R"(<Parameter name="Node" value="platform"/>)"}) {
    EXPECT_THAT(imported.deck, HasSubstr(part));
  }
  EXPECT_THAT(imported.report, HasSubstr("the platform moves in surge, pitch: held here"));
  EXPECT_THAT(imported.report, HasSubstr("Hz on the platform of 400000 kg afloat"));
}

TEST_F(ElastoDynFiles, PlatformsThatWeighResistTurns) {
  write("turbine.dat", change(turbine, "--- BLADE ---",
                              "4E5 PtfmMass - (kg)\n1E8 PtfmRIner - (kg m^2)\n--- BLADE ---"));
  try {
    import_file(path_);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("PtfmMass: is 400000 kg, so that PtfmPIner must be above 0"));
  }
}

TEST_F(ElastoDynFiles, TowersOnTheGroundLeaveNothingOut) {
  EXPECT_THAT(import_file(path_).report, Not(HasSubstr("not in these files")));
}

TEST_F(ElastoDynFiles, BladesCanBeScaledToTheirMass) {
  const Imported imported = import_file(path_, {.blade = {}, .blade_mass = 360.0, .servodyn = {}});
  EXPECT_THAT(imported.report, HasSubstr("blade 1: masses times 2, for 360 kg"));
  EXPECT_THAT(imported.deck, HasSubstr(R"(<Parameter name="rhoA" value="48"/>)"));
}

TEST_F(ElastoDynFiles, MistakesAreNamedWithTheirPlace) {
  EXPECT_THAT(message_of("turbine.dat", change(turbine, "11    TipRad", "0.5   TipRad")),
              EndsWith("turbine.dat:11: TipRad: must be above HubRad, 1, got 0.5"));
  EXPECT_THAT(message_of("turbine.dat", change(turbine, "20    TowerHt", "-1    TowerHt")),
              EndsWith("TowerHt: must be above TowerBsHt, 0, got -1"));
  EXPECT_THAT(message_of("turbine.dat", change(turbine, "2     NumBl", "4     NumBl")),
              EndsWith("turbine.dat:10: NumBl: must be 1, 2 or 3, got 4"));
  EXPECT_THAT(message_of("turbine.dat", change(turbine, "False Furling", "True  Furling")),
              EndsWith("Furling: furling turbines cannot be imported"));
  EXPECT_THAT(message_of("turbine.dat", change(turbine, "100   HubMass", "heavy HubMass")),
              EndsWith("HubMass: must be a number, got 'heavy'"));
  write("turbine.dat", turbine);
  EXPECT_THAT(message_of("blade.dat", change(blade, "  1.0     -2 ", "  0.9     -2 ")),
              EndsWith("blade.dat:15: BlFract: places must rise from 0 to 1, got 0.9"));
  EXPECT_THAT(message_of("blade.dat", change(blade, "FlpStff EdgStff\n", "FlapStiff EdgStff\n")),
              EndsWith("has no column 'FlpStff'"));
  EXPECT_THAT(message_of("blade.dat", change(blade, "2    NBlInpSt", "3    NBlInpSt")),
              HasSubstr("blade.dat:4: NBlInpSt: announces 3 lines (at least 2), but below "));
  write("blade.dat", blade);
  EXPECT_THAT(
      message_of("tower.dat", change(tower, "  1       100       1E8", "  1       100      -1E8")),
      EndsWith("tower.dat:15: TwFAStif: must be positive, got -1e+08"));
}

TEST_F(ElastoDynFiles, UnknownEntriesAreReported) {
  write("turbine.dat",
        change(turbine, "30    YawBrMass", "7     Warp        - new\n30    YawBrMass"));
  EXPECT_THAT(import_file(path_).report,
              HasSubstr("turbine.dat:33: Warp: unknown entry, left out: '7'"));
}

TEST_F(ElastoDynFiles, PartsAndOptionsWithoutATurbineAreRefused) {
  EXPECT_THROW(import_file(write("blade.dat", blade)), InputError);
  EXPECT_THROW(import_file(write("a.dat", "1\n2\n3 kp_total - x"),
                           {.blade = {}, .blade_mass = 1.0, .servodyn = {}}),
               UsageError);
}

}  // namespace
}  // namespace culm::openfast
