%
( a hook, with parameters )
#1=5 ( safe height )
#2=-1.5 ( depth )
#3=[#1*8] ( length )
G21 G90 G17 G40 G49 G54 G64 P0.01
T1 M6
S1200 M3
G4 P2
G0 Z#1
G0 X0 Y0
G1 Z#2 F100
X#3 F300
Y[#3/2]
X[#3-10*2]
G0 Z#1
M5
M2
%
