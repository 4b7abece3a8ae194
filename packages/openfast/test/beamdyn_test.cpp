#include <culm/base/error.hpp>
#include <culm/openfast/beamdyn.hpp>
#include <culm/openfast/import.hpp>

#include "sample_files.hpp"

#include <gmock/gmock.h>

#include <numbers>

namespace culm::openfast {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* primary = R"~(--- BEAMDYN ---
Our blade
--- SIMULATION CONTROL ---
False   Echo          - (flag)
0.5     rhoinf        - numerics
--- GEOMETRY PARAMETER ---
1       member_total  - Total number of members (-)
3       kp_total      - Total number of key points (-)
  1  3                - Member number; Number of key points in this member
  kp_xr   kp_yr   kp_zr  initial_twist
   (m)     (m)     (m)     (deg)
   0       0       0       10
   0       0       4       6
   0       0      10       0
--- MESH PARAMETER ---
5       order_elem    - Order (-)
--- MATERIAL PARAMETER ---
"blade.inp"  BldFile  - Name (quoted string)
)~";

// Two stations; the mass centre of the first is at (0.1, 0.2).
constexpr const char* beamdyn_blade = R"~(--- BEAMDYN BLADE ---
Our sections
--- Blade Parameters ---
2     station_total - Number of stations (-)
1     damp_type     - Damping type
--- DAMPING COEFFICIENT ---
  mu1 mu2 mu3 mu4 mu5 mu6
  (-) (-) (-) (-) (-) (-)
  1E-3 1E-3 1E-3 2E-3 3E-3 4E-3
--- DISTRIBUTED PROPERTIES ---
 0.0
  1E6 0 0 0 0 0
  0 2E6 0 0 0 0
  0 0 9E6 0 0 0
  0 0 0 5E5 0 0
  0 0 0 0 4E5 1E4
  0 0 0 0 1E4 3E5

  30  0  0  0  0 -6
   0 30  0  0  0  3
   0  0 30  6 -3  0
   0  0  6 18 -1  0
   0  0 -3 -1 12  0
  -6  3  0  0  0 30

 1.0
  1E5 0 0 0 0 0
  0 2E5 0 0 0 0
  0 0 9E5 0 0 0
  0 0 0 5E4 0 0
  0 0 0 0 4E4 0
  0 0 0 0 0 3E4

  10  0  0  0  0  0
   0 10  0  0  0  0
   0  0 10  0  0  0
   0  0  0  2  0  0
   0  0  0  0  1  0
   0  0  0  0  0  3
)~";

constexpr const char* driver = R"~(--- DRIVER ---
Our case
--- SIMULATION CONTROL ---
True   DynamicSolve - (flag)
0      t_initial    - (s)
2      t_final      - (s)
0.01   dt           - (s)
--- GRAVITY ---
0      Gx           - (m/s^2)
0      Gy           - (m/s^2)
-9.8   Gz           - (m/s^2)
--- FRAME ---
0      GlbPos(1)    - (m)
1.5    GlbPos(2)    - (m)
0      GlbPos(3)    - (m)
---The matrix
---from space to the root
 1  0  0
 0  0 -1
 0  1  0
--- ROOT VELOCITY ---
0.5    RootVel(4)   - (rad/s)
0      RootVel(5)   - (rad/s)
0      RootVel(6)   - (rad/s)
--- APPLIED FORCE ---
0      DistrLoad(1) - (N/m)
0      DistrLoad(2) - (N/m)
7      DistrLoad(3) - (N/m)
0      DistrLoad(4) - (N-m/m)
0      DistrLoad(5) - (N-m/m)
0      DistrLoad(6) - (N-m/m)
1      TipLoad(1)   - (N)
0      TipLoad(2)   - (N)
0      TipLoad(3)   - (N)
0      TipLoad(4)   - (N-m)
0      TipLoad(5)   - (N-m)
0      TipLoad(6)   - (N-m)
1      NumPointLoads - Number
eta  Fx Fy Fz Mx My Mz
(-) (N) (N) (N) (N-m) (N-m) (N-m)
0.5  0 2 0 0 0 3
--- PRIMARY INPUT FILE ---
"primary.inp" InputFile - Name
)~";

