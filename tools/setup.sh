#!/usr/bin/env bash
# Installs the Debian packages that are missing.
#
#   tools/setup.sh GROUP...        groups of tools/packages.txt: build, test, check, render, peers
#
# SESSILE_SETUP=skip leaves the system alone: for other systems, where the packages came another way.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/steps.sh"

[ "${SESSILE_SETUP-}" != skip ] || exit 0

ID='' VERSION_ID='' PRETTY_NAME=''
[ ! -r /etc/os-release ] || . /etc/os-release
if [ "$ID" != debian ] || [ "${VERSION_ID%%.*}" -lt 12 ] 2>/dev/null; then # testing and unstable have no number
  fail "this is ${PRETTY_NAME:-$(uname -s)}, not Debian 12 or newer: install what tools/packages.txt lists by hand," \
    "then set SESSILE_SETUP=skip"
fi

wanted=$(awk -v groups=" $* " '$1 !~ /^#/ && index(groups, " " $2 " ") {print $1}' tools/packages.txt)
[ -n "$wanted" ] || fail "no such group in tools/packages.txt: $*"
present=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' $wanted 2>/dev/null | awk '$2 == "installed" {print $1}' || true)
missing=$(for package in $wanted; do grep -qxF "$package" <<<"$present" || echo "$package"; done | paste -sd ' ')
[ -n "$missing" ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  by_hand="as root: apt-get install --no-install-recommends $missing"
  command -v sudo >/dev/null || fail "packages are missing, and there is no sudo to install them; run $by_hand"
  if ! sudo -n true 2>/dev/null; then
    [ -t 0 ] || fail "packages are missing, and sudo wants a password but has no terminal to ask; run $by_hand"
    sudo -v || fail "packages are missing, and sudo was refused; run $by_hand"
  fi
  as_root=(sudo)
fi

say "Missing packages: $missing"
install_missing() {
  local apt=(env DEBIAN_FRONTEND=noninteractive apt-get -y -o DPkg::Lock::Timeout=300 -o Acquire::Retries=1)
  "${as_root[@]}" "${apt[@]}" update || true # the lists at hand may do
  "${as_root[@]}" "${apt[@]}" install --no-install-recommends $missing
}

if ! run_step "Installing packages" setup.log install_missing; then
  log=$logs/setup.log
  if grep -qE 'Temporary failure resolving|Could not resolve|Could not connect|Unable to connect' "$log"; then
    reason="the package server cannot be reached: is there a network?"
  elif grep -q 'Unable to locate package' "$log"; then
    reason="apt does not know$(sed -n 's/^E: Unable to locate package//p' "$log" | paste -sd,): is Debian's component \"main\" in its sources?"
  else
    reason=$(grep '^E: ' "$log" | tail -n 1 || true)
  fi
  fail "packages could not be installed: $reason (log: $PWD/$log)"
fi
