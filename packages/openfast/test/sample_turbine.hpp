/// A turbine with two blades in the formats of ElastoDyn.
#pragma once

namespace culm::openfast {

inline constexpr const char* turbine = R"~(--- ELASTODYN ---
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
inline constexpr const char* blade = R"~(--- BLADE ---
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

inline constexpr const char* tower = R"~(--- TOWER ---
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

}  // namespace culm::openfast
