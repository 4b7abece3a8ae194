------- OpenFAST INPUT FILE on the monopile of OC3, in waves -------
NREL 5 MW reference turbine on the monopile of OC3; facts of Jonkman and Musial, NREL/TP-500-48191 (2010), by way of the public files of OpenFAST, see LICENSE
---------------------- SIMULATION CONTROL ----------------------
            30   TMax         - (s)
---------------------- FEATURE SWITCHES AND FLAGS ----------------------
             1   CompElast    - ElastoDyn (switch)
             1   CompInflow   - InflowWind (switch)
             2   CompAero     - AeroDyn (switch)
             1   CompServo    - ServoDyn (switch)
             1   CompSeaSt    - SeaState (switch)
             1   CompHydro    - HydroDyn (switch)
             1   CompSub      - SubDyn (switch)
             0   CompMooring  - (switch)
             0   CompIce      - (switch)
---------------------- ENVIRONMENTAL CONDITIONS ----------------------
       9.80665   Gravity      - (m/s^2)
         1.225   AirDens      - (kg/m^3)
          1025   WtrDens      - (kg/m^3)
            20   WtrDpth      - (m)
             0   MSL2SWL      - (m)
---------------------- INPUT FILES ----------------------
"oc3_elastodyn.dat"   EDFile       - (quoted string)
  "inflow.dat"   InflowFile   - (quoted string)
 "aerodyn.dat"   AeroFile     - (quoted string)
"servodyn.dat"   ServoFile    - (quoted string)
"oc3_seastate.dat"   SeaStFile    - (quoted string)
"oc3_hydrodyn.dat"   HydroFile    - (quoted string)
"oc3_subdyn.dat"   SubFile      - (quoted string)
