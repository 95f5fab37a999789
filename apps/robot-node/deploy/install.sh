#!/bin/sh
# Installs the robot from this checkout as a systemd service. Run as root:
#
#   apps/robot-node/deploy/install.sh [--source KIND] [--dest DIR] [--files-only]
#
# --source KIND  source for the configuration, which is written if there is none (farpoint-robot init --help)
# --dest DIR     install below DIR instead of /, for images and tests; nothing is started
# --files-only   only copy files: no user, no packages from the network, no service
#
# To upgrade, run it again: existing configuration and secrets are kept.
set -eu

say() { printf '%s\n' "$*"; }
die() { printf 'install.sh: %s\n' "$*" >&2; exit 1; }

source_kind=shm dest='' files_only=no
while [ $# -gt 0 ]; do
  case $1 in
    --source) source_kind=${2:?--source needs a kind}; shift 2 ;;
    --dest) dest=${2:?--dest needs a folder}; shift 2 ;;
    --files-only) files_only=yes; shift ;;
    *) die "unknown argument $1; the comment at the top of this file lists the arguments" ;;
  esac
done

here=$(cd "$(dirname "$0")" && pwd)
repository=$(cd "$here/../../.." && pwd)
opt=$dest/opt/farpoint
[ -f "$repository/pnpm-lock.yaml" ] || die "run it in a checkout: $repository has no pnpm-lock.yaml"
if [ -z "$dest" ] && [ "$files_only" = no ]; then
  [ "$(id -u)" = 0 ] || die 'run it as root'
  # In a container, systemctl may exist although systemd does not run.
  [ -d /run/systemd/system ] || die 'systemd does not run here: see docs/real-robot.md for the container'
fi

# A Node that runs TypeScript directly: the system's, or the workspace's.
runs_typescript() {
  "$1" -e 'const [a, b] = process.versions.node.split("."); process.exit(a > 22 || (a == 22 && b >= 18) ? 0 : 1)' 2>/dev/null
}
node=''
for candidate in "$(command -v node || true)" "$repository/node_modules/.bin/node"; do
  if [ -n "$candidate" ] && runs_typescript "$candidate"; then
    node=$("$candidate" -p process.execPath)
    break
  fi
done
[ -n "$node" ] || die 'Node 22.18 or newer is needed: install it, or run `npx -y pnpm@12 install` here first'

say "copying to $opt"
mkdir -p "$opt" "$dest/etc/farpoint" "$dest/etc/systemd/system" "$dest/etc/sysctl.d" "$dest/usr/local/bin"
rm -rf "$opt/packages" "$opt/apps" "$opt/wasm-codec" "$opt/docs" "$opt/examples" "$opt/scripts" "$opt/node_modules"
(
  cd "$repository"
  tar -c --exclude=node_modules --exclude=target --exclude=dist --exclude=coverage --exclude=native/build \
    package.json pnpm-lock.yaml pnpm-workspace.yaml LICENSE NOTICE packages apps/robot-node wasm-codec docs examples \
    scripts/build-native.ts
) | tar -x -C "$opt" --no-same-owner
mkdir -p "$opt/bin"
rm -f "$opt/bin/node"
cp "$node" "$opt/bin/node"
cat > "$opt/bin/farpoint-robot" <<'WRAPPER'
#!/bin/sh
folder=$(dirname "$(readlink -f "$0")")
exec "$folder/node" "$folder/../apps/robot-node/src/main.ts" "$@"
WRAPPER
chmod 755 "$opt/bin/farpoint-robot" "$opt/bin/node"
ln -sfn "$([ -n "$dest" ] && printf '../../../opt' || printf /opt)/farpoint/bin/farpoint-robot" "$dest/usr/local/bin/farpoint-robot"
install -m 644 "$here/farpoint-robot.service" "$dest/etc/systemd/system/farpoint-robot.service"
install -m 644 "$here/60-farpoint.conf" "$dest/etc/sysctl.d/60-farpoint.conf"
[ -e "$dest/etc/farpoint/robot.env" ] || install -m 600 "$here/robot.env" "$dest/etc/farpoint/robot.env"

if [ "$files_only" = no ]; then
  say 'fetching packages'
  (
    cd "$opt"
    export CI=1 npm_config_verify_deps_before_run=false
    npx -y pnpm@12 install --frozen-lockfile --prod --filter-prod '@farpoint/robot-node...'
  )
  say 'building the addons for shared memory, systemd and, if its library is installed, ROS 2'
  # With the Node whose headers are installed beside it.
  (cd "$opt" && "$node" scripts/build-native.ts)
fi

config=$dest/etc/farpoint/robot.yaml
if [ "$files_only" = no ] && [ ! -e "$config" ]; then
  "$opt/bin/farpoint-robot" init --source "$source_kind" --audit /var/lib/farpoint/audit.jsonl --output "$config"
fi

if [ -z "$dest" ] && [ "$files_only" = no ]; then
  if ! id farpoint >/dev/null 2>&1; then
    useradd --system --user-group --home-dir /var/lib/farpoint --no-create-home --shell /usr/sbin/nologin farpoint
  fi
  # For --stop-gpio. Groups that the machine does not have are left out.
  if getent group gpio >/dev/null; then usermod --append --groups gpio farpoint; fi
  chgrp farpoint "$config"
  sysctl -q -p /etc/sysctl.d/60-farpoint.conf || say 'the socket buffer sizes were not changed'
  systemctl daemon-reload
  systemctl enable farpoint-robot
fi
if [ -z "$dest" ] && [ "$files_only" = no ] && systemctl -q is-active farpoint-robot; then
  say 'done. The running robot is still the old version: run `systemctl restart farpoint-robot` when nobody drives.'
  exit
fi
say "done. Next: edit $config and $dest/etc/farpoint/robot.env, run \`farpoint-robot doctor --config $config\`,"
say 'then run `systemctl start farpoint-robot`.'
