;Fusion 360 CAM 2.0
; Posts processor: MPCNC.cps
; Document: plate
; Setup: Setup1
;
; Tools table:
; T1 D=6 CR=0 - ZMIN=-1 - flat end mill

; *** START begin ***
G90
G21
M84 S0
G92 X0 Y0 Z0
; *** START end ***

; *** SECTION begin ***
;2D Contour1 - Milling - Tool: 1 - flat end mill
; X Min: 5 - X Max: 40
M400
M117 2D Contour1
M0 Turn ON CLOCKWISE
G0 Z15 F300
G0 X5 Y5 F2500
G0 Z5 F300
G1 Z-1 F100
G1 X35 F800
G3 X40 Y10 I0 J5
G1 Y25
G4 P500
G0 Z15 F300
; *** SECTION end ***

M400
M117 Job end
G0 X0 Y0 F2500
G0 Z0 F300
