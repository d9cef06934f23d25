(Made in : Autodesk CAM Post Processor)
(G-Code optimized for OpenBuilds grbl machines)
(Drawing name : frame)
(Operations :)
(1 : 2D Contour1)
G90 G94 G17
G21
G54

(Operation 1 of 1 : 2D Contour1)
(Tool 1: Flat End Mill, D=6)
G53 G0 Z-10
S10000 M3
G4 P1.8
G0 X10 Y10
Z15
Z5
G1 Z-1 F300
X50 F1000
Y40
X10
Y10
G0 Z15
G53 G0 Z-10
M5
G0 X-10 Y-10
M30
