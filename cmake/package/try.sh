#!/usr/bin/env bash
# Tries the packages of a folder on a bare Debian 12 in a chroot (as root or with sudo), as an ordinary user would.
#   try.sh FOLDER      FOLDER: ensonify_*.deb, ensonify-dev_*.deb and ensonify-*.whl; FOLDER/chroot is left after a failure
set -euo pipefail
[ "$(id -u)" -eq 0 ] || exec sudo "$0" "$@"
[ "${ENSONIFY_TRY:-}" = inside ] || ENSONIFY_TRY=inside exec unshare --mount "$0" "$@"  # mounts end with this script

source=$(dirname "$(readlink -f "$0")")
packages=$(readlink -f "$1")
root=$packages/chroot
began=$SECONDS

say() { printf '== %s (%d s)\n' "$*" $((SECONDS - began)); }
in_chroot() { chroot "$root" /usr/bin/env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"; }
as_user() { chroot --userspec=sailor:sailor "$root" /usr/bin/env -i HOME=/home/sailor PATH=/usr/bin:/bin LC_ALL=C.UTF-8 bash -ec "cd; $1"; }

# Where this machine's apt finds Debian, the chroot's does too.
targets() { apt-get indextargets --format "$1" 'Created-By: Packages' 'Origin: Debian' 'Component: main' | sort --unique; }
mirror=$(targets '$(CODENAME) $(REPO_URI)' | sed --quiet 's/^bookworm //p' | head -1)
[ -n "$mirror" ] || { echo "try.sh: apt knows no Debian 12 (apt-get update?)" >&2; exit 2; }

say "making a bare Debian 12"
rm -rf --one-file-system "$root"
mkdir -p "$root"
debootstrap --variant=minbase bookworm "$root" "$mirror" >"$packages/debootstrap.log" || { tail "$packages/debootstrap.log" >&2; exit 1; }
targets 'deb $(REPO_URI) $(RELEASE) main' >"$root/etc/apt/sources.list"
apt-config dump | { grep --extended-regexp '^Acquire::(https?|Check)' || true; } >"$root/etc/apt/apt.conf.d/90host"
cp /etc/resolv.conf /etc/hosts "$root/etc/"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount -t tmpfs tmpfs "$root/tmp"
cp "$packages"/*.deb "$packages"/*.whl "$source/check_survey.py" "$root/tmp/"
cp -r "$source/../consumer" "$root/tmp/consumer"
in_chroot apt-get update --quiet --quiet
in_chroot useradd --create-home --shell /bin/bash sailor

say "installing ensonify, with what it depends on and no more"
install() { in_chroot apt-get install --quiet --quiet --yes --no-install-recommends "$@" >>"$packages/apt.log" 2>&1 || { tail "$packages/apt.log" >&2; exit 1; }; }
: >"$packages/apt.log"
install "$(cd "$packages" && ls ensonify_*.deb | sed 's,^,/tmp/,')"

say "surveying the bay"
as_user 'ensonify run /usr/share/ensonify/launch/demo.yaml --free --out out'
as_user 'ls -l out'
as_user 'python3 /tmp/check_survey.py out'

say "checking every launch file"
as_user 'for launch in /usr/share/ensonify/launch/*.yaml; do
  case $launch in
    */survey.yaml) continue ;;  # takes a raster of the user
    */replay.yaml) arguments="--arg record=out/demo.mcap" ;;
    *) arguments= ;;
  esac
  ensonify check $launch $arguments >check.txt 2>&1 || { cat check.txt; exit 1; }
done'

say "help as installed"
as_user 'ensonify --version; ensonify doctor
  test -s /usr/share/doc/ensonify/docs/manual/wire.md
  for verb in $(ensonify --help | sed --quiet "s/^  \([a-z]*\) .*/\1/p"); do test -s /usr/share/man/man1/ensonify-$verb.1.gz; done
  source /usr/share/bash-completion/completions/ensonify
  COMP_WORDS=(ensonify terrain im) COMP_CWORD=2; _ensonify; test "${COMPREPLY[*]}" = import'

say "installing the wheel beside Debian's numpy, zmq and msgpack"
install python3-venv
as_user 'python3 -m venv --system-site-packages venv
  venv/bin/pip install --quiet --no-index /tmp/ensonify-*.whl
  venv/bin/python -c "
import ensonify
assert ensonify.__file__.startswith(\"/home/sailor/venv\"), ensonify.__file__
with ensonify.Record(\"out/demo.mcap\") as record:
    pings = sum(1 for message in record.messages(\"bow/soundings\"))
print(f\"ensonify {ensonify.__version__}: {pings} pings read\")
assert pings > 0"'

say "building a program with ensonify-dev"
install g++ cmake ninja-build "$(cd "$packages" && ls ensonify-dev_*.deb | sed 's,^,/tmp/,')"
as_user 'cmake -G Ninja -S /tmp/consumer -B consumer >cmake.txt && cmake --build consumer --target consumer >>cmake.txt || { cat cmake.txt; exit 1; }
  consumer/consumer'

say "removing ensonify"
in_chroot apt-get purge --quiet --quiet --yes ensonify >>"$packages/apt.log" 2>&1
test ! -e "$root/usr/share/ensonify"
umount --recursive "$root/dev" "$root/proc" "$root/tmp"
rm -rf --one-file-system "$root"
say "packages: all well"
