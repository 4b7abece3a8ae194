/// Files of SubDyn, SeaState, HydroDyn and MoorDyn with numbers of our own.
#pragma once

#include <string>

namespace culm::openfast {

// Two legs of a frame with a brace, a cable, a body on top.
inline constexpr const char* subdyn_file = R"~(--------- SubDyn file ---------
A small frame
------ SIMULATION CONTROL ------
False        Echo        - Echo it (flag)
"DEFAULT"    SDdeltaT    - Step
3            IntMethod   - Method
True         SttcSolve   - Static
------ FEA and CRAIG-BAMPTON PARAMETERS ------
3            FEMMod      - Elements
2            NDiv        - Elements of a member
True         CBMod       - Reduction
0            Nmodes      - Modes
0            JDampings   - Damping
1            GuyanDampMod - Damping
0.0, 0.004   RayleighDamp - Two factors
6            GuyanDampSize - Size
---- STRUCTURE JOINTS ----
5            NJoints     - Number of joints (-)
JointID  JointXss  JointYss  JointZss  JointType JointDirX JointDirY JointDirZ JointStiff
 (-)       (m)       (m)       (m)       (-)       (-)       (-)       (-)      (Nm/rad)
 11       -5.0       0.0      -20.0       1         0         0         0         0
 12        5.0       0.0      -20.0       1         0         0         0         0
 13       -5.0       0.0       10.0       1         0         0         0         0
 14        5.0       0.0       10.0       1         0         0         0         0
 15        5.0       8.0       10.0       4         0         0         0         0
---- BASE REACTION JOINTS ----
2            NReact      - Number of joints
RJointID RctTDXss RctTDYss RctTDZss RctRDXss RctRDYss RctRDZss SSIfile
  (-)     (flag)   (flag)   (flag)   (flag)   (flag)   (flag)  (string)
 11        1        1        1        1        1        1       ""
 12        1        1        1        0        0        0       ""
---- INTERFACE JOINTS ----
2            NInterf     - Number of joints
IJointID ItfTDXss ItfTDYss ItfTDZss ItfRDXss ItfRDYss ItfRDZss
  (-)     (flag)   (flag)   (flag)   (flag)   (flag)   (flag)
 13        1        1        1        1        1        1
 14        1        1        1        1        1        1
---- MEMBERS ----
6            NMembers    - Number of members (-)
MemberID MJointID1 MJointID2 MPropSetID1 MPropSetID2 MType COSMID
  (-)       (-)       (-)       (-)         (-)       (-)    (-)
 1          11        13         1           2         1     -1
 2          12        14         1           1         1     -1
 3          13        14         7           7         4     -1
 4          14        15         1           1         1     -1
 5          13        15         9           9         2     -1
 6          15        12         2           2         1     -1
---- CIRCULAR BEAM CROSS-SECTION PROPERTIES ----
2            NPropSets   - Number
PropSetID  YoungE   ShearG   MatDens  XsecD  XsecT
  (-)      (N/m2)   (N/m2)   (kg/m3)   (m)    (m)
 1         2.1e11   8.08e10   7850     2.0    0.04
 2         2.1e11   8.08e10   7850     1.0    0.02
---- ARBITRARY BEAM CROSS-SECTION PROPERTIES ----
1            NXPropSets  - Number
PropSetID  YoungE   ShearG   MatDens  XsecA  XsecAsx XsecAsy XsecJxx XsecJyy XsecJ0
  (-)      (N/m2)   (N/m2)   (kg/m3)   (m2)    (m2)    (m2)    (m4)    (m4)   (m4)
 7         2.0e11   8.0e10    8000     0.1    0.05    0.06    0.01    0.02   0.03
---- CABLE PROPERTIES ----
1            NCablePropSets - Number
PropSetID   EA     MatDens   T0   CtrlChannel
  (-)       (N)     (kg/m)   (N)     (-)
 9         1e8       10      2e6     0
---- RIGID LINK PROPERTIES ----
0            NRigidPropSets - Number
PropSetID   MatDens
  (-)       (kg/m)
---- MEMBER COSINE MATRICES COSM(i,j) ----
0            NCOSMs      - Number
COSMID    COSM11    COSM12    COSM13    COSM21    COSM22    COSM23    COSM31    COSM32    COSM33
 (-)       (-)       (-)       (-)       (-)       (-)       (-)       (-)       (-)       (-)
---- JOINT ADDITIONAL CONCENTRATED MASSES ----
2            NCmass      - Number
CMJointID  JMass   JMXX  JMYY  JMZZ  JMXY  JMXZ  JMYZ  MCGX  MCGY  MCGZ
  (-)      (kg)     -     -     -     -     -     -    (m)   (m)   (m)
 14        50000   1e5   2e5   3e5    0     0     0    0.0   0.0   2.0
 15        1000     0     0     0     0     0     0    0.0   0.0   0.0
---- OUTPUT: SUMMARY & OUTFILE ----
False        SumPrint    - Summary
END
)~";

