#include <culm/base/error.hpp>
#include <culm/openfast/hydrodyn.hpp>
#include <culm/openfast/import.hpp>
#include <culm/openfast/moordyn.hpp>
#include <culm/openfast/subdyn.hpp>

#include "offshore_files.hpp"
#include "sample_files.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <numbers>
#include <random>
#include <set>
#include <sstream>
#include <vector>

namespace culm::openfast {
namespace {

using testing::HasSubstr;
using testing::Not;

class OffshoreFiles : public SampleFiles {
 protected:
  OffshoreFiles() { write("sea.dat", seastate_file); }

  Imported import(const std::string& text) const { return import_file(write("given.dat", text)); }
  std::string message_of(const std::string& text) const {
    try {
      import(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
};

double tube_area(double d, double t) { return std::numbers::pi * t * (d - t); }

TEST_F(OffshoreFiles, MembersOfSubDynBecomeBeamsJoinedAtTheirJoints) {
  const Imported imported = import(subdyn_file);
  for (const std::string& part :
       {parameter("Sections", "{tube 1, tube 2}"), parameter("To", "{-5, 0, 10}"),
        parameter("EI1", "2000000000"), parameter("EI2", "4000000000"),
        parameter("GA1", "4000000000"), parameter("Damping", "0.004"),
        parameter("Up", "{0, -1, 0}"),  // of the brace along x: horizontal, to its right
        parameter("Inertia", "{100000, 200000, 300000, 0, 0, 0}"), parameter("Centre", "{0, 0, 2}"),
        parameter("Type", "Spherical Joint"), parameter("Node", "member 1/first"),
        parameter("Type", "Weld")}) {
    EXPECT_THAT(imported.deck, HasSubstr(part));
  }
  // joint 12 is held at a point, joint 11 rigidly
  EXPECT_THAT(imported.deck, HasSubstr("<ParameterList name=\"joint 12, held, z\">"));
  EXPECT_THAT(imported.deck, Not(HasSubstr("joint 12, held, about")));
  EXPECT_THAT(imported.report, HasSubstr("member 5: a cable becomes a spring"));
}

// An anchor at (5, 8, -30), to which a cable leads from the top of the frame.
TEST_F(OffshoreFiles, CablesOfSubDynMayEndAtFixedPlaces) {
  std::string text = change(subdyn_file, "5            NJoints", "6            NJoints");
  text = change(
      text, " 15        5.0       8.0       10.0       4         0         0         0         0\n",
      " 15        5.0       8.0       10.0       4         0         0         0         0\n"
      " 16        5.0       8.0      -30.0       1         0         0         0         0\n");
  text = change(text, "2            NReact", "3            NReact");
  text = change(text, " 12        1        1        1        0        0        0       \"\"\n",
                " 12        1        1        1        0        0        0       \"\"\n"
                " 16        1        1        1        1        1        1       \"\"\n");
  text = change(text, "6            NMembers", "7            NMembers");
  text = change(text, " 6          15        12         2           2         1     -1\n",
                " 6          15        12         2           2         1     -1\n"
                " 7          16        13         9           9         2     -1\n");
  const Imported imported = import(text);
  std::string cable = imported.deck.substr(imported.deck.find(R"("member 7")"));
  cable.resize(cable.find("</ParameterList>"));
  EXPECT_THAT(cable, HasSubstr(parameter("Type", "Ground Spring")));
  EXPECT_THAT(cable, HasSubstr(parameter("Anchor", "{5, 8, -30}")));
  EXPECT_THAT(cable, HasSubstr(parameter("Node", "member 1/last")));
  EXPECT_THAT(imported.deck, Not(HasSubstr("joint 16")));
  EXPECT_THAT(message_of(change(text, " 16        1        1        1 ",
                                " 16        1        1        0 ")),
              HasSubstr("joint 16: no beam and no mass is there"));
}

TEST_F(OffshoreFiles, MassesOfSubDynAreThoseOfItsTables) {
  Report report;
  const SubDyn sub = read_subdyn(write("sub.dat", subdyn_file), report);
  const double a = tube_area(2.0, 0.04), b = tube_area(1.0, 0.02);
  EXPECT_DOUBLE_EQ(mass_of(sub, sub.members[0]), 7850.0 * 0.5 * (a + b) * 30.0);
  EXPECT_DOUBLE_EQ(mass_of(sub, sub.members[1]), 7850.0 * a * 30.0);
  EXPECT_DOUBLE_EQ(mass_of(sub, sub.members[2]), 8000.0 * 0.1 * 10.0);
  EXPECT_DOUBLE_EQ(mass_of(sub, sub.members[4]), 10.0 * std::sqrt(164.0));
}

// SubDyn's own summary of the OC3 monopile has 5.000841E-01 for 6 m by 60 mm.
TEST_F(OffshoreFiles, GroundOfSubDynResistsAndGoesWithItsJoint) {
  write("ground.dat", ground_file);
  const auto path = write("frame.dat", on_ground(subdyn_file));
  const Imported soft = import_file(path);
  std::string ground = soft.deck.substr(soft.deck.find(R"("joint 12, ground")"));
  ground.resize(ground.find("</ParameterList>"));
  std::erase_if(ground, [](char c) { return c == ' ' || c == '\n'; });
  EXPECT_THAT(ground, HasSubstr("{100000000,0,0,0,-400000000,0,200000000,0,500000000,0,0,300000000,"
                                "0,0,0,6000000000,0,0,7000000000,0,8000000000}"));
  EXPECT_THAT(soft.deck, Not(HasSubstr("joint 12, held")));
  EXPECT_THAT(soft.deck, HasSubstr(R"(<Parameter name="Centre" value="{0, 0, -1}"/>)"));
  EXPECT_THAT(soft.deck, HasSubstr("{2000, 2000, 4000, 0, 0, 0}"));
  EXPECT_THAT(soft.report, HasSubstr("zero, for they are not there: Ktxty, "));

  write("ground.dat", change(ground_file, "1000 Mzz", "2000 Mzz"));
  EXPECT_THAT(import_file(path).report, HasSubstr("along x 1000 kg, is not that of a body"));
  const auto message = [&](const std::string& old, const std::string& by) -> std::string {
    write("ground.dat", change(ground_file, old, by));
    try {
      import_file(path);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message("1e8  Kxx", "lots Kxx"), HasSubstr("ground.dat:2: Kxx: must be a number"));
  EXPECT_THAT(message("1e8  Kxx", "1e8 Kxq"), HasSubstr("must have the name of its entry"));
  EXPECT_THAT(message("2e8  kyy", "2e8 Kxx"),
              HasSubstr("ground.dat:3: Kxx: stands in line 2, too"));
  write("ground.dat", "Nothing\n");
  EXPECT_THROW(import_file(path), InputError);
}

TEST_F(OffshoreFiles, ShearFactorsAreThoseOfSubDyn) {
  const std::string text = change(subdyn_file, " 1         2.1e11   8.08e10   7850     2.0    0.04",
                                  " 1         2.1e11   8.08e10   8500     6.0    0.06");
  EXPECT_THAT(import(text).deck, HasSubstr("<Parameter name=\"Shear Factor\" value=\"{0.500084"));
}

TEST_F(OffshoreFiles, SeasHaveHeightPeriodHeadingAndCurrent) {
  const Imported imported = import(seastate_file);
  for (const std::string& part :
       {parameter("Type", "Irregular Waves"), parameter("Height", "6"), parameter("Period", "10"),
        parameter("Direction", "{0.866025403784, 0.5, 0}"), parameter("Stretching", "Wheeler"),
        parameter("Lowest", "0.0250000585"), parameter("Speed", "0.5"), parameter("Depth", "20")}) {
    EXPECT_THAT(imported.deck, HasSubstr(part.substr(0, part.size() - 4)));
  }
  EXPECT_THAT(imported.deck, Not(HasSubstr("\"Peak\"")));
  const std::string spread =
      change(seastate_file, "0         WaveDirMod - Spreading",
             "1 WaveDirMod - on\n3 WaveDirSpread - s\n180 WaveDirRange - degrees");
  EXPECT_THAT(import(spread).deck, HasSubstr(parameter("Spreading", "6")));
  EXPECT_THAT(import(spread).deck, HasSubstr("\"Spreading Range\" value=\"3.14159265"));
  const std::string regular = change(seastate_file, "2         WaveMod", "1P90      WaveMod");
  EXPECT_THAT(import(regular).deck, HasSubstr(parameter("Phase", "-1.57079632679")));
  EXPECT_THAT(
      message_of(change(seastate_file, "2         WaveMod", "5         WaveMod")),
      HasSubstr("'5' is not imported (allowed: 0 still water, 1 or 1P# regular, 2 JONSWAP)"));
}

TEST_F(OffshoreFiles, DefaultsOfASeaComeFromTheFileThatNamesIt) {
  const std::string text = change(seastate_file, "20        WtrDpth", "\"default\" WtrDpth");
  EXPECT_THAT(message_of(text), HasSubstr("WtrDpth: is left to the file that names this one"));
  write("whole.fst",
        "--- a ---\nwhole\n\"given.dat\" SeaStFile - file\n9.8 Gravity - g\n"
        "33 WtrDpth - depth\n2 MSL2SWL - level\n");
  EXPECT_THAT(import(text).deck, HasSubstr(parameter("Depth", "33")));
  EXPECT_THAT(import(text).deck, HasSubstr(parameter("Gravity", "9.8")));
}

TEST_F(OffshoreFiles, MembersOfHydroDynHaveTheirCoefficientsAlongTheirLength) {
  const Imported imported = import(hydrodyn_file);
  // growth from -15 to -2 m, coefficients linear from 0 to 10 m of depth, with growth there
  for (const std::string& part :
       {std::string("6, 5.49999166669, 5.49999166669, 4.99999333336"),
        std::string("0.9, 0.9, 1.4, 1.4, 1.08, 0.74"), parameter("Growth Density", "1325"),
        parameter("Flooded Diameter", "2.9"), parameter("End Drag", "0.3"),
        parameter("End Added Mass", "1"), parameter("Drags", "{0.5, 0.8}"),
        parameter("Dry Ends", "{first}")}) {
    EXPECT_THAT(imported.deck, HasSubstr(part));
  }
  EXPECT_THAT(imported.deck, HasSubstr("<Parameter name=\"Range\" value=\"{3.33"));
  EXPECT_THAT(imported.report,
              HasSubstr("member 3: is left to potential flow, and not in the deck"));
  EXPECT_THAT(imported.deck, Not(HasSubstr("name=\"member 3\"")));
}

// Rows are axes: of the brace along x, turned about it.
TEST_F(OffshoreFiles, MatricesOfDirectionsTurnSections) {
  std::string text = change(subdyn_file, "0            NCOSMs", "1            NCOSMs");
  text = change(text, "7           7         4     -1", "7           7         4      5");
  const std::string last =
      "COSM31    COSM32    COSM33\n"
      " (-)       (-)       (-)       (-)       (-)       (-)       (-)       "
      "(-)       (-)       (-)\n";
  const std::string turned = change(text, last, last + " 5  0 0.8 0.6  0 -0.6 0.8  1 0 0\n");
  EXPECT_THAT(import(turned).deck, HasSubstr(parameter("Up", "{0, 0.8, 0.6}")));
  EXPECT_THAT(message_of(change(text, last, last + " 5  0.8 0 0.6  0 1 0  -0.6 0 0.8\n")),
              HasSubstr("the first row of its matrix must be across the member"));
}

TEST_F(OffshoreFiles, WhatHydroDynDoesWithFacesIsTold) {
  const Imported imported =
      import(change(hydrodyn_file, "  2       0.6    1.0    1.0      0      0.0      1.0",
                    "  2       0.6    1.0    1.0      1      0.0      0.3"));
  EXPECT_THAT(imported.report, HasSubstr("AxFDMod = 1: the drag of faces is that of 0"));
  EXPECT_THAT(imported.report, HasSubstr("AxFDLoFSc = 0.3: the drag of faces is that of 1"));
  EXPECT_THAT(imported.report, Not(HasSubstr("AxVnCOff")));
  const std::string pressed =
      change(hydrodyn_file, "  1       0.0    0.0    1.0 ", "  1       0.0    0.0    0.0 ");
  EXPECT_THAT(import(pressed).report, HasSubstr("AxCp: pressure of waves on faces counts fully"));
}

TEST_F(OffshoreFiles, WhatNobodyKnowsIsTold) {
  EXPECT_THAT(import(hydrodyn_file).report, Not(HasSubstr("unknown entry")));
  const std::string text =
      change(hydrodyn_file, "---- OUTPUT ----", "7         MyOption - Own\n---- OUTPUT ----");
  EXPECT_THAT(import(text).report, HasSubstr("MyOption: unknown entry, left out: '7'"));
  const std::string dry = change(hydrodyn_file, "0.5       3        1 ", "0.5       3        0 ");
  EXPECT_THAT(import(dry).report, HasSubstr("MHstLMod = 0: with the pressure of still water"));
}

TEST_F(OffshoreFiles, DepthsAreHeights) {
  EXPECT_THAT(message_of(change(hydrodyn_file, "-10.0  0.9", "10.0  0.9")),
              HasSubstr("Dpth: must be below the one before, 0"));
}

TEST_F(OffshoreFiles, FacesHaveWhatOtherMembersLeaveOfThem) {
  std::string text = hydrodyn_file;
  text = change(text, "6         NJoints", "7         NJoints");
  text = change(text, "  5       30.0     0.0   -15.0      1         0",
                "  7       10.0    12.0     4.0      1         0\n"
                "  5       30.0     0.0   -15.0      1         0");
  text = change(text, "3         NMembers", "4         NMembers");
  text = change(text, "  3          5         6         1 ",
                "  4          4         7         1           1         0.5       1        1     "
                "FALSE\n  3          5         6         1 ");
  // 3 m thick before 6 m
  const Imported imported = import(text);
  EXPECT_THAT(imported.deck, HasSubstr(parameter("End Drags", "{0.3, 0}")));
  EXPECT_THAT(imported.deck, HasSubstr(parameter("End Added Masses", "{1, 0}")));
  EXPECT_THAT(imported.deck, HasSubstr(parameter("End Drags", "{0.225, 0}")));
  EXPECT_THAT(imported.deck, HasSubstr(parameter("End Added Masses", "{0.875, 0}")));
}

// As where a tower begins a millimetre above its base.
TEST_F(OffshoreFiles, SlicesHaveNoWater) {
  std::string text = hydrodyn_file;
  text = change(text, "6         NJoints", "8         NJoints");
  text = change(text, "  5       30.0     0.0   -15.0      1         0",
                "  7       10.0     6.006  -3.992    1         0\n"
                "  8       10.0    12.0     4.0      1         0\n"
                "  5       30.0     0.0   -15.0      1         0");
  text = change(text, "3         NMembers", "5         NMembers");
  text = change(text, "  3          5         6         1 ",
                "  4          4         7         2           2         0.5       1        1     "
                "FALSE\n"
                "  5          7         8         2           2         0.5       1        1     "
                "FALSE\n  3          5         6         1 ");
  const Imported imported = import(text);
  EXPECT_THAT(imported.report, HasSubstr("member 4: is a slice of less than a hundredth"));
  EXPECT_THAT(imported.deck, HasSubstr("\"member 5\""));
}

TEST_F(OffshoreFiles, LinesOfMoorDynLeadFromAnchorsToTheVessel) {
  const Imported imported = import(moordyn_file);
  const double chain = (120.0 - 1025.0 * 0.25 * std::numbers::pi * 0.0064) * 9.81;
  Report report;
  const MoorDyn file = read_moordyn(write("lines.dat", moordyn_file), report);
  EXPECT_DOUBLE_EQ(wet_weight(file, file.types[0]), chain);
  for (const std::string& part :
       {parameter("Anchor", "{400, 0, -200}"), parameter("Offset", "{20, 0, -14}"),
        parameter("Anchor", "{-400, 0, -200}"), parameter("Offset", "{-20, 0, -14}"),
        parameter("Length", "436"), parameter("EA", "200000000")}) {
    EXPECT_THAT(imported.deck, HasSubstr(part));
  }
  EXPECT_THAT(import(old_moordyn_file).deck, HasSubstr(parameter("Offset", "{40.868, 0, -14}")));
}

TEST_F(OffshoreFiles, WhatHasNoCounterpartIsNamed) {
  const std::string body = change(moordyn_file, "4      Coupled ", "4      Body1   ");
  EXPECT_THAT(import(body).report, HasSubstr("point 4 is 'body1'"));
  const std::string bodies =
      change(moordyn_file, "------ POINTS",
             "------ BODIES ------\nID Type\n(-) (-)\n1 free\n------ POINTS");
  EXPECT_THAT(import(bodies).report, HasSubstr("1 lines below BODIES are not in the deck"));
}

// As in files of the reference turbines of 10, 15 and 22 MW: optional columns end early, and names
// are those of OpenFAST 4 or misspelt.
TEST_F(OffshoreFiles, FilesOfOtherYearsSayTheSame) {
  std::string sub = subdyn_file;
  for (const auto& [old, other] : std::vector<std::pair<std::string, std::string>>{
           {" 11        1        1        1        1        1        1       \"\"",
            " 11        1        1        1        1        1        1"},
           {"1           2         1     -1\n", "1           2         1\n"},
           {"YoungE   ShearG   MatDens  XsecD", "YoungE   ShearG1   MatDens  XsecD"},
           {"---- ARBITRARY BEAM",
            "---- RECTANGULAR BEAM CROSS-SECTION PROPERTIES ----\n0   NPropSets   - Number\n"
            "PropSetID YoungE ShearG2 MatDens XsecSa XsecSb XsecT\n(-) (-) (-) (-) (-) (-) (-)\n"
            "---- ARBITRARY BEAM"}}) {
    sub = change(sub, old, other);
  }
  EXPECT_EQ(import(sub).deck, import(subdyn_file).deck);
  EXPECT_THAT(message_of(change(sub, "0   NPropSets", "2   NPropSets")),
              HasSubstr("NPropSets: rectangular sections are not imported; must be 0"));

  const std::string heading = "---- SIMPLE HYDRODYNAMIC COEFFICIENTS (model 1) ----";
  std::string hydro = change(hydrodyn_file, "NCoefDpth ", "NCoefDpthCyl ");
  hydro = change(hydro, "NCoefMembers ", "NCoefMembersCyl ");
  hydro = change(hydro, "NPropSets ", "NPropSetsCyl ");
  hydro = change(hydro, "---- DEPTH-BASED",
                 "---- SIMPLE RECTANGULAR-MEMBER HYDRODYNAMIC COEFFICIENTS (model 1) ----\n"
                 "SimplCdA SimplCdAMG\n(-) (-)\n7.0 7.0\n---- DEPTH-BASED");
  for (const char* word : {"CYLINDRICAL-MEMBER HYDRODYNAMIC", "HCYLINDRICAL-MEMBER YDRODYNAMIC"}) {
    const std::string other =
        change(hydro, heading, "---- SIMPLE " + std::string(word) + " COEFFICIENTS (model 1) ----");
    EXPECT_EQ(import(other).deck, import(hydrodyn_file).deck);
  }
}

TEST_F(OffshoreFiles, MistakesHaveTheirPlace) {
  const std::pair<std::string, std::string> cases[] = {
      {change(subdyn_file, " 4          14        15 ", " 4          14        16 "),
       "given.dat:45: member, MJointID2: there is no joint 16 (there are: 11, 12, 13, 14, 15)"},
      {change(subdyn_file, "6            NMembers", "7            NMembers"),
       "member: must be 7 lines, as the file says, found 6"},
      {change(subdyn_file, " 2         2.1e11   8.08e10   7850     1.0    0.02",
              " 2         2.1e11   8.08e10   7850     1.0    0.6"),
       "circular section, XsecT: must be at most half the diameter, 0.5 m, got 0.6 m"},
      {change(moordyn_file, "1       chain       1", "1       chian       1"),
       "unknown line type 'chian' – did you mean 'chain'?"},
      {change(moordyn_file, "435.0      20       -", "435.0      2O       -   x"),
       "line: must have 7 columns, found 8"},
      {change(hydrodyn_file, "  2          3         4         2           2         0.5       3",
              "  2          3         4         2           2         0.5       4"),
       "member, MCoefMod: must be 1, 2 or 3, got 4"}};
  for (const auto& [text, message] : cases) EXPECT_THAT(message_of(text), HasSubstr(message));
}

// What a deck holds: not how much of it is held, which is a number of the file.
std::size_t count_parts(const std::string& deck) {
  std::size_t count = 0;
  for (const char* type : {"Beam", "Rigid Body", "Point Mass", "Spring", "Morison", "Catenary",
                           "Rigid Connection", "Weld", "Spherical Joint", "Power Law", "Tube"}) {
    const std::string text = parameter("Type", type);
    for (std::size_t at = deck.find(text); at != std::string::npos; at = deck.find(text, at + 1)) {
      ++count;
    }
  }
  return count;
}

// Lines of a report that complain.
std::set<std::string> complaints(const std::string& report) {
  std::istringstream lines(report);
  std::set<std::string> found;
  bool complains = false;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  ")) {
      complains =
          line.starts_with("not ") || line.starts_with("unknown") || line.starts_with("assumed");
    } else if (complains) {
      found.insert(line);
    }
  }
  return found;
}

// Files that are cut or have a flipped bit give a message, or a deck that holds all that the whole
// file gives, or says what is not there. CULM_FLIPS=500 flips more of them.
TEST_F(OffshoreFiles, DamageIsNotSilent) {
  const char* wanted = std::getenv("CULM_FLIPS");
  const int flips = wanted != nullptr ? std::stoi(wanted) : 40;
  std::mt19937 generator(1);
  const auto below = [&](std::size_t limit) { return generator() % limit; };
  for (const char* whole :
       {subdyn_file, seastate_file, hydrodyn_file, moordyn_file, old_moordyn_file}) {
    const std::string text = whole;
    const Imported good = import(text);
    const auto judge = [&](const std::string& damaged, const std::string& how) {
      try {
        const Imported made = import(damaged);
        const bool is_whole = count_parts(made.deck) >= count_parts(good.deck);
        const std::set<std::string> known = complaints(good.report), all = complaints(made.report);
        const bool tells = std::any_of(
            all.begin(), all.end(), [&](const std::string& line) { return !known.contains(line); });
        EXPECT_TRUE(is_whole || tells) << text.substr(0, text.find('\n', 40)) << how;
      } catch (const Error& error) {
        EXPECT_STRNE(error.what(), "") << how;
      }
    };
    for (std::size_t percent = 0; percent < 100; percent += 5) {
      judge(text.substr(0, text.size() * percent / 100),
            " cut at " + std::to_string(percent) + " %");
    }
    for (int i = 0; i < flips; ++i) {
      std::string damaged = text;
      const std::size_t place = below(text.size());
      damaged[place] = static_cast<char>(damaged[place] ^ (1 << below(8)));
      judge(damaged, " flipped at " + std::to_string(place));
    }
  }
}

}  // namespace
}  // namespace culm::openfast
