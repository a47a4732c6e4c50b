#!/usr/bin/env bash
# What a newcomer does with the Debian packages in /packages; runs in an empty Debian, as root.
set -euo pipefail
export DEBIAN_FRONTEND=noninteractive
fail() { echo "use_packages: $*" >&2; exit 1; }
install() {
    apt-get -qq -o Dpkg::Use-Pty=0 install -y --no-install-recommends "$@" >/tmp/apt.log 2>&1 ||
        { tail -n 20 /tmp/apt.log; fail "apt-get install $*"; }
}

apt-get -qq update
before=$(dpkg-query -W | wc -l)
install /packages/graspd_*.deb /packages/libgraspd_*.deb
echo "-- installed $(($(dpkg-query -W | wc -l) - before)) packages, $(du -shx --exclude=/proc --exclude=/dev / | cut -f1) in all"
systemd_unit=$(find /usr/lib/systemd /lib/systemd -name graspd.service | head -n 1)
grep -q 'ExecStart=/usr/bin/graspd' "$systemd_unit" || fail "unit"

for file in man/man1/graspctl.1 man/man8/graspd.8 bash-completion/completions/graspctl; do
    [ -s "/usr/share/$file" ] || fail "$file"
done

echo "-- a plan in the process"
graspctl plan /check/stacking_cup.ply --top 1

echo "-- the daemon and a request"
graspd --domain 77 2>/tmp/graspd.log &
daemon=$!
graspctl request /check/stacking_cup.ply --domain 77 --top 1 --timeout 10000 --retries 2 >/tmp/reply ||
    { cat /tmp/graspd.log; fail "request"; }
head -n 3 /tmp/reply
kill -TERM $daemon
wait $daemon || fail "graspd ended with $?"

echo "-- a program that links the library"
install /packages/libgraspd-dev_*.deb cmake g++ make
cmake -S /check/consumer -B /tmp/consumer -DCMAKE_BUILD_TYPE=Release -DWITH_DDS=OFF -DWITH_SIMULATE=OFF \
    >/tmp/cmake.log 2>&1 || { cat /tmp/cmake.log; fail "configure"; }
cmake --build /tmp/consumer >/tmp/cmake.log 2>&1 || { cat /tmp/cmake.log; fail "build"; }
status=$(/tmp/consumer/plan_box /usr/share/graspd/profiles/grippers/parallel_85.yaml)
echo "plan_box: $status"
[[ $status =~ ^OK\ [1-9] ]] || fail "no grasp on a box"

echo "-- gone without a trace"
apt-get -qq purge -y graspd libgraspd libgraspd-dev >/tmp/apt.log 2>&1 || fail "purge"
[ -z "$(find / -xdev -name '*graspd*' ! -path '/packages/*' ! -path '/check/*' ! -path '/tmp/*' ! -path '/proc/*' ! -path '/dev/*' ! -path '/var/lib/apt/*' ! -path '/var/log/*' ! -path '/var/cache/*')" ] || fail "files left"
echo "packages: all as it should be"
