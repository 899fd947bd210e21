# What levels cost against how far they are off: docs/media/levels.svg from bench/results/xeon-2-cores/levels.csv.
#   gnuplot bench/draw_levels.gp        in the checkout's root
set terminal svg size 720,420 font "DejaVu Sans,13" background "#ffffff"
set output "docs/media/levels.svg"
set datafile separator ","
set logscale xy
set xlabel "cost: visits of elements in a control tick"
set ylabel "error, mm"
set grid lc rgb "#dddddd"
set border 3
set tics nomirror
set key top right
set xrange [0.5:2e7]
set yrange [1:100]
results = "bench/results/xeon-2-cores/levels.csv"
plot results using (strcol(2)[1:7] eq "lattice" ? $5 : NaN):4 every ::1 with linespoints pt 7 ps 0.9 lw 2 lc rgb "#2f6fb3" title "lattices", \
     results using (strcol(2) eq "springs" ? $5 : NaN):4 every ::1 with points pt 5 ps 1 lc rgb "#c0504d" title "springs", \
     results using (strcol(2) eq "jiggle" ? $5 : NaN):4 every ::1 with points pt 9 ps 1.2 lc rgb "#4f9a4f" title "jiggle", \
     results using 5:4:(sprintf("  %s", strcol(3))) every ::1 with labels left offset 0.4,0.5 font ",10" tc rgb "#555555" notitle
