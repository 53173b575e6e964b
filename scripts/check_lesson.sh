#!/bin/sh
# Opens the lesson in headless Chromium, walks through every chapter in a wide and in a narrow window, and compares
# what the figures show with the program; compares the module with the program under node.
#   check_lesson.sh HEMILUX SITE [FOLDER]     SITE: as scripts/lesson.sh makes it; FOLDER: for screenshots
# Exit code 77 where there is no Chromium.
set -eu
[ $# -ge 2 ] || { sed -n '2,5s/^# \{0,1\}//p' "$0" >&2; exit 1; }
hemilux=$(realpath "$1")
site=$(realpath "$2")
root=$(cd "$(dirname "$0")/.." && pwd)
packed=$(cat "$site"/*.js "$site"/*.css "$site"/*.html "$site"/chapters/*.js | gzip -9 | wc -c)
echo "the lesson is $packed bytes, packed"
[ "$packed" -lt 1000000 ] || { echo "FAILS: that is more than 1 MB" >&2; exit 1; }
node "$root/lesson/tests/same_bits.js" "$hemilux" "$site"
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
    { echo "the pages of the lesson are not opened: apt install chromium" >&2; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

look() { # options of the browser and the page
    HOME=$scratch timeout 900 "$browser" --headless --no-sandbox --disable-gpu --enable-logging=stderr \
        --hide-scrollbars --force-prefers-reduced-motion --user-data-dir="$scratch/profile" "$@" 2>"$scratch/log"
}
cp -r "$site" "$scratch/site"
node "$root/lesson/tests/scenes.js" "$hemilux" "$site" "$scratch/site"
cp "$root/lesson/tests/check.js" "$scratch/site"
sed 's,<script>lesson.start();</script>,<script src="expected.js"></script><script>lesson.start().then(() => document.body.append(lesson.element("script" \, { src: "check.js" })));</script>,' \
    "$site/index.html" >"$scratch/site/checked.html"
status=0
for size in 1440,900 500,844; do
    echo "== a window of $size"
    look --window-size=$size --virtual-time-budget=600000 --dump-dom "file://$scratch/site/checked.html" \
        >"$scratch/dom" || status=1
    sed -n 's/.*<pre id="checks">//; s,</pre>.*,,; /^holds\|^FAILS\|^all checks/p' "$scratch/dom" >"$scratch/checks"
    grep -v '^holds' "$scratch/checks" || true
    echo "$(grep -c '^holds' "$scratch/checks") things hold"
    if grep -q '^FAILS' "$scratch/checks" || ! grep -q '^all checks ran' "$scratch/checks"; then status=1; fi
    if grep CONSOLE "$scratch/log"; then status=1; fi
done
if [ $# -ge 3 ]; then
    mkdir -p "$3"
    for chapter in 0 $(sed -n 's,.*"chapters/\(.*\)\.js".*,\1,p' "$site/index.html"); do
        look --window-size=1440,900 --virtual-time-budget=9000 --screenshot="$3/$chapter.png" "file://$site/index.html#$chapter"
    done
fi
exit $status
