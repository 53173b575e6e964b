#!/bin/sh
# Bakes the office into vertices and a lightmap, and a room of scripts/artist_room.py into its own file, and compares what
# viewers show with hemilux's own pictures. Solves the scene that Blender begins with.
#   check.sh HEMILUX [NODE_MODULES]
# Blender where it is installed; three.js in headless Chromium and the Khronos validator where NODE_MODULES has them
# (npm install three gltf-validator). The mean difference has to be below 2 % of the mean light. What bake writes without
# any option is shown by viewers without any setting: sRGB bytes have to be within 4 of 255 on the mean, where the file
# before the bake is three times as far off. The validator has to find no error and no warning. Exit code 77 where there
# is none of them.
set -eu
[ $# -ge 1 ] || { sed -n '2,9s/^# \{0,1\}//p' "$0" >&2; exit 1; }
hemilux=$(realpath "$1")
modules=${2:-${HEMILUX_NODE_MODULES:-}}
[ -z "$modules" ] || modules=$(realpath "$modules")
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
server=
trap '[ -z "$server" ] || kill $server; rm -rf "$scratch"' EXIT
cd "$scratch"
view=7.6,2,5.7,2.6,0.7,1.6,58
"$hemilux" solve "$here/../../examples/scenes/office_3576.obj" -q --divide none --tone srgb --no-gather --size 400x300 \
    --camera $view -o picture.hdr -o scene.glb --lightmap 2048
python3 "$here/../artist_room.py" room.glb
"$hemilux" bake room.glb -q -o lit.glb --lightmap 1024 --bind lightmap --error 2%
"$hemilux" bake room.glb -q -o shown.glb
exposure=$(python3 -c 'import json, struct
file = open("shown.glb", "rb")
print(json.loads(file.read(struct.unpack("<I", file.read(20)[12:16])[0]))["textures"][-1]["extras"]["hemilux"]["exposure"])')
"$hemilux" solve room.glb -q --error 1% --size 400x300 --exposure "$exposure" -o shown.png
"$hemilux" solve room.glb -q --error 1% --size 400x300 -o room.hdr

ran= status=0
judge() { # viewer, file and what the line in it begins with
    line=$(grep -a "^$3:" "$2") || { echo "$1 did not show $3"; tail -5 "$2"; return 1; }
    echo "$1, $line"
    echo "$line" | awk '{ exit !($NF == "%" && $(NF - 1) < 2) }'
}
judge_shown() { # viewer, file with its line
    line=$(grep -a "^shown:" "$2") || { echo "$1 did not show what bake writes"; tail -5 "$2"; return 1; }
    echo "$1, $line"
    echo "$line" | awk '{ exit !($4 < 4 && ($NF == 255 || $NF > 3 * $4)) }'
}
if command -v blender >/dev/null; then
    ran=yes
    for what in "vertices $view" "lightmap $view" baked; do
        timeout 300 blender --background --factory-startup --python "$here/blender.py" -- $what >log 2>&1 || true
        judge Blender log "${what%% *}" || status=1
    done
    timeout 300 blender --background --factory-startup --python "$here/blender.py" -- shown >log 2>&1 || true
    judge_shown Blender log || status=1
    # And the other way: the scene that Blender begins with has its lamp the right way round.
    blender --background --factory-startup --python-expr "import numpy; numpy.bool = bool; import bpy
bpy.ops.export_scene.gltf(filepath='begin.glb', export_lights=True, export_cameras=True)" >log 2>&1 || true
    "$hemilux" solve begin.glb -o begin.png 2>begin.log && ! grep -q '^turned' begin.log &&
        echo "Blender, its first scene is lit" || { echo "its first scene is not lit"; status=1; }
fi
if [ -d "${modules:-/none}/gltf-validator" ]; then
    ran=yes
    for file in scene.glb lit.glb shown.glb; do NODE_PATH=$modules node "$here/validate.js" $file || status=1; done
fi
if [ -d "${modules:-/none}/three" ] && command -v chromium >/dev/null && command -v python3 >/dev/null; then
    ran=yes
    ln -s "$modules/three" three
    cp "$here/three.html" "$here/baked.html" "$here/shown.html" .
    python3 -u -m http.server 0 --bind 127.0.0.1 >port 2>requests &
    server=$!
    while ! grep -q port port; do sleep 0.1; done
    port=$(sed 's/.* port \([0-9]*\).*/\1/' port)
    show() { # page and options; the shell becomes the browser
        page=$1
        shift
        exec env HOME="$scratch" timeout 120 chromium --headless --no-sandbox --disable-gpu --use-gl=angle --use-angle=swiftshader \
            --enable-unsafe-swiftshader --user-data-dir="$scratch/profile" "$@" "http://127.0.0.1:$port/$page"
    }
    (show "three.html#$view" --virtual-time-budget=20000 --dump-dom) >dom 2>log
    for what in vertices lightmap; do judge three.js dom $what || status=1; done
    for page in baked shown; do
        before=$(wc -l <requests)
        show $page.html --remote-debugging-port=0 >log 2>&1 &
        browser=$!
        while kill -0 $browser 2>/dev/null && ! tail -n +$((before + 1)) requests | grep -q 'done?'; do sleep 0.2; done
        kill $browser 2>/dev/null || true
        wait $browser 2>/dev/null || true
    done
    python3 -c 'import re, sys, urllib.parse
print(*map(urllib.parse.unquote, re.findall(r"done\?(\S+)", sys.stdin.read())), sep="\n")' <requests >pages
    judge three.js pages baked || status=1
    judge_shown three.js pages || status=1
fi
[ -n "$ran" ] || { echo "neither Blender nor three.js nor the validator is here" >&2; exit 77; }
exit $status