class BeamDynFiles : public SampleFiles {
 protected:
  std::string message_of(const std::string& name) const {
    try {
      import_file(write("last.txt", "").parent_path() / name);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  void write_all() const {
    write("primary.inp", primary);
    write("blade.inp", beamdyn_blade);
    write("driver.inp", driver);
  }
};

TEST_F(BeamDynFiles, PrimaryNamesKeyPointsAndBlade) {
  write_all();
  Report report;
  const BeamDyn beam = read_beamdyn(write("primary.inp", primary), report);
  ASSERT_EQ(beam.key_points.size(), 3U);
  EXPECT_EQ(beam.key_points[1].position, Vec3(0.0, 0.0, 4.0));
  EXPECT_DOUBLE_EQ(beam.key_points[1].twist, 6.0 * std::numbers::pi / 180.0);
  ASSERT_EQ(beam.blade.stations.size(), 2U);
  EXPECT_EQ(beam.blade.stations[0].stiffness(4, 5), 1e4);
  EXPECT_EQ(beam.blade.stations[0].mass(2, 4), -3.0);
  EXPECT_THAT(beam.blade.damping, ElementsAre(1e-3, 1e-3, 1e-3, 2e-3, 3e-3, 4e-3));
}

TEST_F(BeamDynFiles, DriverNamesMotionAndLoads) {
  write_all();
  Report report;
  const BeamDynDriver read = read_beamdyn_driver(write("driver.inp", driver), report);
  EXPECT_TRUE(read.dynamic);
  EXPECT_EQ(read.gravity, Vec3(0.0, 0.0, -9.8));
  // rows of the matrix are the axes of the root
  EXPECT_EQ(read.axes.col(2), Vec3(0.0, 1.0, 0.0));
  EXPECT_EQ(read.angular_velocity, Vec3(0.5, 0.0, 0.0));
  EXPECT_EQ(read.line_force, Vec3(0.0, 0.0, 7.0));
  ASSERT_EQ(read.point_loads.size(), 2U);
  EXPECT_EQ(read.point_loads[1].span, 0.5);
  EXPECT_EQ(read.point_loads[1].moment, Vec3(0.0, 0.0, 3.0));
}

TEST_F(BeamDynFiles, DeckHasSectionsAxisAndMotion) {
  write_all();
  const std::string deck = import_file(write("driver.inp", driver)).deck;
  for (const char* part :
       {R"(<Parameter name="rhoA" value="30"/>)", R"(<Parameter name="rhoS1" value="6"/>)",
        R"(<Parameter name="rhoS2" value="3"/>)", R"(<Parameter name="rhoI12" value="1"/>)",
        R"(<Parameter name="From" value="{0, 1.5, 0}"/>)",
        R"(<Parameter name="To" value="{0, 11.5, 0}"/>)",
        R"(<Parameter name="Pre-Twist" value="{-10, -6, 0}" unit="deg"/>)",
        R"(<Parameter name="Pre-Twist Positions" value="{0, 0.4, 1}"/>)",
        R"(<Parameter name="Strain Damping" value="{0.001, 0.001, 0.001, 0.002, 0.003, 0.004}"/>)",
        R"(<Parameter name="Angle" value="0.5"/>)",
        R"(<Parameter name="Node" value="blade/middle"/>)"}) {
    EXPECT_THAT(deck, HasSubstr(part));
  }
}

// int of 30 - 2 z over 10 m is 200, of z (30 - 2 z) is 2500/3, of z^2 (30 - 2 z) is 5000.
TEST_F(BeamDynFiles, ReportHasMassAndItsMoments) {
  write_all();
  const std::string report = import_file(write("primary.inp", primary)).report;
  EXPECT_THAT(report, HasSubstr("length 10 m, mass 200 kg"));
  EXPECT_THAT(report, HasSubstr("(0, 0, 4.1667) m"));
  EXPECT_THAT(report, HasSubstr("first moment 833.333 kg m, second 5000 kg m^2"));
}

TEST_F(BeamDynFiles, CurvedAxisKeepsTheXAxisOfSectionsFreeOfY) {
  write_all();
  const std::string bent =
      change(change(primary, "   0       0       4       6", "   0.3     0.2     4       0"),
             "   0       0      10       0", "   1.5     1       10      0");
  const std::string deck = import_file(write("primary.inp", bent)).deck;
  EXPECT_THAT(deck, HasSubstr(R"(<Parameter name="Type" value="Spline"/>)"));
  EXPECT_THAT(deck, HasSubstr("0, 0, 0, 0.3, 0.2, 4,"));
  EXPECT_THAT(deck, Not(HasSubstr("{-10, 0, 0}")));  // a small turn makes up for Up = x
}

TEST_F(BeamDynFiles, OldDriversLeaveTheAnalysisToThePrimaryFile) {
  write_all();
  write("primary.inp", change(primary, "0.5     rhoinf        - numerics",
                              "1       analysis_type - 1: Static analysis; 2: Dynamic analysis"));
  const auto path = write("driver.inp", change(driver, "True   DynamicSolve - (flag)\n", ""));
  Report report;
  EXPECT_FALSE(read_beamdyn_driver(path, report).dynamic);
}

TEST_F(BeamDynFiles, OldDriversHaveNoPointLoads) {
  write_all();
  const auto path = write(
      "driver.inp", change(driver,
                           "1      NumPointLoads - Number\neta  Fx Fy Fz Mx My Mz\n(-) (N) (N) (N) "
                           "(N-m) (N-m) (N-m)\n0.5  0 2 0 0 0 3\n",
                           ""));
  Report report;
  EXPECT_EQ(read_beamdyn_driver(path, report).point_loads.size(), 1U);
}

TEST_F(BeamDynFiles, UnknownAndContradictoryEntriesAreReported) {
  write_all();
  write("blade.inp", change(beamdyn_blade, "   0  0  0  0  0  3", "   0  0  0  0  0  4"));
  const auto path =
      write("primary.inp", change(primary, "0.5     rhoinf        - numerics",
                                  "0.5     rhoinf        - numerics\n2   warp  - of tomorrow"));
  const std::string report = import_file(path).report;
  EXPECT_THAT(report, HasSubstr("primary.inp:6: warp: unknown entry, left out: '2'"));
  EXPECT_THAT(report, HasSubstr("station 2, mass: not that of a plane section: entry (6, 6) is 4, "
                                "by the others it is 3, which is taken"));
}

TEST_F(BeamDynFiles, ImpossibleInputIsRefusedWithItsPlace) {
  write_all();
  const auto with_blade = [&](const std::string& old, const std::string& by) {
    write("blade.inp", change(beamdyn_blade, old, by));
    return message_of("primary.inp");
  };
  EXPECT_THAT(with_blade("  0 0 0 0 1E4 3E5", "  0 0 0 0 2E4 3E5"),
              EndsWith("blade.inp:11: station 1, stiffness: must be symmetric, but entries (5, 6) "
                       "and (6, 5) are 10000 and 20000"));
  EXPECT_THAT(with_blade("  0 0 0 5E4 0 0", "  0 0 0 -5E4 0 0"),
              EndsWith("blade.inp:26: station 2, stiffness: must be positive definite, but entry "
                       "(4, 4) is -50000"));
  EXPECT_THAT(
      with_blade("  0 0 0 0 4E5 1E4\n  0 0 0 0 1E4 3E5", "  0 0 0 0 4E5 9E5\n  0 0 0 0 9E5 3E5"),
      HasSubstr("station 1, stiffness: must be positive definite, but the smallest"));
  EXPECT_THAT(
      with_blade("  10  0  0  0  0  0\n   0 10  0  0  0  0\n   0  0 10  0  0  0\n"
                 "   0  0  0  2  0  0\n   0  0  0  0  1  0\n   0  0  0  0  0  3\n",
                 "  0 0 0 0 0 0\n  0 0 0 0 0 0\n  0 0 0 0 0 0\n  0 0 0 0 0 0\n  0 0 0 0 0 0\n  0 0 "
                 "0 0 0 0\n"),
      EndsWith("station 2, mass: must be positive definite, but is zero: put in what the section "
               "has, or as little of it as does no harm"));
  EXPECT_THAT(with_blade("2     station_total", "3     station_total"),
              HasSubstr("blade.inp:4: station_total: announces 3 stations of 13 lines"));
  EXPECT_THAT(with_blade(" 1.0\n", " 0.9\n"),
              EndsWith("station 2: the last place must be 1, got 0.9"));
  write("blade.inp",
        change(change(beamdyn_blade,
                      "  1E5 0 0 0 0 0\n  0 2E5 0 0 0 0\n  0 0 9E5 0 0 0\n  0 0 0 5E4 0 0",
                      "  9E5 0 0 0 0 0\n  0 2E5 0 0 0 0\n  0 0 1E5 0 0 0\n  0 0 0 5E4 0 0"),
               "   0  0  0  2  0  0\n   0  0  0  0  1  0\n   0  0  0  0  0  3",
               "   0  0  0  3  0  0\n   0  0  0  0  1  0\n   0  0  0  0  0  2"));
  EXPECT_THAT(message_of("primary.inp"),
              HasSubstr("station 2, mass: the first axis is along the blade"));
  write("blade.inp", beamdyn_blade);
  write("primary.inp", change(primary, "  1  3    ", "  1  4    "));
  EXPECT_THAT(message_of("primary.inp"), HasSubstr("primary.inp:8: kp_total: contradiction: 3 key "
                                                   "points, but 1 members are announced"));
  EXPECT_THAT(message_of("blade.inp"), HasSubstr("give the primary file"));
  write("any.txt", "nothing");
  EXPECT_THAT(message_of("any.txt"), HasSubstr("not a file that can be imported"));
}

TEST_F(BeamDynFiles, MissingFilesAreNamed) {
  EXPECT_THROW(import_file(write("primary.inp", primary)), FileError);
}

TEST_F(BeamDynFiles, TitlesMayHoldWhatXmlForbids) {
  write_all();
  const auto path = write("primary.inp", change(primary, "Our blade", "A <B> & \"C\" -- D"));
  const std::string deck = import_file(path).deck;
  EXPECT_THAT(deck, HasSubstr("value=\"A &lt;B> &amp; &quot;C&quot; -- D\""));
  EXPECT_THAT(deck, StartsWith("<!-- Shows"));
  EXPECT_EQ(deck.find("-- D'"), std::string::npos);
}

}  // namespace
}  // namespace culm::openfast
