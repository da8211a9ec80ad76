# The picture of doc/performance.md from the table that storey_performance writes:
# gnuplot -e 'csv="out"; pictures="doc/pictures"' bench/performance_plot.gnuplot
set datafile separator ","
set terminal svg size 760,560 font "sans,13" background "white"
set output pictures."/performance.svg"
set title "CPU seconds of one thread over points"
set xlabel "points"
set ylabel "CPU seconds"
set logscale xy
set offsets graph 0.05, graph 0.05, 0, 0
set key outside below
set grid lc rgb "#dddddd"
table = csv."/performance.csv"
row(name) = sprintf("< grep -F '\"%s\"' %s", name, table)
plot row("building: all") using 2:3 w lp lw 2 pt 7 lc rgb "#1b7837" title "storey, end to end", \
     row("paper: all") using 2:3 w lp lw 2 pt 7 lc rgb "#7fbf7b" title "the paper's chain, end to end", \
     row("storey::PlanarConfidenceFilter, K = 30") using 2:3 w lp lw 2 pt 5 lc rgb "#2166ac" title "storey, K = 30 neighbours", \
     row("pcl::NormalEstimationOMP, K = 30") using 2:3 w lp lw 2 pt 5 lc rgb "#b2182b" title "PCL, K = 30 neighbours", \
     row("pcl::Poisson, depth 8") using 2:3 w lp lw 2 pt 9 lc rgb "#ef8a62" title "pcl::Poisson, depth 8", \
     row("floor: the bytes read") using 2:3 w lp lw 2 pt 1 lc rgb "#888888" title "reading the bytes"
