# What levels cost against how far they are off: docs/media/levels.svg from bench/results/epyc-2-cores/levels.csv.
#   gnuplot bench/draw_levels.gp        in the checkout's root
set encoding utf8
set terminal svg size 800,440 font "DejaVu Sans,13" background "#ffffff"
set output "docs/media/levels.svg"
set datafile separator ","
set logscale xy
set format x "10^{%T}"
set xlabel "cost: visits of elements in a control tick"
set ylabel "error of the shape at rest (mm)"
set grid lc rgb "#dddddd"
set border 3
set tics nomirror
unset key
set xrange [0.3:3e7]
set yrange [1:100]
set title "{/:Bold levels}: levels of one body, 1.7 m" offset 0,-0.3
results = "bench/results/epyc-2-cores/levels.csv"
# The colours of Okabe and Ito.
plot results using (strcol(2)[1:7] eq "lattice" ? $5 : NaN):4 every ::1 with linespoints pt 7 ps 1 lw 2 lc rgb "#0072b2", \
     results using (strcol(2)[1:7] eq "lattice" ? $5 : NaN):4:(strcol(3)." tetrahedra") every ::1 with labels left offset 1,0.6 font ",12", \
     results using (strcol(2) eq "springs" ? $5 : NaN):4 every ::1 with points pt 5 ps 1 lc rgb "#d55e00", \
     results using (strcol(2) eq "springs" ? $5 : NaN):4:(strcol(3)." springs") every ::1 with labels center offset 0,1 font ",12" tc rgb "#a04000", \
     results using (strcol(2) eq "jiggle" ? $5 : NaN):4 every ::1 with points pt 9 ps 1.3 lc rgb "#009e73", \
     results using (strcol(2) eq "jiggle" ? $5 : NaN):4:("one jiggle follower") every ::1 with labels left offset 1,0.6 font ",12" tc rgb "#007050"
