#include <culm/base/error.hpp>
#include <culm/openfast/elastodyn.hpp>
#include <culm/openfast/import.hpp>

#include "sample_files.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace culm::openfast {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

constexpr const char* turbine = R"~(--- ELASTODYN ---
Our two blades
--- INITIAL CONDITIONS ---
0     BlPitch(1)  - (degrees)
0     BlPitch(2)  - (degrees)
90    Azimuth     - (degrees)
30    RotSpeed    - (rpm)
0     NacYaw      - (degrees)
--- TURBINE CONFIGURATION ---
2     NumBl       - Number of blades
11    TipRad      - (m)
1     HubRad      - (m)
0     PreCone(1)  - (degrees)
0     PreCone(2)  - (degrees)
0.5   HubCM       - (m)
0     UndSling    - (m)
0     Delta3      - (degrees)
-3    OverHang    - (m)
0     ShftTilt    - (degrees)
0.2   NacCMxn     - (m)
0     NacCMyn     - (m)
1     NacCMzn     - (m)
2     Twr2Shft    - (m)
20    TowerHt     - (m)
--- MASS AND INERTIA ---
0     TipMass(1)  - (kg)
5     TipMass(2)  - (kg)
100   HubMass     - (kg)
40    HubIner     - (kg m^2)
2     GenIner     - (kg m^2)
1000  NacMass     - (kg)
500   NacYIner    - (kg m^2)
30    YawBrMass   - (kg)
--- BLADE ---
4     BldNodes    - (-)
"blade.dat" BldFile(1) - (quoted string)
"blade.dat" BldFile(2) - (quoted string)
--- DRIVETRAIN ---
10    GBRatio     - (-)
1E6   DTTorSpr    - (N-m/rad)
1E3   DTTorDmp    - (N-m/(rad/s))
False Furling     - (flag)
--- TOWER ---
"tower.dat" TwrFile - (quoted string)
)~";

// m = 12 - 6 x: 90 kg over 10 m without the factor of 2.
constexpr const char* blade = R"~(--- BLADE ---
Our blade
--- BLADE PARAMETERS ---
2    NBlInpSt    - Number of stations
1    BldFlDmp(1) - (%)
2    BldEdDmp(1) - (%)
--- ADJUSTMENT ---
2    AdjBlMs     - (-)
3    AdjFlSt     - (-)
1    AdjEdSt     - (-)
--- DISTRIBUTED BLADE PROPERTIES ---
 BlFract StrcTwst BMassDen FlpStff EdgStff
  (-)     (deg)    (kg/m)   (Nm^2)  (Nm^2)
  0.0     10        12       2E5     8E5
  1.0     -2        6        2E5     8E5
--- MODE SHAPES ---
1    BldFl1Sh(2) - x^2
0    BldFl1Sh(3) - x^3
0    BldFl1Sh(4) - x^4
0    BldFl1Sh(5) - x^5
0    BldFl1Sh(6) - x^6
1    BldEdgSh(2) - x^2
0    BldEdgSh(3) - x^3
0    BldEdgSh(4) - x^4
0    BldEdgSh(5) - x^5
0    BldEdgSh(6) - x^6
)~";

constexpr const char* tower = R"~(--- TOWER ---
Our tower
--- TOWER PARAMETERS ---
2    NTwInpSt    - Number of stations
1    TwrFADmp(1) - (%)
1    TwrSSDmp(1) - (%)
--- ADJUSTMENT ---
1    AdjTwMa     - (-)
1    AdjFASt     - (-)
1    AdjSSSt     - (-)
--- DISTRIBUTED TOWER PROPERTIES ---
 HtFract TMassDen TwFAStif TwSSStif
  (-)    (kg/m)    (Nm^2)   (Nm^2)
  0       100       1E8      2E8
  1       100       1E8      2E8
--- MODE SHAPES ---
1    TwFAM1Sh(2) - x^2
0    TwFAM1Sh(3) - x^3
0    TwFAM1Sh(4) - x^4
0    TwFAM1Sh(5) - x^5
0    TwFAM1Sh(6) - x^6
1    TwSSM1Sh(2) - x^2
0    TwSSM1Sh(3) - x^3
0    TwSSM1Sh(4) - x^4
0    TwSSM1Sh(5) - x^5
0    TwSSM1Sh(6) - x^6
)~";

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

TEST_F(ElastoDynFiles, BladesCanBeScaledToTheirMass) {
  const Imported imported = import_file(path_, {.blade = {}, .blade_mass = 360.0});
  EXPECT_THAT(imported.report, HasSubstr("blade 1: masses times 2, for 360 kg"));
  EXPECT_THAT(imported.deck, HasSubstr(R"(<Parameter name="rhoA" value="48"/>)"));
}

TEST_F(ElastoDynFiles, MistakesAreNamedWithTheirPlace) {
  EXPECT_THAT(message_of("turbine.dat", change(turbine, "11    TipRad", "0.5   TipRad")),
              EndsWith("turbine.dat:11: TipRad: must be above HubRad, 1, got 0.5"));
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
  EXPECT_THROW(
      import_file(write("a.dat", "1\n2\n3 kp_total - x"), {.blade = {}, .blade_mass = 1.0}),
      UsageError);
}

}  // namespace
}  // namespace culm::openfast
