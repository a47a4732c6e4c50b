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

echo "-- manual pages and completion"
for page in 'GRASPCTL 1:man1/graspctl.1' 'GRASPD 8:man8/graspd.8'; do
    grep -q "^.TH ${page%:*} " "/usr/share/man/${page#*:}" || fail "${page#*:}"
done
grep -q '^#compdef graspctl' /usr/share/zsh/vendor-completions/_graspctl || fail "_graspctl"
offered=$(bash -c '. /usr/share/bash-completion/completions/graspctl
    COMP_WORDS=(graspctl pl) COMP_CWORD=1; _graspctl; echo "${COMPREPLY[@]}"')
[ "$offered" = plan ] || fail "completion of pl: '$offered'"

echo "-- a plan in the process"
graspctl plan /check/stacking_cup.ply --top 1

echo "-- a report page"
graspctl plan /check/stacking_cup.ply --report /tmp/report >/tmp/reply || fail "plan --report"
for file in report.html reply.json reply.txt; do
    [ -s /tmp/report/$file ] || fail "--report: no $file"
done

echo "-- the daemon and a request"
graspd --domain 77 2>/tmp/graspd.log &
daemon=$!
graspctl request /check/stacking_cup.ply --domain 77 --top 1 --timeout 10000 --retries 2 >/tmp/reply ||
    { cat /tmp/graspd.log; fail "request"; }
head -n 3 /tmp/reply
kill -TERM $daemon
wait $daemon || fail "graspd ended with $?"

echo "-- what was installed, seen with tools that graspd does without"
install python3 systemd
python3 -B /check/read_report.py /tmp/report/report.html || fail "report.html"
unit=$(find /usr/lib/systemd /lib/systemd -name graspd.service | head -n 1)
grep -q '^ExecStart=/usr/bin/graspd --supervise' "$unit" || fail "unit '$unit'"
systemd-analyze verify --man=no "$unit" >/tmp/verify 2>&1 || { cat /tmp/verify; fail "systemd-analyze verify"; }
[ ! -s /tmp/verify ] || { cat /tmp/verify; fail "systemd-analyze verify warns"; }
systemd-analyze security --offline=true "$unit" 2>/dev/null | tail -n 1

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
