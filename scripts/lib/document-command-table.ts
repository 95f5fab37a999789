/** How each command in the documents is tested. A command missing here, or no longer in a document, fails the test. */

import type { Treatment } from './document-treatment.ts';

export type { Treatment } from './document-treatment.ts';

const ALONE = ['--admin-port', '0', '--signaling', 'ws://127.0.0.1:9'];
const FREE_LINK = ['--port', '0', '--admin-port', '0'];
const FREE_SIGNALING = ['--port', '0', '--reference-robot-port', '0', '--reference-client-port', '0'];
const FREE_BRIDGE = ['--control-port', '0', '--telemetry-port', '0', '--streaming-port', '0', ...ALONE];
const robot: Treatment = {
  up: 'health and metrics',
  also: [...ALONE, '--sim-size', '16'],
  fill: { '…': 'x' },
};
const MEASURES = { help: true, because: 'measures for minutes' } as const;
const SYNTHETIC = {
  options: 'examples/synthetic_camera.py',
  because: 'runs until it is ended, and every test of it',
} as const;
const WHEELS = { because: 'runs until it is ended, and every test of it' } as const;
const NO_PRODUCER = ['--shm-folder', '/dev/shm/farpoint-without-a-producer', '--wait-s', '0'];
const shm: Treatment = { refused: /^could not start: shm: /, also: [...ALONE, ...NO_PRODUCER] };

