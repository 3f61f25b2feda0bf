#!/usr/bin/env bash
# install_test.sh BUILD SOURCE COMPILER: installs BUILD into a temporary folder, builds SOURCE/examples/cpp against the
# installed copy, runs the example and the installed tool, and looks for every installed file.
set -euo pipefail
build="$1" source="$2" compiler="$3"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
prefix="$work/prefix"
fail() { echo "install_test: $*" >&2; exit 1; }

cmake --install "$build" --prefix "$prefix" >"$work/install.log" || { cat "$work/install.log"; fail "cmake --install"; }
for file in include/imgeo/imgeo.h share/man/man1/imgeo.1 share/bash-completion/completions/imgeo \
  share/zsh/site-functions/_imgeo share/fish/vendor_completions.d/imgeo.fish share/doc/imgeo/LICENSE; do
  [[ -s "$prefix/$file" ]] || fail "$file is missing or empty"
done
grep -q '^\.TH IMGEO 1' "$prefix/share/man/man1/imgeo.1" || fail "imgeo.1 is not the manual page"

# Every public header compiles on its own.
for header in "$prefix"/include/imgeo/*.h; do
  "$compiler" -std=c++20 -Wall -Wextra -Werror -fsyntax-only -I"$prefix/include" -include "$header" -x c++ /dev/null ||
    fail "$(basename "$header") does not stand alone"
done

cmake -S "$source/examples/cpp" -B "$work/example" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_CXX_COMPILER="$compiler" >"$work/configure.log" 2>&1 || { cat "$work/configure.log"; fail "find_package"; }
cmake --build "$work/example" >"$work/build.log" || { cat "$work/build.log"; fail "the example does not build"; }

cat >"$work/tetrahedron.obj" <<'OBJ'
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 2 3 4
f 3 1 4
OBJ
output="$("$work/example/convert_and_verify" "$work/tetrahedron.obj" "$work/site")" || fail "the example failed: $output"
[[ "$output" == *$'4 triangles in 1 patches'* ]] || fail "unexpected output: $output"
[[ "$output" == *$'\nequal\n'* ]] || fail "unexpected output: $output"
[[ "$output" == *'12 vertices, 12 indices'* ]] || fail "unexpected output: $output"

version="$("$prefix/bin/imgeo" --version)"
[[ "$output" == "$version"$'\n'* ]] || fail "the tool is $version, the library is not"
"$prefix/bin/imgeo" verify "$work/site" "$work/tetrahedron.obj" >/dev/null || fail "the installed tool finds a difference"

# The examples that publish live streams: C++ with imgeo::live, C with imgeo::live_c, Python with the shared library.
cmake -S "$source/examples/live" -B "$work/live" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_CXX_COMPILER="$compiler" >"$work/configure.log" 2>&1 || { cat "$work/configure.log"; fail "find_package"; }
cmake --build "$work/live" >"$work/build.log" || { cat "$work/build.log"; fail "the examples of live streams do not build"; }
library="$(find "$prefix" -name libimgeo-live.so)"
for example in "$work/live/waves" "$work/live/waves_c" "python3 $source/examples/live/waves.py"; do
  output="$(IMGEO_LIVE_LIBRARY="$library" $example 5 0)" || fail "$example failed: $output"
  [[ "$output" == http://127.0.0.1:*/live/waves*"5 frames, "* ]] || fail "$example: unexpected output: $output"
done
