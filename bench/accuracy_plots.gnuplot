# Pictures of doc/accuracy.md from the tables that storey_accuracy writes with --csv:
# gnuplot -e 'csv="out"; pictures="doc/pictures"' bench/accuracy_plots.gnuplot
set datafile separator ","
set terminal svg size 760,420 font "sans,13" background "white"
set key bottom right
set grid lc rgb "#dddddd"

# Share of the buildings with a ratio of at most x.
set output pictures."/accuracy_ratio.svg"
set title "Error over its statistical limit"
set xlabel "ratio (1: an ideal estimator that knows the topology)"
set ylabel "share of the buildings"
set logscale x
set xrange [0.1:200]
set yrange [0:1]
stats csv."/accuracy_random.csv" using 6 every ::1 nooutput name "CLEAN"
stats csv."/accuracy_combined.csv" using 6 every ::1 nooutput name "COMBINED"
plot csv."/accuracy_random.csv" every ::1 using ($6/$8):(1.0/CLEAN_records) smooth cumulative \
       lw 2 lc rgb "#1b7837" title "clean: vertices to facets", \
     "" every ::1 using ($9/$11):(1.0/CLEAN_records) smooth cumulative \
       lw 2 dt 2 lc rgb "#1b7837" title "clean: corners to vertices", \
     csv."/accuracy_combined.csv" every ::1 using ($6/$8):(1.0/COMBINED_records) smooth cumulative \
       lw 2 lc rgb "#b2182b" title "all defects: vertices to facets"
unset logscale x

# Each defect at rising levels; the rows of a level follow each other.
set output pictures."/accuracy_defects.svg"
set terminal svg size 1000,460 font "sans,12" background "white"
set title "One defect at a time"
unset xlabel
set ylabel "intersection over union"
set yrange [0.7:1.002]  # a refusal, 0, is shown at the foot
set autoscale x
set xtics rotate by 60 right scale 0 font ",10"
last = ""
row = -1
level(name) = (name eq last ? row : (last = name, row = row + 1))
plot csv."/accuracy_defects.csv" every ::1 using (level(strcol(2))):($12 < 0.7 ? 0.7 : $12):xticlabels(2) \
       pt 7 ps 0.5 lc rgb "#2166ac" title "a building", \
     0.95 lc rgb "#b2182b" dt 2 title "0.95"