export const TREATMENTS: Readonly<Record<string, Treatment>> = {
  // The local stack, and its programs one by one.
  'npx -y pnpm@12 dev': { help: true, because: 'runs until it is ended, and every test of it' },
  'npx -y pnpm@12 test': { help: true, because: 'runs until it is ended, and every test of it' },
  'pnpm test': { help: true, because: 'runs until it is ended, and every test of it' },
  'pnpm test --only lint,types,stack': {
    help: true,
    because: 'runs until it is ended, and every test of it',
  },
  'pnpm test --help': { help: true },
  'pnpm test --all': { help: true, because: 'runs until it is ended, and every test of it' },
  'pnpm test --pictures': { help: true, because: 'runs until it is ended, and every test of it' },
  'pnpm test --changed': { help: true, because: 'runs until it is ended, and every test of it' },
  'pnpm test --changed --all': { help: true, because: 'runs until it is ended, and every test of it' },
  'pnpm test --only pure --repeat 10 --load 2': {
    help: true,
    because: 'runs until it is ended, and every test of it',
  },
  'pnpm test --only stack --repeat 3 --load 4 --cpus 1': {
    help: true,
    because: 'runs until it is ended, and every test of it',
  },
  'pnpm soak': { help: true, because: 'runs until it is ended, and every test of it' },
  'pnpm soak --list': { help: true },
  'pnpm soak --resume': { help: true, because: 'runs until it is ended, and every test of it' },
  'pnpm soak --mutants': { help: true, because: 'runs until it is ended, and every test of it' },
  'pnpm soak load properties --seed 7': {
    help: true,
    because: 'runs until it is ended, and every test of it',
  },
  'pnpm page': { help: true, because: 'runs until it is ended, and every test of it' },
  'pnpm mutants': { help: true, because: 'runs until it is ended, and every test of it' },
  'pnpm mutants grip-never-read-late': {
    help: true,
    because: 'runs until it is ended, and every test of it',
  },
  'pnpm test:pure': { help: true, because: 'runs until it is ended, and every test of it' },
  'pnpm --filter @farpoint/rtp test': { because: 'runs until it is ended, and every test of it' },
  'npx -y pnpm@12 janus': { help: true, because: 'runs until it is ended, and every test of it' },
  'pnpm janus': { help: true, because: 'runs until it is ended, and every test of it' },
  'pnpm janus --help': { help: true },
  'pnpm robot --sim-charge 15': robot,
  'pnpm robot --sim-things "0.9,0,0.09"': robot,
  'pnpm robot': robot,
  'pnpm signaling': { up: 'listening', also: FREE_SIGNALING },
  'pnpm issuer': { refused: /--url.* must be given/, also: ['--port', '0', '--admin-port', '0'] },
  'pnpm issuer --help': { help: true },
  'pnpm --filter @farpoint/issuer build': { because: 'builds for minutes' },
  'pnpm bridge': { up: 'health and metrics', also: FREE_BRIDGE },
  'pnpm emulate': { up: 'health and metrics', also: FREE_LINK },
  'pnpm robot --help': { help: true },
  'pnpm robot --help all': { help: true },
  'pnpm robot init': { help: true, because: 'writes into the working tree' },
  'npx -y pnpm@12 robot --signaling wss://signal.example.org --id rover-1 --name "Rover" --token …': robot,
  'npx -y pnpm@12 robot --signaling ws://127.0.0.1:3100 --id bad --name "Behind 8 Mbit/s"': robot,
  'npx -y pnpm@12 robot --foxglove-port 8765 …': robot,
  'npx -y pnpm@12 robot --fence-radius-m 20': robot,
  'npx -y pnpm@12 robot --fence yard.geojson --fence-origin 48.1374,11.5755': {
    refused: /--fence cannot be read: /,
    also: ALONE,
  },
  'rostopic pub -r 10 /stop std_msgs/Bool false': { because: 'needs a ROS installation' },
  "ros2 topic pub -r 10 /stop std_msgs/msg/Bool 'data: false'": { because: 'needs a ROS installation' },
  'npx -y pnpm@12 robot --record session.mcap …': robot,
  'npx -y pnpm@12 robot --record-folder /data/recordings …': robot,
  'npx -y pnpm@12 robot --source recording --path drive.mcap --topic /velodyne_points …': {
    refused: /^could not start: recording: drive\.mcap does not exist$/,
    also: ALONE,
  },
  // It would write where robots of this machine do.
  'npx -y pnpm@12 robot --sink shm': { help: true },
  'npx -y pnpm@12 robot --source shm': shm,
  'npx -y pnpm@12 robot --source shm --shm-layout reference --fps 18': shm,
  'npx -y pnpm@12 robot --source shm --sink shm …': shm,
  'npx -y pnpm@12 robot --source shm --shm-layout reference --fps 18 --sink shm …': shm,
  'NODE_PATH=~/rcl/node_modules npx -y pnpm@12 robot …': robot,
  'npx -y pnpm@12 emulate': { up: 'health and metrics', also: FREE_LINK },
  'npx -y pnpm@12 emulate --rate-mbps 8 --rtt-ms 60 --loss 0.02': {
    up: 'health and metrics',
    also: FREE_LINK,
  },
  'pnpm bridge --signaling ws://SIGNALING:3002': {
    up: 'health and metrics',
    also: FREE_BRIDGE,
  },
  'node signaling.mjs --host 0.0.0.0 --port 443 --tls-cert fullchain.pem --tls-key privkey.pem': {
    refused: /--tls-cert cannot be read: fullchain\.pem does not exist/,
    also: ['--host', '127.0.0.1', '--port', '0', '--no-reference'],
  },
  'farpoint-robot audit verify /var/lib/farpoint/audit.jsonl*': { help: true },
  'node signaling.mjs audit verify audit.jsonl': { help: true },
  'pnpm robot audit verify FILE…': { help: true },
  'pnpm signaling audit verify FILE…': { help: true },
  'pnpm test --only scenario': { help: true, because: 'runs until it is ended, and every test of it' },
  'pnpm test --only supply': { help: true, because: 'runs until it is ended, and every test of it' },
  'docker buildx imagetools inspect node:24-alpine': { because: 'needs a container engine' },
  'pnpm signaling grant …': { help: true },
  'node signaling.mjs grant keygen': { help: true },
  "node signaling.mjs grant issue --name 'Ada Lovelace' --role drive --robots 'kitchen-*' --days 30 --for THUMBPRINT":
    { help: true },
  "node signaling.mjs grant issue --name Grace --role supervise --robots '*' --days 7 --with-key > grace.ticket":
    { help: true },
  'node signaling.mjs grant show grace.ticket --keys grant-keys.json --robot kitchen-1': { help: true },
  'node signaling.mjs grant revoke --list revoked.jws --id p5bGbAm3i8CqEIfn': { help: true },
  "node signaling.mjs grant revoke --list revoked.jws --subject 'Ada Lovelace'": { help: true },
  'npx -y pnpm@12 conformance signaling --robot ws://HOST:3001 --client ws://HOST:3002': { help: true },
  'npx -y pnpm@12 conformance robot --name ROBOT --client ws://HOST:3002': { help: true },
  'npx -y pnpm@12 conformance bridge --robot ws://HOST:3001 --client ws://HOST:3002 --control ws://HOST:8085 --telemetry ws://HOST:8090 --streaming ws://HOST:8095':
    { help: true },
  'python3 examples/wheels.py': WHEELS,
  'cc -O2 -o wheels examples/wheels.c && ./wheels': WHEELS,
  'python3 examples/synthetic_camera.py': SYNTHETIC,
  'python3 examples/synthetic_camera.py --layout reference --fps 18': SYNTHETIC,

  // Installation.
  'sudo apps/robot-node/deploy/install.sh --source shm': {
    options: 'apps/robot-node/deploy/install.sh',
    because: 'needs root',
  },
  'farpoint-robot doctor --config /etc/farpoint/robot.yaml': { help: true },
  'sudo -u farpoint farpoint-robot release --id ROBOT --state-dir /var/lib/farpoint': { help: true },
  'farpoint-robot release': { help: true },
  'pnpm robot release': { help: true },
  'farpoint-robot init --schema': { help: true },
  'farpoint-robot init --source KIND': { help: true },
  'farpoint-robot init --source ros2': { help: true },
  'systemctl kill -s HUP farpoint-robot': { because: 'needs systemd' },
  'sudo systemctl start farpoint-robot': { because: 'needs systemd' },
  'systemctl status farpoint-robot': { because: 'needs systemd' },
  'sudo systemctl kill -s KILL farpoint-robot': { because: 'needs systemd' },
  'journalctl -u farpoint-robot -p warning': { because: 'needs systemd' },
  'journalctl -u farpoint-robot -n 50': { because: 'needs systemd' },
  'curl -s localhost:9400/healthz': { because: 'needs a robot that is installed' },
  'sudo systemd-run --pipe --wait --collect -p User=farpoint -p EnvironmentFile=/etc/farpoint/robot.env farpoint-robot doctor --config /etc/farpoint/robot.yaml':
    { because: 'needs systemd' },
  'sudo npx -y pnpm@12 exec node apps/robot-node/deploy/try-unit.ts': { because: 'needs root' },
  'sudo npx -y pnpm@12 exec node apps/robot-node/deploy/try-image.ts --arch arm64': {
    options: 'apps/robot-node/deploy/try-image.ts',
    because: 'needs root',
  },
  'sudo install -D -m 644 apps/signaling/dist/signaling.mjs /opt/farpoint/signaling.mjs': {
    because: 'needs root',
  },
  'sudo cp -r apps/webxr/dist /opt/farpoint/web': { because: 'needs root' },
  'sudo install -m 644 apps/signaling/deploy/farpoint-signaling.service /etc/systemd/system/': {
    because: 'needs root',
  },
  "sudo install -D -m 600 /dev/stdin /etc/farpoint/signaling.env <<'ENV'": { because: 'needs root' },
  'sudo systemctl daemon-reload && sudo systemctl enable --now farpoint-signaling': {
    because: 'needs systemd',
  },
  'sudo usermod -aG gpio,audio,video farpoint': { because: 'needs root' },
  'systemctl edit farpoint-robot': { because: 'needs systemd' },

  // Containers.
  'docker ps': { because: 'needs a container engine' },
  'docker build -f apps/robot-node/Dockerfile -t farpoint-robot .': { because: 'needs a container engine' },
  'sudo mkdir -p /etc/farpoint': { because: 'needs root' },
  'sudo install -d -m 750 -o "$(id -u)" /var/lib/farpoint': { because: 'needs root' },
  'docker run --rm farpoint-robot init --source shm --output - | sudo tee /etc/farpoint/robot.yaml': {
    because: 'needs a container engine',
  },
  'docker run -d --name farpoint-robot --restart unless-stopped --network host --ipc host --user "$(id -u)" -v /var/lib/farpoint:/var/lib/farpoint -v /etc/farpoint:/etc/farpoint:ro --env-file /etc/farpoint/robot.env farpoint-robot':
    { because: 'needs a container engine' },
  'docker run --rm --network host --ipc host --user "$(id -u)" -v /var/lib/farpoint:/var/lib/farpoint -v /etc/farpoint:/etc/farpoint:ro --env-file /etc/farpoint/robot.env farpoint-robot doctor':
    { because: 'needs a container engine' },
  'docker build -f apps/signaling/Dockerfile -t farpoint-signaling .': {
    because: 'needs a container engine',
  },
  'docker run -d --name farpoint-signaling --restart unless-stopped --read-only --cap-drop ALL -p 127.0.0.1:3000:3000 -v /etc/farpoint:/etc/farpoint:ro -e FARPOINT_SIGNALING_OPERATOR_TOKENS=/etc/farpoint/operator-tokens.yaml -e FARPOINT_SIGNALING_ROBOT_TOKENS=/etc/farpoint/robot-tokens.yaml -e FARPOINT_SIGNALING_TRUST_PROXY=private -e FARPOINT_SIGNALING_PUBLIC_NAMES=teleop.example.org farpoint-signaling':
    { because: 'needs a container engine' },

  // Building, and its prerequisites.
  'npx -y pnpm@12 build': { because: 'builds for minutes' },
  'pnpm build': { because: 'builds for minutes' },
  'npx -y pnpm@12 build:native': { because: 'builds for minutes' },
  'npx -y pnpm@12 build:native dds': { because: 'builds for minutes' },
  'npx -y pnpm@12 build:native video': { because: 'builds for minutes' },
  'npx -y pnpm@12 build:native sound': { because: 'builds for minutes' },
  'npx -y pnpm@12 --filter @farpoint/operator --filter @farpoint/cloud-view pack --out %s.tgz': {
    because: 'writes into the working tree',
  },
  'pnpm build:native': { because: 'builds for minutes' },
  'pnpm build:wasm': { because: 'needs Rust' },
  'cargo fmt --all': { because: 'needs Rust' },
  'cargo run --release -p xtask -- train-tables FILE': { because: 'needs Rust' },
  'cargo run --release -p farpoint-unorganised-codec --example train_tables': { because: 'needs Rust' },
  'pnpm release': { help: true, because: 'writes into the working tree' },
  'pnpm release --dry-run': { help: true, because: 'builds for minutes' },
  'pnpm release --help': { help: true },
  'pnpm docs:images': { because: 'writes into the working tree' },
  'pnpm docs:images -g dashboard': { because: 'writes into the working tree' },
  'pnpm docs:images -g screens': { because: 'writes into the working tree' },
  'pnpm run sbom': { because: 'writes into the working tree' },
  'pnpm docs:api': { because: 'writes into the working tree' },
  'pnpm format': { because: 'writes into the working tree' },
  'pnpm exec vitest packages/protocol': { because: 'runs until it is ended, and every test of it' },
  'pnpm --dir e2e exec playwright test -g "in the headset"': {
    because: 'runs until it is ended, and every test of it',
  },
  'pnpm test --only firefox': { help: true, because: 'runs until it is ended, and every test of it' },
  'pnpm --dir e2e exec playwright test --project firefox': {
    because: 'runs until it is ended, and every test of it',
  },
  'apt-get install firefox-esr xvfb': { because: 'needs root' },
  'apt-get install cyclonedds-dev': { because: 'needs root' },
  'sudo apt-get install janus': { because: 'needs root' },
  'sudo apt-get install build-essential python3': { because: 'needs root' },
  'sudo apt-get install cyclonedds-dev build-essential python3': { because: 'needs root' },
  'sudo apt-get install libgstreamer1.0-dev libgstreamer-plugins-base1.0-dev gstreamer1.0-plugins-base gstreamer1.0-plugins-good gstreamer1.0-alsa build-essential pkg-config python3':
    { because: 'needs root' },
  'sudo apt-get install libgstreamer1.0-dev libgstreamer-plugins-base1.0-dev gstreamer1.0-plugins-base gstreamer1.0-plugins-good gstreamer1.0-plugins-ugly gstreamer1.0-plugins-bad build-essential pkg-config python3':
    { because: 'needs root' },
  'sudo sysctl -w net.core.rmem_max=8388608': { because: 'needs root' },
  'source /opt/ros/jazzy/setup.bash': { because: 'needs a ROS installation' },
  'mkdir -p ~/rcl && npm install --prefix ~/rcl rclnodejs': { because: 'needs a ROS installation' },

  // Benchmarks.
  'pnpm attack': MEASURES,
  'pnpm attack --list': MEASURES,
  'pnpm attack --only peer': MEASURES,
  'pnpm attack --flood SECONDS': MEASURES,
  'pnpm fuzz': MEASURES,
  'pnpm fuzz --inputs 10000000 --seed 2': MEASURES,
  'pnpm bench --help': { help: true },
  'pnpm bench … --json': { help: true },
  ...Object.fromEntries(
    [
      'mtp',
      'link',
      'link --mode auto',
      'transport',
      'sampler',
      'pack',
      'codec',
      'codec --cloud …',
      'guard-runs',
      'guard-runs --rooms',
      'guard-runs --sensors drawn',
      'connect --busy 2',
      'bridge --profile --points 22500',
      'codec --cloud FILE…',
      'connect',
      'switch',
      'bridge',
      'bridge --profile',
      'signaling',
      'shm',
      'shm --kill N',
      'dds',
      'ros1',
      'pictures',
      'cameras',
      'cameras --receiver NAME',
      'janus',
      'sim',
      'recording',
      'recording --videos 3 --seconds 40',
      'congestion',
      'guard',
      'first-drive',
      'load',
      'stopping',
      'faults',
      'safety',
      'sampling --plot FILE.svg',
      'memory',
      'prediction',
      'view',
      'view --video',
    ].map((rest) => [`pnpm bench ${rest}`, MEASURES]),
  ),
  'npx -y pnpm@12 bench cameras --thesis --plot cameras.svg': MEASURES,
  'npx -y pnpm@12 bench cameras --thesis --over lte.csv': MEASURES,
  'npx -y pnpm@12 bench cameras --cameras 1024x768@30:512,1920x1080@30:2048': MEASURES,
  'npx -y pnpm@12 bench cameras --sound --points all --cloud-fps 15 --over lte.csv': MEASURES,
  'npx -y pnpm@12 bench link --seconds 30 --plot link.svg': MEASURES,
  'npx -y pnpm@12 bench link --trace FILE.csv --seconds 60 --json': MEASURES,
  'npx -y pnpm@12 bench link --rate-mbps 20 --cross cubic --seconds 40': MEASURES,
  'npx -y pnpm@12 bench link --mode auto': MEASURES,
  'npx -y pnpm@12 bench link --mode auto --sensors 2': MEASURES,
  'npx -y pnpm@12 bench repair': MEASURES,
  'npx -y pnpm@12 bench repair --robot="--mode points64 --fps 15 --rate-control fixed --bitrate-mbps 8"': {
    because: 'measures for minutes',
  },
  'npx -y pnpm@12 bench picture --rate-mbps 8 --out picture.png': MEASURES,
};
