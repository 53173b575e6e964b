#!/bin/sh
# Joins the storey `paper` into one header, to be handed out: the scene, rays, the hemisphere and a page for
# each method of the paper. It needs GLM's headers and nothing else.
#
#   scripts/paper_header.sh [FILE]      writes hemilux_paper.h to FILE, or to standard output
#   scripts/paper_header.sh --check PROGRAM
#                                       compiles examples/10_pages.cpp with it in place of the library ($CXX, c++),
#                                       and compares what it prints with what PROGRAM, the example itself, prints
#
# Include it in one file of a program: it holds the bodies of all functions.
set -eu
cd "$(dirname "$0")/.."
command -v awk >/dev/null || { echo "awk is needed" >&2; exit 77; }

files() { # SUFFIX: the files of the storey
    find src/geometry src/bvh src/radiosity/paper -name "*.$1" -not -path 'src/bvh/wide/*' | LC_ALL=C sort
}

# Headers come before those that include them. A class that several sources have for themselves gets the name of
# its file.
join() {
    awk '
    function own(line) { return match(line, /^#include "[^"]*"/) ? substr(line, 11, RLENGTH - 11) : "" }
    function read_file(file,    line, n) {
        while ((getline line < file) > 0)
            text[file, ++n] = line
        close(file)
        lines[file] = n
    }
    function rename(file, line,    name, from, rest, before, after, renamed) {
        for (name in clashes) {
            if (!((file, name) in has))
                continue
            rest = line
            renamed = ""
            while ((from = index(rest, name)) > 0) {
                before = from > 1 ? substr(rest, from - 1, 1) : " "
                after = substr(rest, from + length(name), 1)
                renamed = renamed substr(rest, 1, from + length(name) - 1)
                if (before !~ /[A-Za-z0-9_]/ && after !~ /[A-Za-z0-9_]/)
                    renamed = renamed "_of_" stem[file]
                rest = substr(rest, from + length(name))
            }
            line = renamed rest
        }
        return line
    }
    function put(file,    k, header) {
        if (done[file]++)
            return
        for (k = 1; k <= lines[file]; ++k)
            if ((header = own(text[file, k])) != "")
                put("src/" header)
        body = body "\n// ---- " substr(file, 5) "\n"
        last = ""
        for (k = 1; k <= lines[file]; ++k) {
            if (text[file, k] ~ /^#include </)
                system_headers[text[file, k]]
            else if (text[file, k] !~ /^#(include|pragma once)/ && (text[file, k] != "" || last != ""))
                body = body rename(file, last = text[file, k]) "\n"
        }
    }
    BEGIN {
        for (f = 1; f < ARGC; ++f) {
            file = ARGV[f]
            read_file(file)
            if (file !~ /\.cpp$/)
                continue
            n = split(file, parts, "/")
            stem[file] = substr(parts[n], 1, length(parts[n]) - 4)
            if (match(stem[file], /^section_[0-9]+(_[0-9]+)*/))
                stem[file] = substr(stem[file], 1, RLENGTH)
            for (k = 1; k <= lines[file]; ++k)
                if (match(text[file, k], /^(struct|class) [A-Za-z0-9_]+/)) {
                    split(substr(text[file, k], 1, RLENGTH), words, " ")
                    has[file, words[2]]
                    if (++owners[words[2]] > 1)
                        clashes[words[2]]
                }
        }
        for (f = 1; f < ARGC; ++f)
            put(ARGV[f])
        print "// hemilux_paper.h: the hemisphere subdivision of Plemenos and Jolivet (GraphiCon 1998), and the"
        print "// methods that their paper compares it with, each on a page."
        print "// Made by scripts/paper_header.sh. Include it in one file of a program. It needs GLM alone."
        print "#pragma once\n"
        for (header in system_headers)
            print header | "LC_ALL=C sort"
        close("LC_ALL=C sort")
        printf "%s", body
    }' $(files h) $(files cpp)
}

case ${1-} in
'') join ;;
--check)
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    join >"$work/hemilux_paper.h"
    { echo '#include "hemilux_paper.h"'; grep -v '^#include "' examples/10_pages.cpp; } >"$work/pages.cpp"
    ${CXX:-c++} -std=c++20 -O1 -ffp-contract=off -Wall -Wextra -Werror -o "$work/pages" "$work/pages.cpp"
    "$work/pages" >"$work/of_header.txt"
    "$2" >"$work/of_library.txt"
    diff "$work/of_library.txt" "$work/of_header.txt"
    ;;
-*) sed -n '2,12s/^# \{0,1\}//p' "$0" >&2; exit 1 ;;
*) join >"$1" ;;
esac
