( short slots by a subroutine: x, y, depth )
G21 G90 G17 G40 G49 G54
o100 sub
  G0 X#1 Y#2
  G0 Z1
  G1 Z[0-#3] F150
  G91 G1 X10
  G90
  G0 Z5
o100 endsub

M3 S8000
G0 X0 Y0 Z5
o100 call [0] [0] [2]
o100 call [0] [15] [2]
o100 call [20] [15] [3]
G0 X0 Y0
M5
M2
