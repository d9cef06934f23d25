(Exported by FreeCAD)
(Post Processor: linuxcnc_post)
(Output Time:2025-01-01 12:00:00.000000)
(begin preamble)
G17 G54 G40 G49 G80 G90
G21
(begin operation: TC: Drill)
(machine: not set, mm/min)
(TC: Drill)
M5
M6 T2 G43 H2
M3 S3000
(finish operation: TC: Drill)
(begin operation: Drilling)
(machine: not set, mm/min)
(Drilling)
(Begin Drilling)
G0 Z5.000
G90
G98
G83 X4.000 Y4.000 Z-4.000 F60.000 Q2.500 R1.000
G83 X24.000 Y4.000 Z-4.000 F60.000 Q2.500 R1.000
G80
G0 Z5.000
(finish operation: Drilling)
(begin postamble)
M05
G17 G54 G90 G80 G40
M2
