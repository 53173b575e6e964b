#!/bin/bash
# Makes the tables of errors in README.md and docs/measured/*.md anew. Seeds are fixed, so the figures
# depend on the program alone; times stand in other tables, which are taken by hand.
#
#   scripts/results.sh [--check] [--program FILE] [TABLE ...]
#
# Without a table: all of them, some minutes. A table stands between the lines <!-- table NAME --> and
# <!-- end NAME -->. --check replaces nothing, prints each figure that has drifted, and ends with 1
# where there is one. The program is build/release/hemilux unless given.
set -euo pipefail
cd "$(dirname "$0")/.."

# The tables, each with the function below that prints it.
tables="references equal_rays summary z literal_furnace literal_depth literal_1997 density_store"
pages="README.md $(echo docs/measured/*.md)"

check=no program=build/release/hemilux wanted=
while [ $# -gt 0 ]; do
    case $1 in
    --check) check=yes ;;
    --program) program=$2; shift ;;
    -*) sed -n '2,9s/^# \{0,1\}//p' "$0"; exit 1 ;;
    *) wanted="$wanted $1" ;;
    esac
    shift
done
command -v "$program" >/dev/null || { echo "no program $program: ./demo.sh builds it" >&2; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# What each table needs ---------------------------------------------------------------------------

# solve SCENE ARGUMENTS: sets $run to files of this run: .log (a row per step), .txt (what was
# reported), .json. A run is made once, however many tables show it.
solve() {
    run=$folder/$(echo "$*" | tr -c 'a-zA-Z0-9.\n' _)
    [ -e "$run.log" ] || "$program" solve "examples/scenes/$1.obj" "${@:2}" -o "$run.csv" \
        --stats "$run.json" --steps-log "$run.log" 2>"$run.txt"
}

# Leaves the reference in $reference.
refer_to() {
    solve "$1" --method matrix
    reference=$run.csv
}

# compared SCENE ARGUMENTS: the same against the reference.
compared() {
    refer_to "$1"
    solve "$@" --reference "$reference"
}

# Of the run: a number in the statistics, and one in what was reported, after the words given.
statistic() { sed -n "s/^ *\"$1\": \([^,]*\).*/\1/p" "$run.json"; }
reported() { sed -n "s/.*$1 \([-0-9.]*\).*/\1/p" "$run.txt"; }

# step NUMBER: rays [M], estimated, true, detail and rest errors [%] of that row of the log.
step() {
    awk -F, -v step="$1" '
        function percent(x) { return x == "" || x != x + 0 ? "-" : sprintf("%.3g %%", 100 * x) }
        $3 == step { printf "%.3g M\t%s\t%s\t%s\t%s\n", $4 / 1e6, percent($6), percent($7), percent($8), percent($9) }
    ' "$run.log"
}

# means SCENE SEEDS ARGUMENTS: over runs with the seeds 1 to SEEDS, at their last step: rays a patch,
# estimated error, and mean +- standard error of the true one, of the detail groups and of the rest.
means() {
    local seed
    for ((seed = 1; seed <= $2; ++seed)); do
        compared "$1" "${@:3}" --seed "$seed"
        echo "$(statistic patches),$(tail -1 "$run.log")"
    done | awk -F, '
        function add(column, x) { sum[column] += x; squares[column] += x * x }
        function mean(column) { return sum[column] / NR }
        function spread(column,    v) {
            v = squares[column] / NR - mean(column) ^ 2
            return NR > 1 && v > 0 ? sqrt(v / (NR - 1)) : 0
        }
        function percent(column) {
            return sprintf(NR > 1 ? "%.2f ± %.2f %%" : "%.2f %%", 100 * mean(column), 100 * spread(column))
        }
        { add("rays", $5 / $1); add("estimated", $7); add("true", $8); add("detail", $9); add("rest", $10) }
        END {
            printf "%.0f | %.2f %% | %s | %s | %s\n", mean("rays"), 100 * mean("estimated"), percent("true"),
                percent("detail"), percent("rest")
        }'
}

# The tables --------------------------------------------------------------------------------------

five_scenes="cornell_box room_1002 open_scene wall_before_crowd office_3576"

references() {
    echo "| scene | patches | rays | estimated error, from 8 batches |"
    echo "|---|---|---|---|"
    for scene in $five_scenes; do
        refer_to "$scene"
        local rays estimated
        IFS=$'\t' read -r rays estimated _ < <(step "$(statistic steps)")
        echo "| $scene | $(statistic patches) | $rays | $estimated |"
    done
}

equal_rays() {
    echo "| scene | method | rays a patch | estimated error | true error | detail | rest |"
    echo "|---|---|---|---|---|---|---|"
    for scene in cornell_box room_1002 office_3576; do
        for method in progressive-monte-carlo stratified hemisphere; do
            echo "| $scene | \`$method\` | $(means $scene 8 --method $method --steps 64) |"
        done
    done
}

summary() {
    echo "| scene | arguments of \`solve\` | rays a patch | estimated error | true error | detail | rest |"
    echo "|---|---|---|---|---|---|---|"
    for scene in room_1002 office_3576; do
        echo "| $scene | \`--method progressive-monte-carlo --steps 64\` | $(means $scene 8 --method progressive-monte-carlo --steps 64) |"
        echo "| $scene | \`--method hemisphere --steps 64\` | $(means $scene 8 --method hemisphere --steps 64) |"
        echo "| $scene | \`--literal --steps 8\` | $(means $scene 1 --literal --steps 8) |"
        echo "| $scene | \`--error 0.01\` | $(means $scene 8 --error 0.01) |"
    done
}

z() {
    echo "| scene | progressive-monte-carlo | monte-carlo | stratified | hemisphere | hemisphere-1997 |"
    echo "|---|---|---|---|---|---|"
    for scene in $five_scenes; do
        local row="| $scene |"
        for method in progressive-monte-carlo monte-carlo stratified hemisphere hemisphere-1997; do
            compared "$scene" --method $method --rays 64 --steps 64
            row="$row $(reported 'z-scores: mean'), $(reported 'rms') |"
        done
        echo "$row"
    done
}

literal_furnace() {
    echo "| furnace (exact: 2 on every patch) | error, corrected | error, literal | largest z, corrected | largest z, literal |"
    echo "|---|---|---|---|---|"
    for scene in furnace_box furnace_lshape; do
        local corrected literal z
        compared $scene --method hemisphere --steps 64
        IFS=$'\t' read -r _ _ corrected _ < <(step 64)
        z=$(reported largest)
        compared $scene --literal --steps 64
        IFS=$'\t' read -r _ _ literal _ < <(step 64)
        echo "| $scene | $corrected | $literal | $z | $(reported largest) |"
    done
}

literal_depth() {
    echo "| scene | depth | 4 steps: rays, error | 64 steps: rays, error | of which rest |"
    echo "|---|---|---|---|---|"
    for scene in cornell_box room_1002; do
        for depth in 0 1 2 3; do
            compared $scene --literal --depth $depth --steps 64
            local early late early_rays late_rays rest
            IFS=$'\t' read -r early_rays _ early _ < <(step 4)
            IFS=$'\t' read -r late_rays _ late _ rest < <(step 64)
            echo "| $scene | $depth | $early_rays, $early | $late_rays, $late | $rest |"
        done
    done
}

literal_1997() {
    echo "| scene | 3 steps: rays, error | 16 steps | 64 steps |"
    echo "|---|---|---|---|"
    for scene in cornell_box room_1002; do
        compared $scene --method hemisphere-1997 --literal --steps 64
        echo "| $scene |$(for n in 3 16 64; do step $n | awk -F'\t' '{ printf " %s, %s |", $1, $3 }'; done)"
    done
}

density_store() {
    echo "| scene | patches | threshold | density rays | bytes | bytes a patch | 84 p (formula) | 64 p (printed) |"
    echo "|---|---|---|---|---|---|---|---|"
    for scene in room_1002 office_3576 "cornell_box --max-edge 0.0045"; do
        for threshold in 0 2 100; do
            # shellcheck disable=SC2086  # the list is meant to be split
            solve $scene --method hemisphere --threshold $threshold --rays 1 --steps 1
            awk -v scene="$scene" -v threshold=$threshold -v patches="$(statistic patches)" \
                -v rays="$(statistic rays_density)" -v bytes="$(statistic bytes_density)" 'BEGIN {
                printf "| %s | %d | %s | %d | %d | %.1f | %d | %d |\n", scene, patches, threshold, rays, bytes,
                    bytes / patches, 84 * patches, 64 * patches }'
        done
    done
}

