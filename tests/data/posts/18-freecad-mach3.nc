(Exported by FreeCAD)
(Post Processor: mach3_mach4_post)
(Output Time:2025-01-01 12:00:00.000000)
(begin preamble)
G17 G54 G40 G49 G80 G90
G21
(begin operation: Fixture)
(machine: mach3_4, mm/min)
G54
(finish operation: Fixture)
(begin operation: TC: Endmill)
(machine: mach3_4, mm/min)
(TC: Endmill)
M5
M6 T2
G43 H2
M3 S12000
(finish operation: TC: Endmill)
(begin operation: Helix)
(machine: mach3_4, mm/min)
(Helix)
G0 Z5.0000
G0 X15.0000 Y10.0000
G0 Z1.0000
G3 X5.0000 Y10.0000 Z0.5000 I-5.0000 J0.0000 F200.0000
G3 X15.0000 Y10.0000 Z0.0000 I5.0000 J0.0000 F200.0000
G3 X5.0000 Y10.0000 Z-0.5000 I-5.0000 J0.0000 F200.0000
G3 X15.0000 Y10.0000 Z-1.0000 I5.0000 J0.0000 F200.0000
G3 X5.0000 Y10.0000 I-5.0000 J0.0000 K0.0000 F400.0000
G3 X15.0000 Y10.0000 I5.0000 J0.0000 K0.0000 F400.0000
G0 Z5.0000
(finish operation: Helix)
(begin postamble)
M05
G17 G54 G90 G80 G40
M2
