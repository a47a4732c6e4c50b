#!/usr/bin/env bash
# Installs a build into a prefix of its own and uses it from there as a stranger would.
#   install_test.sh SOURCE_DIR BUILD_DIR CMAKE C_COMPILER CXX_COMPILER WITH_DDS
set -euo pipefail
source_dir=$1 build_dir=$2 cmake=$3 c_compiler=$4 cxx_compiler=$5 with_dds=$6
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix
fail() { echo "install_test: $*" >&2; exit 1; }

"$cmake" --install "$build_dir" --prefix "$prefix" >/dev/null

with_simulate=OFF optional='graspd/simulate/*'
[ -f "$(find "$prefix" -name graspdSimulateTargets.cmake)" ] && with_simulate=ON optional=none

echo "-- every public header of what was built is installed, and no other"
diff <(cd "$source_dir/include" && find graspd -name '*.hpp' ! -path "$optional" | sort) \
     <(cd "$prefix/include" && find graspd -name '*.hpp' | sort)

echo "-- a consumer outside the tree finds, links and runs it"
cp -r "$source_dir/tests/package/consumer" "$work/consumer"
awk '/^<!-- package-test: readme_client -->$/ { wanted = 1; next }
     wanted && /^```/ { if (inside) exit; inside = 1; next }
     inside' "$source_dir/README.md" >"$work/consumer/readme_client.cpp"
[ -s "$work/consumer/readme_client.cpp" ] || fail "README.md has no client"
"$cmake" -S "$work/consumer" -B "$work/consumer/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$c_compiler" \
    -DCMAKE_CXX_COMPILER="$cxx_compiler" -DWITH_DDS="$with_dds" -DWITH_SIMULATE=$with_simulate \
    >"$work/log" 2>&1 || { cat "$work/log"; fail "configure"; }
"$cmake" --build "$work/consumer/build" >"$work/log" 2>&1 || { cat "$work/log"; fail "build"; }
status=$("$work/consumer/build/plan_box" "$prefix/share/graspd/profiles/grippers/parallel_85.yaml")
echo "plan_box: $status"
[[ $status =~ ^OK\ [1-9] ]] || fail "no grasp on a box"
if [ "$with_simulate" = ON ]; then
    verdict=$("$work/consumer/build/hold_box")
    [ "$verdict" = holds ] || fail "hold_box: $verdict"
fi
if [ "$with_dds" = ON ]; then
    "$work/consumer/build/ask_planner" | tee "$work/log"
    grep -q /nowhere/loopback.xml "$work/log" || fail "ask_planner"
fi

echo "-- the installed graspctl reads the installed profiles, not the source tree's"
sed 's/parallel_85/only_installed/' "$source_dir/profiles/grippers/parallel_85.yaml" \
    >"$prefix/share/graspd/profiles/grippers/only_installed.yaml"
cd /
env -i "$prefix/bin/graspctl" grippers >"$work/grippers"
grep -q only_installed "$work/grippers" || { cat "$work/grippers"; fail "graspctl grippers"; }
env -i "$prefix/bin/graspctl" --version

echo "-- manual page and completion are there, and bash can use it"
grep -q '^.TH GRASPCTL 1 ' "$prefix/share/man/man1/graspctl.1" || fail "graspctl.1"
grep -q '^#compdef graspctl' "$prefix/share/zsh/vendor-completions/_graspctl" || fail "_graspctl"
offered=$(bash -c '. "$1/share/bash-completion/completions/graspctl"
    COMP_WORDS=(graspctl pl) COMP_CWORD=1; _graspctl; echo "${COMPREPLY[@]}"' bash "$prefix")
[ "$offered" = plan ] || fail "completion of pl: '$offered'"

if [ -x "$prefix/bin/graspd" ]; then
    grep -q '^.TH GRASPD 8 ' "$prefix/share/man/man8/graspd.8" || fail "graspd.8"
    echo "-- the installed daemon starts far enough to print its version and settings"
    env -i "$prefix/bin/graspd" --version
    env -i "$prefix/bin/graspd" --print-config >/dev/null
fi
