/** What the page for watchers says. */
import type { WatchObstacle } from '@farpoint/operator';

export const watch = {
  title: 'Farpoint: watch',
  surroundings: 'The robot’s surroundings',
  fromAbove: 'From above',
  fromAboveTitle: 'From above (T)',
  view: 'View',
  viewTitle: 'First or third person (V)',
  cameras: 'Cameras',
  obstacles: {
    'relay-unreachable': 'Janus cannot be reached. Trying again…',
    'no-broadcast': 'The robot is not broadcasting. Waiting for it…',
    'not-a-broadcast': 'This mountpoint is not a robot’s broadcast. Trying again…',
    refused: 'Janus refuses: check the PIN. Trying again…',
    lost: 'The connection is lost. Trying again…',
  } satisfies Record<WatchObstacle, string>,
  connecting: 'Connecting…',
  firstPictures: 'Waiting for the first pictures…',
  live: 'Live',
  silent: 'Not live: nothing arrives',
  of: (state: string, robot: string) => `${state} · ${robot}`,
  /** Of a camera. */
  cameraLive: 'live',
  cameraWaiting: 'waiting',
  cameraHidden: 'hidden',
  cameraSilent: (seconds: string) => `not live, ${seconds} s`,
  nothing: 'Nothing to watch',
  /** What is wrong with the address of the page. */
  faults: {
    'no-janus': 'The address of Janus is missing: add ?janus=wss://… to the page’s address.',
    'not-websocket': 'The address of Janus must begin with wss:// or ws://.',
    'needs-wss': 'A page from https:// can use Janus at wss:// only.',
    'bad-mountpoint': 'The mountpoint must be a number from 1.',
    'long-pin': 'The PIN is too long.',
  },
};
