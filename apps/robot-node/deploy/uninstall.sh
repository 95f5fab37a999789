#!/bin/sh
# Removes what install.sh installed. Run as root: uninstall.sh [--dest DIR] [--purge]
#
# --purge  also remove configuration, secrets, recordings and the user
set -eu

dest='' purge=no
while [ $# -gt 0 ]; do
  case $1 in
    --dest) dest=${2:?--dest needs a folder}; shift 2 ;;
    --purge) purge=yes; shift ;;
    *) printf 'uninstall.sh: unknown argument %s\n' "$1" >&2; exit 1 ;;
  esac
done

if [ -z "$dest" ]; then
  systemctl disable --now farpoint-robot 2>/dev/null || true
fi
rm -rf "$dest/opt/farpoint"
rm -f "$dest/etc/systemd/system/farpoint-robot.service" "$dest/etc/sysctl.d/60-farpoint.conf" "$dest/usr/local/bin/farpoint-robot"
if [ "$purge" = yes ]; then
  rm -rf "$dest/etc/farpoint" "$dest/var/lib/farpoint"
  if [ -z "$dest" ] && id farpoint >/dev/null 2>&1; then
    # So that no later user with the same number inherits them.
    find /dev/shm -maxdepth 1 -user farpoint -delete
    userdel farpoint || printf 'the user farpoint still exists: stop its programs, then run `userdel farpoint`\n'
  fi
fi
if [ -z "$dest" ]; then systemctl daemon-reload; fi
printf 'removed%s\n' "$([ "$purge" = yes ] && printf ', including configuration and recordings' || printf '; /etc/farpoint and /var/lib/farpoint were kept')"
