# Error against cost of every engine, a case each: FOLDER/peers-CASE.svg from a table of `./run bench peers`.
#   gnuplot [-e "results = 'TABLE.csv'; folder = 'FOLDER'"] bench/draw_peers.gp
# In the checkout's root; else from bench/results/xeon-2-cores/peers.csv into docs/media.
set encoding utf8
set terminal svg size 860,460 font "DejaVu Sans,13" background "#ffffff"
set datafile separator ","
set datafile missing NaN
set logscale xy
set format x "10^{%T}"
set format y "10^{%T}"
set xlabel "cost: µs of processor time a simulated second"
set grid lc rgb "#dddddd"
set border 3
set tics nomirror
set key outside right top Left reverse spacing 1.2 samplen 1.6 font ",11"
if (!exists("results")) results = "bench/results/xeon-2-cores/peers.csv"
if (!exists("folder")) folder = "docs/media"

# Settings that a line joins: an engine's, whose names begin or end with this.
array engines[16] = ["sbfmt", "sbfmt", "sbfmt", "sbfmt", "sbfmt", "Jolt", "Jolt", "MuJoCo", "MuJoCo", "MuJoCo", "MuJoCo", "Bullet", "Bullet", "Bullet", "Rapier", "Rapier"]
array kinds[16] = ["automatic", "symplectic", "position_based", "block_descent", "as the package has it", "iterations", "steps", "discrete", "Euler", "RK4", "implicitfast", "1 steps of ", " of 10 iterations", " steps", "impulse", "multibody"]
array shapes[16] = [7, 5, 9, 13, 7, 7, 7, 7, 5, 9, 7, 7, 5, 7, 7, 5]
color(engine) = engine eq "sbfmt" ? "#d55e00" : engine eq "Jolt" ? "#0072b2" : engine eq "MuJoCo" ? "#009e73" : engine eq "Bullet" ? "#cc79a7" : "#555555" # of Okabe and Ito
begins(name, kind) = strlen(name) >= strlen(kind) && name[1:strlen(kind)] eq kind
ends(name, kind) = strlen(name) >= strlen(kind) && name[strlen(name) - strlen(kind) + 1:strlen(name)] eq kind
in_series(i) = strcol(1) eq which && strcol(2) eq engines[i] && (begins(strcol(4), kinds[i]) || ends(strcol(4), kinds[i]))
is_drawn(i) = in_series(i) && strlen(strcol(6)) && strlen(strcol(7))
title_of(i) = engines[i].", ".(kinds[i] eq " of 10 iterations" ? "10 iterations, steps" : kinds[i] eq "1 steps of " ? "1 step, iterations" : kinds[i] eq " steps" ? "steps" : kinds[i])

do for [which in "beam spin pendulum chain"] {
  set output folder."/peers-".which.".svg"
  present = "" # series that have a point
  do for [i = 1:16] {
    stats results using (is_drawn(i) ? 1 : 0) every ::1 nooutput
    if (STATS_sum > 0) { present = present.sprintf("%d ", i) }
  }
  failed = ""
  do for [engine in "sbfmt Jolt MuJoCo Bullet Rapier"] {
    stats results using (strcol(1) eq which && strcol(2) eq engine && strlen(strcol(13)) ? 1 : 0) every ::1 nooutput
    if (STATS_sum > 0) { failed = failed.sprintf("%s%s %d", strlen(failed) ? ", " : "", engine, STATS_sum) }
  }
  set title "{/:Bold ".which."}".(strlen(failed) ? ": settings that exploded and are not drawn: ".failed : "") noenhanced
  set title enhanced
  set ylabel which eq "beam" ? "error of the sag, against the engine's own model" : which eq "spin" ? "RMS error / length, against its own model" : "RMS error / length, against the exact motion"
  plot for [n in present] results using (is_drawn(int(n)) ? $6 : NaN):(is_drawn(int(n)) ? $7 : NaN) every ::1 \
         with linespoints pt shapes[int(n)] ps 0.9 lw 1.5 lc rgb color(engines[int(n)]) title title_of(int(n)) noenhanced, \
       for [n in present] results using (is_drawn(int(n)) && strcol(5) eq "yes" ? $6 : NaN):7 every ::1 \
         with points pt 6 ps 2.2 lw 1.5 lc rgb color(engines[int(n)]) notitle, \
       NaN with points pt 6 ps 2.2 lw 1.5 lc rgb "#000000" title "recommended"
}
