; a groove in four passes
G21 G90 G17 G40 G49 G54
#<depth> = 0
#<step> = 0.5
M3 S6000
G0 X0 Y0 Z5
G0 Z0.5
o101 while [#<depth> LT 2]
  #<depth> = [#<depth> + #<step>]
  G1 Z[0 - #<depth>] F100
  G1 X40 F400
  G1 X0
o101 endwhile
G0 Z5
M5
M2