// A column of soil that goes with the joint, 1 m below it.
inline constexpr const char* ground_file = R"~(Ground below a joint
1e8  Kxx
2e8  kyy
3e8  Kzz
-4e8 Kxty
5D8  Kytx
6e9  Ktxtx
7e9  Ktyty
8e9  Ktztz
0.0  Kxy
1000 Mxx
1000 Myy
1000 Mzz
-1e3 Mxty
1e3  Mytx
3000 Mtxtx
3000 Mtyty
4000 Mtztz
)~";

// The frame with a joint on soft ground.
inline std::string on_ground(std::string subdyn) {
  const std::string held = " 12        1        1        1        0        0        0       \"\"";
  return subdyn.replace(subdyn.find(held), held.size(),
                        " 12        0        0        0        0        0        0       "
                        "\"ground.dat\"");
}

inline constexpr const char* seastate_file = R"~(------- SeaState Input File -------
A sea
False     Echo     - Echo it (flag)
---- ENVIRONMENTAL CONDITIONS ----
1025      WtrDens  - Density (kg/m^3)
20        WtrDpth  - Depth (meters)
0         MSL2SWL  - Offset (meters)
---- WAVES ----
2         WaveMod  - Model
3         WaveStMod - Stretching
600       WaveTMax - Time
0.25      WaveDT   - Step
6         WaveHs   - Height (meters)
10        WaveTp   - Period (sec)
"DEFAULT" WavePkShp - Peak
0.15708   WvLowCOff - Low cut-off (rad/s)
3.2       WvHiCOff - High cut-off (rad/s)
30        WaveDir  - Heading (degrees)
0         WaveDirMod - Spreading
123       WaveSeed(1) - Seed
"RANLUX"  WaveSeed(2) - Seed
TRUE      WaveNDAmp - Amplitudes
---- 2ND-ORDER WAVES ----
False     WvDiffQTF - Second order
False     WvSumQTF - Second order
---- CURRENT ----
1         CurrMod  - Model
0.5       CurrSSV0 - Speed (m/s)
"DEFAULT" CurrSSDir - Heading (degrees)
20        CurrNSRef - Depth (meters)
0         CurrNSV0 - Speed (m/s)
0         CurrNSDir - Heading (degrees)
0         CurrDIV  - Speed (m/s)
0         CurrDIDir - Heading (degrees)
---- OUTPUT ----
False     SeaStSum - Summary
END
)~";

// A tapered leg with growth and coefficients by depth, a brace with its own, a column for potential
// flow.
inline constexpr const char* hydrodyn_file = R"~(------- HydroDyn Input File -------
Three members
False     Echo     - Echo it (flag)
---- FLOATING PLATFORM ----
0         PotMod   - Potential flow
---- PLATFORM ADDITIONAL STIFFNESS AND DAMPING ----
 0   AddF0 - Preload
 0
 0   0   0   0   0   0   AddCLin - Stiffness
---- STRIP THEORY OPTIONS ----
1         WaveDisp - Waves at the displaced place
0         AMMod    - Added mass
---- AXIAL COEFFICIENTS ----
2         NAxCoef  - Number
AxCoefID  AxCd   AxCa   AxCp   AxFDMod AxVnCOff AxFDLoFSc
  (-)     (-)    (-)    (-)     (-)     (-)      (-)
  1       0.0    0.0    1.0      0      0.0      1.0
  2       0.6    1.0    1.0      0      0.0      1.0
---- MEMBER JOINTS ----
6         NJoints  - Number
JointID  Jointxi Jointyi Jointzi JointAxID JointOvrlp
  (-)      (m)     (m)     (m)     (-)      (switch)
  1        0.0     0.0   -20.0001   1         0
  2        0.0     0.0    10.0      1         0
  3       10.0     0.0   -12.0      2         0
  4       10.0     6.0    -4.0      2         0
  5       30.0     0.0   -15.0      1         0
  6       30.0     0.0     5.0      1         0
---- MEMBER CROSS-SECTION PROPERTIES ----
2         NPropSets - Number
PropSetID  PropD  PropThck
  (-)       (m)     (m)
  1         6.0    0.06
  2         3.0    0.05
---- SIMPLE HYDRODYNAMIC COEFFICIENTS (model 1) ----
 SimplCd SimplCdMG SimplCa SimplCaMG SimplCp SimplCpMG SimplAxCd SimplAxCdMG SimplAxCa SimplAxCaMG SimplAxCp SimplAxCpMG SimplCb SimplCbMG
   (-)      (-)      (-)      (-)      (-)      (-)       (-)        (-)        (-)        (-)        (-)        (-)       (-)      (-)
   1.0      1.1      1.0      0.9      1.0      1.0       1.0        0.0        0.0        1.0        1.0        1.0       1.0      1.0
---- DEPTH-BASED HYDRODYNAMIC COEFFICIENTS (model 2) ----
2         NCoefDpth - Number
Dpth  DpthCd DpthCdMG DpthCa DpthCaMG DpthCp DpthCpMG DpthAxCd DpthAxCdMG DpthAxCa DpthAxCaMG DpthAxCp DpthAxCpMG DpthCb DpthCbMG
(m)    (-)     (-)     (-)     (-)      (-)    (-)      (-)       (-)       (-)       (-)        (-)       (-)      (-)     (-)
 0.0   0.7     1.0     1.0     0.8      1.0    1.0      0.0       0.0       0.0       0.0        1.0       1.0      1.0     1.0
