#!/bin/sh
# Prints docs/use/options.md: what the program says of its options. A test compares the two.
#
#   scripts/options_page.sh build/release/hemilux >docs/use/options.md
set -eu
[ $# -eq 1 ] || { sed -n '2,4s/^# \{0,1\}//p' "$0" >&2; exit 1; }

cat <<'END'
# Options

This page is the program's own help, made by `scripts/options_page.sh`. For what methods do and when to
take which, see [methods.md](methods.md); for what goes wrong, [troubleshooting.md](troubleshooting.md).
END
for command in "" solve bake compare density formfactors viewfactors exchange dim info; do
    printf '\n## hemilux%s\n\n```\n' "${command:+ $command}"
    # shellcheck disable=SC2086  # no word where there is no subcommand
    "$1" $command --help | sed 's/[[:space:]]*$//' | cat -s
    printf '```\n'
done
for method in hemisphere hemisphere-1997 matrix monte-carlo progressive; do
    printf '\n## hemilux solve --help %s\n\n```\n' $method
    "$1" solve --help $method
    printf '```\n'
done
