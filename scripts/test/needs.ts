/** What the tests use besides the workspace's own packages: where to get it, and what is not tested without it. */
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import {
  CHROMIUM_REMEDY,
  findChromium,
  findFirefox,
  findHeadlessShell,
  findJanus,
  findProgram,
  firefoxNeedsDisplay,
} from '@farpoint/local-stack';
import { Ros1Peers } from '../../packages/ros/src/testing/ros1-peers.ts';
import { root, run } from '../lib/run.ts';

export interface Need {
  /** As `tests/groups.yaml` names it. */
  name: string;
  /** Debian's packages that bring it. */
  packages: readonly string[];
  /** Another way to get it, which is tried first. */
  fetch?(): Promise<unknown>;
  /** A Python package that pip installs into a folder of its own. */
  python?: { folder: string; install: readonly string[] };
  isThere(): Promise<boolean>;
  /** What is not tested without it, with the remedy; `null`: everything is, only more slowly. */
  without: string | null;
  /** The steps that need it. */
  steps: readonly string[];
}

/** GStreamer: what the programs for video and sound are built on, and what they and their tests use when they run. */
const GSTREAMER = {
  packages: [
    'pkg-config',
    'libgstreamer1.0-dev',
    'libgstreamer-plugins-base1.0-dev',
    'gstreamer1.0-plugins-base',
    'gstreamer1.0-plugins-good',
    'gstreamer1.0-plugins-ugly',
    'gstreamer1.0-plugins-bad',
    'gstreamer1.0-tools',
  ],
  libraries: ['gstreamer-1.0', 'gstreamer-app-1.0', 'gstreamer-video-1.0'],
  /** One element of each set of plugins. */
  elements: ['videotestsrc', 'vp8enc', 'x264enc', 'h264parse', 'opusenc', 'opusdec'],
} as const;

/** Folders of the tests' own Pythons. `FARPOINT_PYTHON` and `FARPOINT_DDS_PYTHON` name others. */
const PYTHON = join(root, '.farpoint', 'python');
const DDS_PYTHON = join(root, '.farpoint', 'python-dds');