# Into the pages ----------------------------------------------------------------------------------

# stands TABLE PAGE: the lines between its marks.
stands() { sed -n "/^<!-- table $1 -->$/,/^<!-- end $1 -->$/{/^<!--/!p}" "$2"; }

# Cells of two tables that differ: PAGE, TABLE, the row's first cells, the column.
drift() {
    awk -F' *[|] *' -v page="$1" -v table="$2" '
        FNR == NR { old[FNR] = $0; next }
        FNR == 1 { split($0, heads) }
        {
            n = split($0, now)
            if (split(old[FNR], was) != n) { printf "%s, %s: a row is new: %s\n", page, table, $0; next }
            for (i = 2; i < n; ++i)
                if (now[i] != was[i])
                    printf "%s, %s, %s %s, %s: %s is now %s\n", page, table, now[2], now[3], heads[i], was[i], now[i]
        }
        FNR > last { last = FNR }
        END { if (length(old) > last) printf "%s, %s: rows %d to %d are gone\n", page, table, last + 1, length(old) }
    ' "$3" "$4"
}

drifted=0
for table in ${wanted:-$tables}; do
    [[ " $tables " = *" $table "* ]] || { echo "no table $table; there are: $tables" >&2; exit 1; }
    $table >"$folder/now"
    for page in $pages; do
        grep -q "^<!-- table $table -->$" "$page" || continue
        stands "$table" "$page" >"$folder/was"
        cmp -s "$folder/was" "$folder/now" && continue
        drifted=1
        drift "$page" "$table" "$folder/was" "$folder/now"
        [ $check = yes ] || sed -i -e "/^<!-- table $table -->$/r $folder/now" \
            -e "/^<!-- table $table -->$/,/^<!-- end $table -->$/{/^<!--/!d}" "$page"
    done
done
[ $drifted = 1 ] || echo "no figure has drifted"
[ $check = no ] || exit $drifted