-10.0  0.9     1.4     0.6     0.5      1.0    1.0      0.0       0.0       0.0       0.0        1.0       1.0      1.0     1.0
---- MEMBER-BASED HYDRODYNAMIC COEFFICIENTS (model 3) ----
1         NCoefMembers - Number
MemberID MemberCd1 MemberCd2 MemberCdMG1 MemberCdMG2 MemberCa1 MemberCa2 MemberCaMG1 MemberCaMG2 MemberCp1 MemberCp2 MemberCpMG1 MemberCpMG2
  (-)      (-)       (-)        (-)         (-)        (-)       (-)        (-)         (-)        (-)       (-)        (-)         (-)
  2        0.5       0.8        0.5         0.8        1.0       1.0        1.0         1.0        1.0       1.0        1.0         1.0
---- MEMBERS ----
3         NMembers - Number
MemberID MJointID1 MJointID2 MPropSetID1 MPropSetID2 MDivSize MCoefMod MHstLMod PropPot
  (-)       (-)       (-)       (-)         (-)        (m)    (switch) (switch) (flag)
  1          1         2         1           2         0.5       2        1     FALSE
  2          3         4         2           2         0.5       3        1     FALSE
  3          5         6         1           1         0.5       1        1     TRUE
---- FILLED MEMBERS ----
1         NFillGroups - Number
FillNumM FillMList FillFSLoc FillDens
  (-)      (-)       (m)     (kg/m^3)
  1         2        0.0     DEFAULT
---- MARINE GROWTH ----
2         NMGDepths - Number
MGDpth  MGThck  MGDens
 (m)     (m)   (kg/m^3)
 -15.0   0.1    1325
  -2.0   0.1    1325
---- MEMBER OUTPUT LIST ----
0         NMOutputs - Number
---- OUTPUT ----
False     HDSum    - Summary
END
)~";

inline constexpr const char* moordyn_file = R"~(------ MoorDyn Input File ------
Two lines
FALSE    Echo      - echo it
------ LINE TYPES ------
Name     Diam   MassDen    EA    BA/-zeta  EI   Cd   Ca   CdAx  CaAx
(-)       (m)   (kg/m)     (N)    (N-s/-)  (-)  (-)  (-)   (-)   (-)
chain    0.08   120.0    7.5E8    -1.0     0    2.0  0.8   0.4  0.25
wire     0.05    40.0    2.0E8    -1.0     0    1.2  1.0   0.1   0.0
------ POINTS ------
ID     Attachment   X      Y       Z     M   V   CdA  CA
(-)    (-)         (m)    (m)     (m)  (kg) (m^3) (m^2) (-)
1      Fixed      400.0    0.0  -200.0   0   0    0   0
2      Fixed     -400.0    0.0  -200.0   0   0    0   0
3      Vessel      20.0    0.0   -14.0   0   0    0   0
4      Coupled    -20.0    0.0   -14.0   0   0    0   0
------ LINES ------
ID     LineType  AttachA  AttachB  UnstrLen  NumSegs  Outputs
(-)      (-)       (-)      (-)      (m)       (-)      (-)
1       chain       1        3      435.0      20       -
2       wire        4        2      436.0      20       -
------ OPTIONS ------
0.001    dtM       - step
9.81     g         - gravity
1025     WtrDnsty  - density
------ OUTPUTS ------
FairTen1
END
)~";

inline constexpr const char* old_moordyn_file = R"~(------ MoorDyn Input File, version 1 ------
One line
FALSE    Echo      - echo it
------ LINE DICTIONARY ------
1        NTypes    - number of line types
LineType Diam  MassDenInAir  EA   BA/-zeta  Can  Cat  Cdn  Cdt
(-)      (m)     (kg/m)      (N)   (N-s/-)  (-)  (-)  (-)  (-)
main     0.0766  113.35   7.536e8   -1.0    1.0  0.0  1.6  0.1
------ NODE PROPERTIES ------
2        NConnects - number of connections
Node     Type      X      Y       Z     M   V   FX   FY   FZ  CdA  CA
(-)      (-)      (m)    (m)     (m)  (kg) (m^3) (kN) (kN) (kN) (m^2) (-)
1        Fixed   837.6   0.0   -200.0   0   0    0    0    0   0   0
2        Vessel   40.868 0.0    -14.0   0   0    0    0    0   0   0
------ LINE PROPERTIES ------
1        NLines    - number of lines
Line   LineType  UnstrLen NumSegs NodeAnch NodeFair Flags/Outputs
(-)      (-)       (m)     (-)      (-)      (-)       (-)
1       main      835.35    20       1        2         p
------ SOLVER OPTIONS ------
0.001    dtM       - step
------ OUTPUTS ------
FairTen1
END
)~";

}  // namespace culm::openfast
