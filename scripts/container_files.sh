# Sourced by scripts/container: docker/compose.yaml and docker/k8s.yaml, as they are shipped, on podman.
# Where there is no systemd nobody runs podman's health checks but this script.

project=graspd-check
pod=graspd-pod-0

compose() { docker-compose -p $project -f docker/compose.yaml "$@"; }
compose_container() {
    podman ps -a -q --filter label=com.docker.compose.project=$project \
        --filter label=com.docker.compose.service="$1"
}

cleanup_files() {
    [ -z "${watch-}" ] || kill "$watch" 2>/dev/null || true
    [ -z "${DOCKER_HOST-}" ] || compose down -t 0 >/dev/null 2>&1 || true
    [ -z "${service-}" ] || kill "$service" 2>/dev/null || true
    one_node | podman kube down - >/dev/null 2>&1 || true
    rm -rf "${sockets-}"
}

# docker-compose speaks to podman through this socket.
serve_podman() {
    sockets=$(mktemp -d)
    podman system service -t 0 "unix://$sockets/podman.sock" >/dev/null 2>&1 &
    service=$!
    export DOCKER_HOST=unix://$sockets/podman.sock
    wait_for 10 test -S "$sockets/podman.sock"
}

watch_health() {
    while sleep 1; do
        podman healthcheck run "$(compose_container graspd)" >/dev/null 2>&1 || true
    done
}

# As it is shipped, for one node: podman is none but this.
one_node() { sed 's/replicas: .*/replicas: 1/' docker/k8s.yaml; }

# Where a planner has just been killed.
patient_request="graspctl request $box --top 1 --out /dev/null --timeout 3000 --retries 5 2>/dev/null &&
    echo answered"

answered_once() { podman logs "$1" 2>/dev/null | grep -q '^box: OK, [1-9]'; }

check_compose() {
    local begin found planner client
    serve_podman
    watch_health &
    watch=$!
    begin=$(milliseconds)
    # The client depends on a healthy planner: up ends when that is so.
    timeout 60 docker-compose -p $project -f docker/compose.yaml up -d --no-build \
        >"$sockets/log" 2>&1 && found=up || found=failed
    row "compose: up, client after healthy planner" "$found, $(($(milliseconds) - begin)) ms" "up" \
        "$(holds "$found" = up)"
    kill $watch
    [ "$found" = up ] || { cat "$sockets/log" >&2; return; }
    planner=$(compose_container graspd) client=$(compose_container client)
    wait_for 15 answered_once "$client" && found=answered || found=lost
    row "compose: the client's own request" "$found" "answered" "$(holds $found = answered)"
    found=$(inside "$client" "$ten_requests")
    row "compose: requests answered with grasps" "$found" "10 of 10" "$(holds "$found" = "10 of 10")"
    found=$(podman inspect "$planner" \
        -f '{{.HostConfig.Memory}} {{.HostConfig.PidsLimit}} {{.HostConfig.ReadonlyRootfs}}')
    row "compose: memory, processes, read-only" "$found" "4294967296 256 true" \
        "$(holds "$found" = "4294967296 256 true")"
    signal_planner "$planner" KILL
    found=$(inside "$client" "$patient_request")
    row "compose: request after a kill" "$found" "answered" "$(holds "$found" = answered)"
    begin=$(milliseconds)
    compose stop >/dev/null 2>&1
    found=$(podman inspect -f '{{.State.ExitCode}}' "$planner" "$client" | tr '\n' ' ')
    row "compose: stop, exit codes" "$found" "0 0" "$(holds "$found" = "0 0 ")"
    compose down >/dev/null 2>&1
}

# The words of a probe's command in docker/k8s.yaml.
probe() { sed -n "/$1:/,/command:/s/.*command: \[\(.*\)\].*/\1/p" docker/k8s.yaml | tr -d '",'; }

check_pod() {
    local begin found planner=$pod-graspd started
    begin=$(milliseconds)
    one_node | podman kube play - >/dev/null
    wait_for 20 is_ready $planner || true
    found=$(($(milliseconds) - begin))
    row "pod: play to ready" "$found ms" "<= 10000 ms" "$(holds $found -le 10000)"
    # podman runs startup probes from 4.5 on.
    # shellcheck disable=SC2046
    podman exec $planner $(probe startupProbe) >/dev/null 2>&1 && found=passed || found=failed
    row "pod: startup probe" "$found" "passed" "$(holds "$found" = passed)"
    found=$(health_of $planner)
    row "pod: liveness probe" "$found" "healthy" "$(holds "$found" = healthy)"
    check_confinement $planner "pod: "
    found=$(podman run --rm --network host "${confined[@]}" --entrypoint sh "$image" \
        -c "$ten_requests")
    row "pod: requests from a container beside it" "$found" "10 of 10" "$(holds "$found" = "10 of 10")"
    started=$(podman inspect -f '{{.State.StartedAt}}' $planner)
    signal_planner $planner STOP
    found=$(for ((i = 0; i < 3; ++i)); do health_of $planner; done | sort -u)
    row "pod: liveness probe of a stuck planner" "$found" "unhealthy" "$(holds "$found" = unhealthy)"
    [ "$started" != "$(podman inspect -f '{{.State.StartedAt}}' $planner)" ] &&
        found=restarted || found=left
    row "pod: after three of these" "$found" "restarted" "$(holds $found = restarted)"
    found=$(inside $planner "$patient_request")
    row "pod: then a request" "$found" "answered" "$(holds "$found" = answered)"
    begin=$(milliseconds)
    one_node | podman kube down - >/dev/null
    found=$(($(milliseconds) - begin))
    row "pod: down" "$found ms" "<= 5000 ms" "$(holds $found -le 5000)"
}

# Its exit code is the number of promises missed.
check_files() {
    trap cleanup_files EXIT
    cleanup_files
    check_compose
    check_pod
    exit $failures
}
