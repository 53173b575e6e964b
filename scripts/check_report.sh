#!/bin/sh
# Opens pages of `solve --report` and `compare --report` in headless Chromium: no console message, a canvas that
# is not blank, clicks, keys, layers, sliders and charts work, in a wide and in a narrow window.
#   check_report.sh HEMILUX [FOLDER]     FOLDER: where pages and screenshots are kept
# Exit code 77 where there is no Chromium.
set -eu
[ $# -ge 1 ] || { sed -n '2,6s/^# \{0,1\}//p' "$0" >&2; exit 1; }
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
    { echo "no Chromium: pages are not checked" >&2; exit 77; }
hemilux=$(realpath "$1")
root=$(cd "$(dirname "$0")/.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
folder=${2:-$scratch/pages}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)

look() { # options of the browser and the page
    HOME=$scratch timeout 120 "$browser" --headless --no-sandbox --disable-gpu --use-gl=angle \
        --use-angle=swiftshader --enable-unsafe-swiftshader --enable-logging=stderr \
        --hide-scrollbars --virtual-time-budget=3000 --user-data-dir="$scratch/profile" "$@" 2>"$scratch/log"
}

# Names that would end an element or begin one, and quotes.
cd "$scratch"
cat >hostile.mtl <<'MTL'
newmtl </script><script>hostile=1</script><img/src=x/onerror=hostile=1>"'&amp;
Kd .5 .5 .5
newmtl <!--<script>
Kd .8 .2 .2
Ke 5 5 5
newmtl red
Kd .7 .2 .1
MTL
cat >hostile.obj <<'OBJ'
mtllib hostile.mtl
v 0 0 0
v 1 0 0
v 1 0 1
v 0 0 1
v 0 1 0
v 1 1 0
v 1 1 1
v 0 1 1
g </script><b>"group"</b>
usemtl </script><script>hostile=1</script><img/src=x/onerror=hostile=1>"'&amp;
f 4 3 2 1
usemtl red
f 1 2 6 5
g ]]>'<i>
usemtl <!--<script>
f 5 6 7 8
OBJ
"$hemilux" solve -t 1 "$root/examples/scenes/office_3576.obj" -q --steps 5 --report "$folder/office.html"
"$hemilux" solve -t 1 "$root/examples/scenes/office_3576.obj" -q --error 10% --report "$folder/divided.html"
"$hemilux" solve -t 1 "$root/examples/scenes/room_1002.obj" -q --method hemisphere --steps 3 --report "$folder/hemisphere.html"
"$hemilux" solve -t 1 hostile.obj -q --max-edge .1 --steps 3 --report "$folder/hostile.html"
# What the program finds by hemicubes of its own: from some patches to those that they see best.
"$hemilux" formfactors -t 1 hostile.obj -q --max-edge .1 --factors hemicube:128 -o factors.csv
awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) column[$k] = k; next }
    { i = $column["i"]; F = $column["F"] } i % 50 == 7 && F > most[i] { most[i] = F; to[i] = $column["j"] }
    END { printf "window.expectedFactors = ["; for (i in most) printf "[%d,%d,%s],", i, to[i], most[i]; print "];" }' \
    factors.csv >factors.js
"$hemilux" solve -t 1 "$root/examples/scenes/room_1002.obj" -q --steps 3 --sky 1 --report "$folder/sky.html"
"$hemilux" solve -t 1 "$root/examples/scenes/room_1002.obj" -q --steps 3 --layers lamp \
    --light 'disc at 2,2.2,2 towards 0,-1,0 radius .2 emission 20,60,90' --report "$folder/lamps.html"
compare="compare -t 1 -q -o compared --runs 2 --rays 10 --reference-error .05"
"$hemilux" $compare "$root/examples/scenes/office_3576.obj" --methods hemisphere,stratified,stored-transport \
    --budget-rays 1e6 --report "$folder/compared.html" >/dev/null
"$hemilux" $compare hostile.obj --max-edge .1 --methods stratified,monte-carlo --budget-rays 3e4 \
    --report "$folder/compared-hostile.html" >/dev/null

status=0
for page in office divided hemisphere hostile sky lamps compared compared-hostile; do
    [ "$(wc -c <"$folder/$page.html")" -lt 3000000 ] || { echo "FAILS: $page is too large"; status=1; }
    case $page in compared*) check=check_comparison.js ;; *) check=check_report.js ;; esac
    sed '/^<\/body>/,$d' "$folder/$page.html" >checked.html
    { echo '<script>'; [ $page != hostile ] || cat factors.js; cat "$root/scripts/$check"; echo '</script></body></html>'; } >>checked.html
    for size in 1240,1000 500,900; do
        echo "== $page, window of $size"
        look --window-size=$size --dump-dom "file://$scratch/checked.html" >dom || status=1
        grep -E '^(holds|FAILS|all)' dom || true
        if grep -q '^FAILS' dom || ! grep -q '^all checks ran' dom; then status=1; fi
        if grep CONSOLE log | grep -v 'GPU stall due to ReadPixels'; then status=1; fi
    done
done
if [ $# -ge 2 ]; then
    look --window-size=1360,2000 --screenshot="$folder/light.png" "file://$folder/office.html"
    look --window-size=1360,2000 --blink-settings=preferredColorScheme=0 --screenshot="$folder/dark.png" "file://$folder/office.html"
    look --window-size=500,2400 --screenshot="$folder/phone.png" "file://$folder/office.html"
fi
exit $status
