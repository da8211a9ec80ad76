#!/usr/bin/env bash
# Accuracy on generated buildings, both methods: the paper's error (mean distance of the model's
# vertices to the true facets), its statistical limit, overlap of volumes, polygons, CPU seconds.
# usage: accuracy.sh BIN_DIR [NAME...]
set -euo pipefail
bin=$1
shift
names=("$@")
[ ${#names[@]} -gt 0 ] || names=(syn1 syn2 syn3 box l_shape courtyard two_towers hexagon overhang
                                 shifted cylinder random:1 random:2 random:3 random:4 random:5)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
printf '%-12s %-9s %9s %9s %8s %9s %8s\n' building method error limit IoU polygons 'CPU s'
for name in "${names[@]}"; do
  limit=$("$bin/storey_synth" "$name" -o "$work/cloud.ply" --truth "$work/truth.ply" |
    sed -n 's/^statistical limit.*: //p')
  for method in building paper; do
    rm -rf "$work/out"
    TIMEFORMAT=%U
    if ! seconds=$({ time "$bin/storey_reconstruct" "$work/cloud.ply" -o "$work/out" \
      --method "$method" --quiet; } 2>&1); then
      printf '%-12s %-9s %s\n' "$name" "$method" "$(printf '%s' "$seconds" | head -n 1)"
      continue
    fi
    "$bin/storey_evaluate" "$work/out/model.ply" "$work/truth.ply" |
      awk -v name="$name" -v method="$method" -v limit="$limit" -v seconds="$seconds" '
        /^model vertices to true facets/ { error = $6 }
        /^IoU/ { iou = $2 }
        /^model +[0-9]/ { polygons = $2 }
        /^truth +[0-9]/ { truth = $2 }
        END { printf "%-12s %-9s %9.5f %9s %8.5f %4d/%-4d %8s\n",
                     name, method, error, limit, iou, polygons, truth, seconds }'
  done
done