export const NEEDS: readonly Need[] = [
  {
    name: 'compiler',
    packages: ['build-essential', 'python3', 'python3-venv'],
    isThere: async () =>
      (await compiles('c', '')) && (await compiles('c++', '')) && (await succeeds('make', '--version')),
    without: 'addons and what uses them: no C compiler (apt-get install build-essential python3)',
    steps: ['native', 'stack'],
  },
  {
    name: 'cyclonedds',
    packages: ['cyclonedds-dev'],
    isThere: async () => process.env.CYCLONEDDS_HOME !== undefined || compiles('c', '#include <dds/dds.h>'),
    without: 'ROS 2: no CycloneDDS (apt-get install cyclonedds-dev)',
    steps: ['native', 'stack'],
  },
  {
    name: 'fastdds',
    packages: ['libfastrtps-dev', 'g++'],
    isThere: () => compiles('c++', '#include <fastdds/dds/domain/DomainParticipant.hpp>'),
    without: 'ROS 2 beside Fast DDS: it is not installed (apt-get install libfastrtps-dev g++)',
    steps: ['native', 'stack'],
  },
  {
    name: 'python-dds',
    packages: [],
    python: { folder: DDS_PYTHON, install: ['--only-binary', ':all:', 'cyclonedds'] },
    isThere: () =>
      anyPython([process.env.FARPOINT_DDS_PYTHON, inFolder(DDS_PYTHON)], 'import cyclonedds.domain'),
    without: 'ROS 2 beside Python’s DDS: it is not installed (pip install cyclonedds)',
    steps: ['native', 'stack'],
  },
  {
    name: 'numpy',
    packages: [],
    python: { folder: PYTHON, install: ['numpy'] },
    isThere: () => anyPython([process.env.FARPOINT_PYTHON, inFolder(PYTHON)], 'import numpy'),
    without: 'the Python producer: no numpy (apt-get install python3-numpy)',
    steps: ['native', 'stack'],
  },
  {
    name: 'gstreamer',
    packages: GSTREAMER.packages,
    isThere: gstreamerIsThere,
    without: `camera video and sound: no GStreamer (apt-get install ${GSTREAMER.packages.join(' ')})`,
    steps: ['native', 'stack', 'smoke', 'firefox'],
  },
  {
    name: 'ros1',
    packages: Ros1Peers.PACKAGES,
    isThere: async () => Ros1Peers.find().python !== null,
    without: `a ROS 1 graph: no rospy (apt-get install ${Ros1Peers.PACKAGES.join(' ')})`,
    steps: ['stack', 'smoke'],
  },
  {
    name: 'janus',
    packages: ['janus'],
    isThere: async () => findJanus() !== null,
    without: 'broadcasts: no Janus (apt-get install janus)',
    steps: ['stack', 'smoke'],
  },
  {
    name: 'chromium',
    packages: ['chromium'],
    // Its download is tried once. If the server is out of reach, the distribution's package will do.
    fetch: () =>
      run('pnpm', ['--dir', 'e2e', 'exec', 'playwright', 'install', 'chromium'], {
        env: { PLAYWRIGHT_DOWNLOAD_CONNECTION_TIMEOUT: '10000' },
        timeoutMs: 300_000,
      }),
    // A browser that lacks libraries exists but does not start.
    isThere: async () => {
      const path = findChromium();
      return path !== null && (await run(path, ['--version'], { timeoutMs: 30_000 })).code === 0;
    },
    without: `the page: no Chromium (${CHROMIUM_REMEDY})`,
    steps: ['page', 'stack', 'smoke'],
  },
  {
    name: 'headless-shell',
    packages: ['chromium-headless-shell'],
    // Debian's Chromium has it beside it. Playwright's own comes with it, and others do without.
    isThere: () => {
      const browser = findChromium();
      const isOfOthers = browser !== null && browser !== '/usr/bin/chromium';
      return Promise.resolve(isOfOthers || findHeadlessShell() !== null);
    },
    without: null,
    steps: ['page'],
  },
  {
    name: 'turnserver',
    packages: ['coturn'],
    isThere: () => Promise.resolve(findProgram(['turnserver']) !== null),
    without: 'relays: no TURN server (apt-get install coturn)',
    steps: ['smoke'],
  },
  {
    name: 'firefox',
    packages: firefoxNeedsDisplay ? ['firefox-esr', 'xvfb'] : ['firefox-esr'],
    isThere: async () => findFirefox() !== null && (!firefoxNeedsDisplay || findProgram(['Xvfb']) !== null),
    without: 'Firefox: it is not installed (apt-get install firefox-esr xvfb)',
    steps: ['firefox'],
  },
];

function inFolder(folder: string): string | undefined {
  const python = join(folder, 'bin', 'python3');
  return existsSync(python) ? python : undefined;
}

async function anyPython(candidates: readonly (string | undefined)[], check: string): Promise<boolean> {
  for (const python of [...candidates, 'python3'])
    if (python !== undefined && (await succeeds(python, '-c', check))) return true;
  return false;
}

async function succeeds(program: string, ...args: string[]): Promise<boolean> {
  return (await run(program, args)).code === 0;
}

function compiles(language: 'c' | 'c++', source: string): Promise<boolean> {
  const compiler = language === 'c' ? 'cc' : 'c++';
  return succeeds('sh', '-c', `echo '${source}' | ${compiler} -E -x ${language} - -o /dev/null`);
}

async function gstreamerIsThere(): Promise<boolean> {
  if (!(await succeeds('pkg-config', '--exists', ...GSTREAMER.libraries))) return false;
  for (const element of GSTREAMER.elements)
    if (!(await succeeds('gst-inspect-1.0', '--exists', element))) return false;
  return true;
}
