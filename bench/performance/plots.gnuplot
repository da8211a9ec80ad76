# The pictures of doc/performance.md from the tables that storey_performance writes:
# gnuplot -e 'csv="out"; pictures="doc/pictures"' bench/performance/plots.gnuplot
set datafile separator ","
set terminal svg size 860,560 font "sans,13" background "white"
set output pictures."/performance.svg"
set title "CPU seconds of one thread over points"
set xlabel "points"
set ylabel "CPU seconds"
set logscale xy
set offsets graph 0.05, graph 0.05, 0, 0
set key outside right
set grid lc rgb "#dddddd"
table = csv."/performance.csv"
row(name) = sprintf("< grep -F '\"%s\"' %s", name, table)
plot row("building: all stages") using 2:3 w lp lw 2 pt 7 lc rgb "#1b7837" title "storey, all stages", \
     row("paper: all stages") using 2:3 w lp lw 2 pt 7 lc rgb "#7fbf7b" title "the paper's chain", \
     row("storey::PlanarConfidenceFilter, K = 30") using 2:3 w lp lw 2 pt 5 lc rgb "#2166ac" title "storey, 30 neighbours", \
     row("pcl::NormalEstimationOMP, K = 30") using 2:3 w lp lw 2 pt 5 lc rgb "#b2182b" title "PCL, 30 neighbours", \
     row("pcl::RegionGrowing, K = 30") using 2:3 w lp lw 2 pt 9 lc rgb "#fdae61" title "PCL, region growing", \
     row("pcl::ConcaveHull of 40 slices") using 2:3 w lp lw 2 pt 9 lc rgb "#d6604d" title "PCL, concave hulls", \
     row("pcl::Poisson, depth 8") using 2:3 w lp lw 2 pt 9 lc rgb "#ef8a62" title "PCL, Poisson", \
     row("floor: the bytes read") using 2:3 w lp lw 2 pt 1 lc rgb "#888888" title "reading the bytes"

reset
set datafile separator ","
set output pictures."/performance_shares.svg"
set title "Share of each stage in the time from file to model"
set xlabel "points"
set ylabel "% of the CPU seconds"
set yrange [0:100]
set style data histograms
set style histogram rowstacked
set style fill solid 0.85 border rgb "white"
set boxwidth 0.7
set key outside right invert
shares = csv."/performance_shares.csv"
colors = "#1b7837 #7fbf7b #d9f0d3 #2166ac #92c5de #762a83 #c2a5cf #b2182b #f4a582 #888888"
columns = int(system("head -n 1 ".shares." | tr ',' '\\n' | wc -l"))
plot for [i=2:columns] shares using i:xtic(1) lc rgb word(colors, i - 1) title columnheader(i)
