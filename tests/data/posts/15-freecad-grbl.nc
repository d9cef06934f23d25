(Exported by FreeCAD)
(Post Processor: grbl_post)
(Output Time:2025-01-01 12:00:00.000000)
(Begin preamble)
G17 G90
G21
(Begin operation: Fixture)
(Path: Fixture)
G54
(Finish operation: Fixture)
(Begin operation: TC: Default Tool)
(Path: TC: Default Tool)
(TC: Default Tool)
(Begin toolchange)
( M6 T1 )
M3 S10000
(Finish operation: TC: Default Tool)
(Begin operation: Profile)
(Path: Profile)
(Profile)
(Compensated Tool Path. Diameter: 5.0)
G0 Z5.000
G0 X0.000 Y5.000
G0 Z3.000
G1 X0.000 Y5.000 Z-2.000 F200.000
G1 X0.000 Y35.000 Z-2.000 F600.000
G2 X5.000 Y40.000 Z-2.000 I5.000 J0.000 K0.000 F600.000
G1 X55.000 Y40.000 Z-2.000 F600.000
G2 X60.000 Y35.000 Z-2.000 I0.000 J-5.000 K0.000 F600.000
G1 X60.000 Y5.000 Z-2.000 F600.000
G2 X55.000 Y0.000 Z-2.000 I-5.000 J-0.000 K0.000 F600.000
G1 X5.000 Y0.000 Z-2.000 F600.000
G2 X0.000 Y5.000 Z-2.000 I0.000 J5.000 K0.000 F600.000
G0 Z5.000
G0 Z5.000
(Finish operation: Profile)
(Begin postamble)
M5
G17 G90
M2
