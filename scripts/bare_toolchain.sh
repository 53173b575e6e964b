#!/bin/sh
# Shows that the storey `paper` needs a compiler, CMake, Make and GLM's headers and nothing else: builds
# it with its examples, without warnings, and runs these.
#
#   scripts/bare_toolchain.sh           in an empty root with the files of those packages alone (Debian, as
#                                       root; nothing is downloaded)
#   scripts/bare_toolchain.sh --here    on this system, by each compiler that is found: g++ with Make,
#                                       clang++ with Ninja and with libc++, the cross compiler for aarch64
#                                       (run by qemu-user), and em++ (run by node); all find the same bytes
#   scripts/bare_toolchain.sh --bytes   the same with the engine, for examples/13_same_bytes alone: all methods
#                                       have the bytes of the table beside it by each compiler, and here by
#                                       the kernels of each instruction set and the C library without FMA;
#                                       aarch64 takes 20 minutes
#
# Ends with 77 where the first is not possible.
set -eu
storey=paper target=all tests=. unity=OFF strict=ON
case ${1-} in
'' | --here) ;;
--bytes) storey=engine target=example_13_same_bytes tests=same_bytes unity=ON ;;
*) sed -n '2,15s/^# \{0,1\}//p' "$0" >&2; exit 1 ;;
esac
cd "$(dirname "$0")/.."
cores=$(nproc 2>/dev/null || echo 2)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# compare_pages BUILD: whether an example prints the hashes that it printed in the first build.
compare_pages() {
    (cd "$1" && ctest -V -R pages) | sed -n 's/^[0-9]*: \(.*[0-9a-f]\{16\}\)$/\1/p' >"$1/hashes.txt"
    [ -s "$1/hashes.txt" ]
    [ -e "$work/hashes.txt" ] || cp "$1/hashes.txt" "$work/hashes.txt"
    diff "$work/hashes.txt" "$1/hashes.txt"
}

# build NAME ARGUMENT...: configures with these arguments, builds and runs the examples.
build() {
    name=$1
    shift
    cmake -S . -B "$work/$name" -DHEMILUX_UP_TO=$storey -DHEMILUX_WARNINGS_AS_ERRORS=ON -DCMAKE_UNITY_BUILD=$unity \
        -DCMAKE_BUILD_TYPE=Release -DCMAKE_DISABLE_FIND_PACKAGE_Catch2=ON "$@" >"$work/$name.txt" 2>&1 &&
        cmake --build "$work/$name" --parallel "$cores" --target $target >>"$work/$name.txt" 2>&1 &&
        (cd "$work/$name" && ctest --output-on-failure -R $tests) >>"$work/$name.txt" 2>&1 ||
        { cat "$work/$name.txt" >&2; exit 1; }
    echo "$name: $(sed -n '/tests passed/p' "$work/$name.txt")"
    [ $storey = engine ] || compare_pages "$work/$name"
}

