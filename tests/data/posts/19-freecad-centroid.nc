;Exported by FreeCAD
;Post Processor: centroid_post
;Cam File: plate.FCStd
;Output Time:2025-01-01 12:00:00.000000
;begin preamble
G53 G00 G17
G21
;begin operation
;TC: Endmill
M6 T1
M3 S4000
;end operation: TC: Endmill
;begin operation
;Profile
G00 Z10.0000
G00 X0.0000 Y0.0000
G00 Z2.0000
G01 X0.0000 Y0.0000 Z-1.0000 F150.00
G01 X30.0000 Y0.0000 Z-1.0000 F300.00
G02 X40.0000 Y-10.0000 Z-1.0000 I0.0000 J-10.0000 K0.0000 F300.00
G00 Z10.0000
;end operation: Profile
;begin postamble
M5
M25
G49 H0
G90 G80 G40 G49
M99
