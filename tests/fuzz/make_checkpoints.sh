#!/bin/sh
# Makes the corpora of checkpoints anew, as the format of the present program is:
#   tests/fuzz/make_checkpoints.sh build/dev/hemilux
set -e
hemilux=$(realpath "$1")
cd "$(dirname "$0")/corpus"
options='--sides front --emission *=1 --keep-all --rays 4 --steps 2 --quiet'
table=$(mktemp --suffix=.csv)
set -f
mkdir -p checkpoint_sealed
for method in stored-transport hemisphere hemisphere-1997 monte-carlo progressive-monte-carlo; do
  "$hemilux" solve obj/facing.obj $options --method $method --checkpoint checkpoint_sealed/$method -o "$table"
done
"$hemilux" solve obj/facing.obj $options --method hemisphere --guide learned \
  --checkpoint checkpoint_sealed/learned -o "$table"
"$hemilux" solve obj/triangle.obj $options --method stored-transport --checkpoint checkpoint/whole -o "$table"
# Of fuzz_checkpoint, which seals it: without the first line, the length and the checksum.
tail -c +38 checkpoint/whole | head -c -8 >checkpoint/content
rm "$table"