if [ $# -gt 0 ]; then
    build make -G "Unix Makefiles" -DCMAKE_CXX_COMPILER=g++
    if [ $storey = engine ]; then
        for kernels in baseline avx2 avx512; do
            HEMILUX_KERNELS=$kernels "$work/make/examples/13_same_bytes" examples/13_same_bytes.txt
        done
        GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-AVX2,-FMA \
            "$work/make/examples/13_same_bytes" examples/13_same_bytes.txt
    fi
    if command -v clang++ >/dev/null && command -v ninja >/dev/null; then
        build clang-ninja -G Ninja -DCMAKE_CXX_COMPILER=clang++
        # The engine needs more of C++20 than libc++ 14 has.
        if [ $storey = paper ] && echo '#include <version>' | clang++ -stdlib=libc++ -x c++ -fsyntax-only - 2>/dev/null; then
            build libc++ -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_FLAGS=-stdlib=libc++
        fi
    fi
    if command -v aarch64-linux-gnu-g++ >/dev/null && command -v qemu-aarch64 >/dev/null; then
        build aarch64 -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 \
            -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++ \
            "-DCMAKE_CROSSCOMPILING_EMULATOR=qemu-aarch64;-L;/usr/aarch64-linux-gnu"
    fi
    if command -v em++ >/dev/null; then
        # GLM in a folder of its own: beside it in /usr/include lie headers of this system.
        glm=$(dirname "$(find /usr/lib /usr/share -name glmConfig.cmake | head -1)")
        mkdir -p "$work$glm" "$work/usr/include"
        cp "$glm"/*.cmake "$work$glm"
        cp -r /usr/include/glm "$work/usr/include"
        # em++ minifies with a module of Debian's, which no other node looks for there.
        export NODE_PATH="${NODE_PATH:+$NODE_PATH:}/usr/share/nodejs"
        # Programs of this em++ take a node that has `fetch` for a browser.
        export NODE_OPTIONS=--no-experimental-fetch
        flags=-fexceptions
        # The engine as in the lesson (lesson/CMakeLists.txt). A size has 32 bits here.
        [ $storey = paper ] ||
            flags="-msimd128 -fwasm-exceptions -isystem $PWD/lesson/module/cxx20" strict=OFF
        build emscripten "-DCMAKE_TOOLCHAIN_FILE=$(em-config EMSCRIPTEN_ROOT)/cmake/Modules/Platform/Emscripten.cmake" \
            "-DCMAKE_CXX_FLAGS=$flags" -DCMAKE_CXX_EXTENSIONS=OFF -DHEMILUX_X86_KERNELS=OFF -Dglm_DIR="$work$glm" \
            -DHEMILUX_WARNINGS_AS_ERRORS=$strict \
            "-DCMAKE_EXE_LINKER_FLAGS=-sNODERAWFS=1 -sALLOW_MEMORY_GROWTH=1 -sTOTAL_STACK=1048576"
    fi
    exit 0
fi

if [ "$(id -u)" -ne 0 ] || ! command -v apt-cache >/dev/null || ! command -v git >/dev/null; then
    echo "an empty root needs Debian, root and git" >&2
    exit 77
fi
packages="g++ cmake make libglm-dev dash coreutils grep sed diffutils findutils"
# shellcheck disable=SC2086  # the list is meant to be split
needed=$(apt-cache depends --recurse --installed --no-recommends --no-suggests --no-conflicts --no-breaks \
    --no-replaces --no-enhances $packages | grep '^[a-z0-9]' | sort -u)
for package in $needed; do
    dpkg -L "$package" 2>/dev/null || true
done | sort -u | while read -r file; do
    if [ ! -d "$file" ] || [ -L "$file" ]; then echo "$file"; fi
done >"$work/files.txt"
root=$work/root
mkdir -p "$root/usr"
for folder in bin lib lib64 sbin; do # links to folders of /usr
    [ ! -L "/$folder" ] || { mkdir -p "$root/usr/$folder" && ln -s "usr/$folder" "$root/$folder"; }
done
# The links of /etc/alternatives are made as packages are installed: no package owns them.
tar -C / -cf - --ignore-failed-read --no-recursion -T "$work/files.txt" etc/alternatives/c++ 2>/dev/null |
    tar -C "$root" --keep-directory-symlink -xf -
mkdir -p "$root/tmp" "$root/dev" "$root/hemilux"
: >"$root/dev/null"
git ls-files -z | xargs -0 tar -cf - | tar -C "$root/hemilux" -xf -
echo "$(wc -l <"$work/files.txt") files of $(echo "$needed" | wc -l) packages, $(du -sm "$root" | cut -f1) MB"
chroot "$root" /usr/bin/env -i PATH=/usr/bin:/bin /bin/sh -c '
    set -eu
    cd /hemilux
    cmake -S . -B /tmp/build -DHEMILUX_UP_TO=paper -DHEMILUX_WARNINGS_AS_ERRORS=ON -DCMAKE_BUILD_TYPE=Release
    cmake --build /tmp/build --parallel '"$cores"'
    cd /tmp/build && ctest --output-on-failure'
