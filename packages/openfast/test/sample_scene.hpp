/// The turbine in the wind: files of AeroDyn and InflowWind, and the one that names all.
#pragma once

#include "sample_turbine.hpp"

#include <map>
#include <string>

namespace culm::openfast {

inline constexpr const char* scene = R"~(--- OpenFAST ---
Our scene
--- SIMULATION CONTROL ---
12    TMax       - Total run time (s)
--- FEATURE SWITCHES AND FLAGS ---
1     CompElast  - (switch)
1     CompInflow - (switch)
2     CompAero   - (switch)
0     CompServo  - (switch)
0     CompHydro  - (switch)
0     CompSub    - (switch)
0     CompMooring - (switch)
0     CompIce    - (switch)
--- ENVIRONMENTAL CONDITIONS ---
9.81  Gravity    - (m/s^2)
1.2   AirDens    - (kg/m^3)
--- INPUT FILES ---
"turbine.dat" EDFile     - (quoted string)
"wind.dat"    InflowFile - (quoted string)
"aero.dat"    AeroFile   - (quoted string)
)~";

// Names of keywords of one year; older ones are put in their place.
inline constexpr const char* aero = R"~(------- AERODYN -------
Our air
======  General Options  ======
"default"  DTAero    - (s)
2          Wake_Mod  - Type of wake
0          TwrPotent - (switch)
False      TwrShadow - (flag)
True       TwrAero   - (flag)
======  Environmental Conditions  ======
"default"  AirDens   - (kg/m^3)
======  Blade-Element/Momentum Theory Options  ======
--- Skew correction
1          Skew_Mod  - (switch)
default    SkewRedistr_Mod - (switch)
True       TipLoss   - (flag)
False      HubLoss   - (flag)
True       TanInd    - (flag)
False      AIDrag    - (flag)
False      TIDrag    - (flag)
======  Unsteady Airfoil Aerodynamics Options  ======
4          UA_Mod    - (switch)
======  Airfoil Information ======
1          AFTabMod   - (-)
1          InCol_Alfa - (-)
3          InCol_Cl   - (-)
2          InCol_Cd   - (-)
4          InCol_Cm   - (-)
2          NumAFfiles - (-)
"foils\round.dat" AFNames - Airfoil file names
"foils/wing.dat"
======  Rotor/Blade Properties  ======
True       UseBlCm    - (flag)
"aero_blade.dat" ADBlFile(1) - (-)
"aero_blade.dat" ADBlFile(2) - (-)
======  Tower Influence and Aerodynamics ======
3          NumTwrNds  - (-)
TwrElev TwrDiam TwrCd TwrTI (used only with TwrShadow=2)
(m) (m) (-) (-)
0   2.0 0.5 0.1
10  1.5 0.5 0.1
25  1.0 0.7 0.1
======  Outputs  ======
          OutList - The next line(s)
"RtSpeed"
END of input file
)~";

// A quarter chord that lies 0.1 chords in front of the axis at the tip, in the turned section.
inline constexpr const char* aero_blade = R"~(------- AERODYN BLADE -------
Our blade
======  Blade Properties ======
3   NumBlNds - Number of blade nodes
 BlSpn BlCrvAC   BlSwpAC BlCrvAng BlTwist BlChord BlAFID
 (m)   (m)       (m)     (deg)    (deg)   (m)     (-)
 0     0         0       0        10      2       1
 4     0         0       0        7       1.5     2
 10    0         0       0        0       1       2
)~";

inline constexpr const char* airfoil = R"~(! ------------ AirfoilInfo v1.01.x Input File ------
! a wing
"DEFAULT"   InterpOrd  ! Interpolation order
@"wing_coords.txt" NumCoords ! The number of coordinates
2           NumTabs    ! Number of airfoil tables in this file.
! data for table 1
0.75        Re         ! Reynolds number in millions
True        InclUAdata ! Is unsteady aerodynamics data included
-4          alpha0     ! 0-lift angle
0.2         A1         ! Constant
5           NumAlf     ! Number of data lines
!    Alpha  Cd  Cl  Cm
  -180  0.1   0.0  0
  -90   1.2   0.0  0.1   ! a comment
  ! between rows
  0     0.01  0.4  -0.05
  90    1.2   0.1  -0.3
  180   0.1   0.0  0
! data for table 2
3           Re         ! Reynolds number in millions
2           NumAlf     ! Number of data lines
  -180  0.1  0.0  0
  180   0.1  0.0  0
)~";

inline constexpr const char* wind = R"~(------- InflowWind INPUT FILE -------
Our wind
-------------------------------------
1   WindType       - switch for wind file type
90  PropagationDir - Direction of wind propagation
0   NWindVel       - Number of points
====== Parameters for Steady Wind Conditions [used only for WindType = 1] ======
8   HWindSpeed - (m/s)
20  RefHt      - (m)
0.2 PLexp      - (-)
====== Parameters for Uniform wind file   [used only for WindType = 2] ======
"gust.wnd" Filename - (-)
22  RefHt      - (m)
20  RefLength  - (-)
====== Parameters for Binary TurbSim Full-Field files   [used only for WindType = 3] ======
"box.bts" Filename - (.bts)
====== Parameters for Binary Bladed-style Full-Field files   [used only for WindType = 4 or WindType = 7] ======
"style" FilenameRoot - root of .wnd and .sum, or the file with the scaling
False   TowerFile    - (flag)
====== Parameters for HAWC-format binary files  [Only used with WindType = 5] ======
"mann_u.bin" FileName_u - along
"mann_v.bin" FileName_v - across
"mann_w.bin" FileName_w - upwards
4   nx         - (-)
3   ny         - (-)
2   nz         - (-)
5   dx         - (m)
10  dy         - (m)
20  dz         - (m)
25  RefHt_Hawc - (m)
  -------------   Scaling parameters for turbulence   ------
1   ScaleMethod - (0 = none, 1 = direct scaling, 2 = by a standard deviation)
1.5 SFx         - (-)
0.7 SFy         - (-)
0.5 SFz         - (-)
2.5 SigmaFx     - (m/s)
2   SigmaFy     - (m/s)
1   SigmaFz     - (m/s)
  -------------   Mean wind profile parameters (added to HAWC-format files)   ------
13  URef        - (m/s)
2   WindProfile - (0=constant;1=logarithmic,2=power law)
0.1 PLExp_Hawc  - (-)
0.03 Z0         - (m)
6.5 XOffset     - (m)
====== OUTPUT ======
)~";

/// All files of the scene by their names.
inline std::map<std::string, std::string> scene_files() {
  return {{"turbine.dat", turbine},       {"blade.dat", blade}, {"tower.dat", tower},
          {"aero_blade.dat", aero_blade}, {"wind.dat", wind},   {"foils/wing.dat", airfoil},
          {"foils/round.dat", airfoil},   {"aero.dat", aero},   {"scene.fst", scene}};
}

}  // namespace culm::openfast
