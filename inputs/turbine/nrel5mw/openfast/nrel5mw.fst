------- OpenFAST INPUT FILE on land, in a steady wind -------
NREL 5 MW reference turbine; facts of Jonkman et al., NREL/TP-500-38060 (2009), by way of the public files of OpenFAST, see LICENSE
---------------------- SIMULATION CONTROL ----------------------
            30   TMax         - (s)
---------------------- FEATURE SWITCHES AND FLAGS ----------------------
             1   CompElast    - ElastoDyn (switch)
             1   CompInflow   - InflowWind (switch)
             2   CompAero     - AeroDyn (switch)
             1   CompServo    - ServoDyn (switch)
             0   CompHydro    - (switch)
             0   CompSub      - (switch)
             0   CompMooring  - (switch)
             0   CompIce      - (switch)
---------------------- ENVIRONMENTAL CONDITIONS ----------------------
       9.80665   Gravity      - (m/s^2)
         1.225   AirDens      - (kg/m^3)
---------------------- INPUT FILES ----------------------
"elastodyn.dat"   EDFile       - (quoted string)
  "inflow.dat"   InflowFile   - (quoted string)
 "aerodyn.dat"   AeroFile     - (quoted string)
"servodyn.dat"   ServoFile    - (quoted string)
