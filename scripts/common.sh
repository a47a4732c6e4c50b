# Sourced by the other scripts: what several of them need.

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# What another checkout of the same sources has compiled is as good (ccache).
export CCACHE_BASEDIR=${CCACHE_BASEDIR-$source_dir} CCACHE_NOHASHDIR=${CCACHE_NOHASHDIR-1}

# How many compilers may run at once: one a processor, but 1.5 GB of free memory each (the CGAL files
# need 1 GB).
build_jobs() {
    local by_memory processors
    processors=$(nproc)
    by_memory=$(awk '/^MemAvailable:/ { print int($2 / 1500000) }' /proc/meminfo)
    [ "$by_memory" -ge 1 ] || by_memory=1
    echo $((by_memory < processors ? by_memory : processors))
}

# configure_and_build PRESET [TARGET...]: quiet about what went well.
configure_and_build() {
    local preset=$1 log
    shift
    log=$(mktemp)
    if ! (cd "$source_dir" && cmake --preset "$preset") >"$log" 2>&1; then
        cat "$log" >&2
        rm -f "$log"
        return 1
    fi
    rm -f "$log"
    (cd "$source_dir" && NINJA_STATUS='[%f/%t %es] ' cmake --build --preset "$preset" \
        --parallel "$(build_jobs)" ${1+--target "$@"})
}

# on_loopback COMMAND...: runs it where there is no network but loopback, if this machine lets us make
# such a place; else as it is (every DDS profile of ours keeps to 127.0.0.1 anyhow).
on_loopback() {
    if command -v ip >/dev/null && unshare --net ip link set lo up 2>/dev/null; then
        unshare --net sh -c 'ip link set lo up && exec "$@"' on_loopback "$@"
    else
        "$@"
    fi
}
