; two turns down, by hand
(MSG, clamp the plate)
(debug, bore of one inch)
G20 G90 G17 G40 G80 G94
G64 P.001 Q.001
T2 M6
G43
M3 S3000
G4 P1.5
G0 X.5 Y0
G0 Z.1
G2 X.5 Y0 Z-.4 I-.5 J0 P2 F10
G1 X0
G0 Z.1
M5 M9
M30
