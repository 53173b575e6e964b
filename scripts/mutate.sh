#!/bin/sh
# What the fast tests are worth: applies the faults listed below, one at a time, to a copy of this tree,
# builds the test program of the storey and runs its fast tests. Prints for each fault `caught` with the
# first test that caught it, `SURVIVED`, or `no build`.
#
#   scripts/mutate.sh [NAME...]   all faults, or these; some minutes for the first build, then a minute
#                                 or so for each fault (WORK names a folder to keep the build in)
#   scripts/mutate.sh --check     only that each fault still finds its one line; a test of CTest
set -eu
cd "$(dirname "$0")/.."

# Name, program of the fast tests, file of src, and what is replaced by what; @@ stands between.
faults() {
    cat <<'FAULTS'
lambert_broken @@ paper @@ radiosity/paper/pages/section_5_hemisphere.cpp @@ tr.projected_solid_angle / pi @@ tr.solid_angle / (2 * pi)
page_without_floor @@ paper @@ radiosity/paper/pages/section_5_hemisphere.cpp @@ D_average / 4 @@ D_average / 40
one_ray_more @@ paper @@ radiosity/paper/pages/step.cpp @@ std::floor(end) - std::floor(begin) @@ std::floor(end) - std::floor(begin) + 1
weight_of_roulette_dropped @@ paper @@ radiosity/paper/pages/step.cpp @@ N >= 1 ? whole : N @@ N >= 1 ? whole : 1
escaped_is_absorbed @@ paper @@ radiosity/paper/pages/step.cpp @@ (hit ? absorbed : escaped) @@ (hit ? escaped : absorbed)
absorbs_what_it_reflects @@ paper @@ radiosity/paper/pages/step.cpp @@ (1.0 - rho) * Phi @@ rho * Phi
reflects_two_percent_more @@ paper @@ radiosity/paper/pages/step.cpp @@ unshot[i] = rho * Phi @@ unshot[i] = 1.02 * rho * Phi
byte_wraps @@ paper @@ radiosity/paper/pages/step.cpp @@ std::min(input_.tracer.count(ray), 255U) @@ input_.tracer.count(ray)
biased_jitter @@ paper @@ radiosity/paper/pages/ray_numbers.h @@ (double(word) + 0.5) @@ (0.97 * double(word) + 0.5)
starts_on_diagonal @@ paper @@ radiosity/paper/pages/ray_numbers.h @@ return {four[2], four[3]}; @@ return {four[3], four[3]};
half_of_the_turn @@ paper @@ radiosity/paper/sampling/concentric_map.h @@ const double r = wide ? a : b, @@ const double r = std::fabs(wide ? a : b),
seed_forgotten @@ paper @@ radiosity/paper/sampling/rng.h @@ h = mix_bits(h ^ mix_bits( @@ h = mix_bits(mix_bits(
formula_1_swapped @@ paper @@ radiosity/paper/hemisphere/edge_division.cpp @@ ? ns_2 / (ns_1 + ns_2) : 0.5 @@ ? ns_1 / (ns_1 + ns_2) : 0.5
formula_of_counts_swapped @@ paper @@ radiosity/paper/hemisphere/edge_division.cpp @@ a.surfaces * bf + b.surfaces * af @@ a.surfaces * af + b.surfaces * bf
nothing_is_missed @@ paper @@ radiosity/paper/solution/missed_light.h @@ rule_of_three = 3 @@ rule_of_three = 0
nothing_is_allowed_for @@ paper @@ radiosity/paper/solution/missed_light.cpp @@ if (both > 0) @@ if (both < 0)
variance_of_one_step @@ paper @@ radiosity/paper/solving/mean_of_steps.cpp @@ variance[i] = sums.squares[i] / (n * (n - 1)) @@ variance[i] = sums.squares[i] / (n - 1)
back_faces_forward @@ paper @@ radiosity/paper/scene/mesh.cpp @@ back ? -normal : normal @@ normal
patch_at_next_row @@ paper @@ radiosity/paper/scene/facet_division.cpp @@ return {row * columns_ + column, @@ return {row * rows_ + column,
patch_at_rounded @@ paper @@ radiosity/paper/scene/facet_division.cpp @@ std::floor(x * n) @@ std::round(x * n)
slab_by_one_side @@ paper @@ bvh/traverse.cpp @@ std::max(enter[child], std::min(a, b)) @@ std::max(enter[child], a)
nodes_left_too_soon @@ paper @@ bvh/traverse.cpp @@ while (now.enter > limit()) @@ while (now.enter > .9f * limit())
target_blocks_itself @@ paper @@ bvh/traverse.cpp @@ facet != ray.from && facet != target && @@ facet != ray.from &&
edges_count_twice @@ paper @@ geometry/watertight.h @@ return up == counter_clockwise; @@ return true || up == counter_clockwise;
front_is_back @@ paper @@ geometry/watertight.h @@ ec / sum, sum < 0} @@ ec / sum, sum > 0}
areas_below_the_horizon @@ paper @@ geometry/spherical_triangle.cpp @@ sum += angle * normal_[i].z @@ sum += angle * std::abs(normal_[i].z)
triangles_sampled_as_fans @@ paper @@ geometry/polygon_sampler.cpp @@ second_ = triangle_ ? c - b : d - a @@ second_ = triangle_ ? c - a : d - a
no_floor @@ engine @@ radiosity/engine/methods/hemisphere.cpp @@ min_share = 0.25 @@ min_share = 0.025
roulette_of_engine @@ engine @@ radiosity/engine/shooting/bounces_plan.cpp @@ expected >= 1 ? static_cast<double>(high - low) : expected @@ static_cast<double>(high - low)
byte_wraps_in_engine @@ engine @@ radiosity/engine/densities/level_counts.h @@ std::min(pierced[k], 255u) @@ pierced[k]
chance_within_cluster @@ engine @@ radiosity/engine/emitters/emitter_choice.cpp @@ (powers[k + 1] - powers[k]) / power @@ 1.0 / (cluster.end - cluster.begin)
emitters_by_index @@ engine @@ radiosity/engine/emitters/emitter_choice.cpp @@ return {order_[cluster.begin + k], (powers[k + 1] - powers[k]) / power}; @@ return {order_[cluster.begin + std::uint32_t(share * (cluster.end - cluster.begin)) + 0 * k], 1.0 / (cluster.end - cluster.begin)};
chance_of_cluster_dropped @@ engine @@ radiosity/engine/emitters/emitter_choice.cpp @@ choice.chance *= width / cut.sum @@ choice.chance = width / cut.sum
chance_of_receiver_dropped @@ engine @@ radiosity/engine/progressive/shot_factors.cpp @@ f.factor /= chance @@ f.factor /= 1
far_lamps_two_percent_brighter @@ engine @@ radiosity/engine/factors/pairs/pair_factor.cpp @@ / (batches * points_each) @@ / (.98 * batches * points_each)
hemicube_side_as_top @@ engine @@ radiosity/engine/factors/points/hemicube.cpp @@ side_[row * half + from_middle(column)] @@ top_[row * half + from_middle(column)]
hemicube_mirrored @@ engine @@ radiosity/engine/factors/points/hemicube.cpp @@ return {-u, 1, v}; @@ return {u, 1, v};
loss_is_not_allowed_for @@ engine @@ radiosity/engine/methods/matrix.cpp @@ rule_of_three * leaving / (rays * emitted) @@ 0 * leaving / (rays * emitted)
rays_lost_by_filter @@ engine @@ bvh/wide/kernels/conservative_test.h @@ return F8::splat(error_share) * e * @@ return F8::splat(-1000 * error_share) * e *
two_percent_to_balls @@ research @@ radiosity/research/targets/rays_to_balls.cpp @@ shots.power.push_back(shot->power / std::max(takers, 1u) / @@ shots.power.push_back(1.02 * shot->power / std::max(takers, 1u) /
two_percent_of_a_ball @@ research @@ radiosity/research/targets/target_balls.cpp @@ const double power = 2 * cap * @@ const double power = 2.04 * cap *
FAULTS
}

# change FILE BEFORE AFTER: prints the file with the change; fails unless BEFORE stands there once.
change() {
    BEFORE=$2 AFTER=$3 awk '
        BEGIN { before = ENVIRON["BEFORE"]; after = ENVIRON["AFTER"] }
        {
            line = $0; done = ""
            while ((at = index(line, before)) > 0) {
                ++found
                done = done substr(line, 1, at - 1) after
                line = substr(line, at + length(before))
            }
            print done line
        }
        END { exit found != 1 }' "$1"
}

# each COMMAND: calls it with the five fields of each fault.
each() {
    faults | awk -F ' @@ ' '{ for (k = 1; k <= 5; ++k) print $k }' |
        while read -r name && read -r program && read -r file && read -r before && read -r after; do
            "$1" "$name" "$program" "$file" "$before" "$after" </dev/null || exit 1
        done
}

check() {
    change "src/$3" "$4" "$5" >/dev/null || { echo "$1: not once in src/$3: $4" >&2; return 1; }
}

if [ "${1-}" = --check ]; then
    each check
    echo "$(faults | wc -l) faults find their lines"
    exit 0
fi

asked=" $* "
cores=$(nproc 2>/dev/null || echo 2)
work=${WORK:-$(mktemp -d)}
[ -n "${WORK-}" ] || trap 'rm -rf "$work"' EXIT
mkdir -p "$work/tree"
git ls-files -z CMakeLists.txt cmake src tests examples bench scripts | xargs -0 tar cf - | tar xmf - -C "$work/tree"
generator=
command -v ninja >/dev/null && generator="-G Ninja"
# shellcheck disable=SC2086  # no generator, or two words
cmake -S "$work/tree" -B "$work/build" $generator -DHEMILUX_UP_TO=light -DHEMILUX_EXAMPLES=OFF \
    -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS=-O1 >"$work/log" || { cat "$work/log"; exit 1; }

try() {
    case $asked in '  ' | *" $1 "*) ;; *) return 0 ;; esac
    change "$work/tree/src/$3" "$4" "$5" >"$work/changed"
    cp "$work/tree/src/$3" "$work/as_it_was"
    cp "$work/changed" "$work/tree/src/$3"
    result=
    if ! cmake --build "$work/build" --parallel "$cores" --target "test_$2" >"$work/log" 2>&1; then
        result="no build"
    elif (cd "$work/build" && timeout 300 "tests/test_$2" '~[slow]' --abort >"$work/log" 2>&1); then
        result=SURVIVED
    else # the line after the first rule of the report; a fault that never ends has none
        test=$(awk '/^-----/ { getline; print; exit }' "$work/log")
        result="caught by \"${test:-its time}\""
    fi
    cp "$work/as_it_was" "$work/tree/src/$3"
    echo "$1: $result"
}
each try
