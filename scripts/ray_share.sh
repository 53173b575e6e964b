#!/bin/sh
# The share of a run's processor time in which rays look for facets, in percent, by the samples of
# perf; the paper's section 1 has it at 80.
#
#     scripts/ray_share.sh build/release/hemilux solve examples/scenes/office_3576.obj --method matrix -t 1 -o out/m.csv
#
# Counted is what the tree of boxes does (src/bvh): the way through it, facets, counts, rays made ready.
set -e
samples=$(mktemp)
trap 'rm -f "$samples"' EXIT
perf record -q -F 1999 -o "$samples" "$@" >/dev/null 2>&1
perf report -i "$samples" --no-children --stdio --percent-limit 0 -F overhead,symbol 2>/dev/null |
    awk '/%/ { share = $1; sub("%", "", share); all += share }
         /%/ && /hemilux::(wide::|WideBvh|hit_facet|may_hit|BruteForce|\(anonymous namespace\)::closer)/ { rays += share }
         END { printf "%.0f\n", 100 * rays / all }'
