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

look() { # a folder of its own, options of the browser and the page
    mkdir -p "$1"
    home=$1
    shift
    HOME=$home timeout 600 "$browser" --headless --no-sandbox --disable-gpu --enable-logging=stderr \
        --hide-scrollbars --force-prefers-reduced-motion --user-data-dir="$home/profile" "$@" 2>"$home/log"
}
cp -r "$site" "$scratch/site"
node "$root/lesson/tests/scenes.js" "$hemilux" "$site" "$scratch/site"
cp "$root/lesson/tests/check.js" "$scratch/site"
sed 's,<script>lesson.start();</script>,<script src="expected.js"></script><script>lesson.start().then(() => document.body.append(lesson.element("script" \, { src: "check.js" })));</script>,' \
    "$site/index.html" >"$scratch/site/checked.html"
walk() { # a name, a window and what is asked of the page
    name=$1
    if look "$scratch/$name" --window-size="$2" --virtual-time-budget=900000 --dump-dom \
        "file://$scratch/site/checked.html$3" >"$scratch/$name.dom" &&
        grep -q '^all checks ran' "$scratch/$name.dom" && ! grep -q 'FAILS: ' "$scratch/$name.dom" &&
        ! grep CONSOLE "$scratch/$name/log"
    then
        echo "$name: $(grep -c 'holds: ' "$scratch/$name.dom") things hold"
    else
        echo "$name: $(grep 'FAILS: ' "$scratch/$name.dom" || echo 'FAILS: the checks did not end')"
        : >"$scratch/failed"
    fi
}
chapters=$(sed -n 's,.*"chapters/\(.*\)\.js".*,\1,p' "$site/index.html")
# Half of the chapters beside the others.
for chapter in $(echo "$chapters" | awk 'NR % 2 == 1'); do walk "chapter-$chapter" 1440,900 "?only=$chapter"; done &
for chapter in $(echo "$chapters" | awk 'NR % 2 == 0'); do walk "chapter-$chapter" 1440,900 "?only=$chapter"; done
wait
walk "all-in-a-narrow-window" 500,844 ""
if [ $# -ge 3 ]; then
    mkdir -p "$3"
    for chapter in 0 $chapters; do
        look "$scratch/pictures" --window-size=1440,900 --virtual-time-budget=9000 --screenshot="$3/$chapter.png" "file://$site/index.html#$chapter"
    done
fi
[ ! -e "$scratch/failed" ]
