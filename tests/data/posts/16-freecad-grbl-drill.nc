(Exported by FreeCAD)
(Post Processor: grbl_post)
(Output Time:2025-01-01 12:00:00.000000)
(Begin preamble)
G17 G90
G21
(Begin operation: TC: Drill)
(Path: TC: Drill)
(TC: Drill)
(Begin toolchange)
( M6 T2 )
M3 S3000
(Finish operation: TC: Drill)
(Begin operation: Drilling)
(Path: Drilling)
(Drilling)
(Begin Drilling)
G0 Z5.000
G90
( G98 )
G0 X10.000 Y10.000
G0 Z3.000
G1 Z-5.000 F100.000
G4 P0.500
G0 Z5.000
G0 X30.000 Y10.000
G0 Z3.000
G1 Z-5.000 F100.000
G4 P0.500
G0 Z5.000
G0 X30.000 Y25.000
G0 Z3.000
G1 Z-5.000 F100.000
G4 P0.500
G0 Z5.000
( G80 )
(Finish operation: Drilling)
(Begin postamble)
M5
G17 G90
M2
