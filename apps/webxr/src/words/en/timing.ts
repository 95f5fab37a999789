/** What is said about latency tests, and about where the time of clouds and of commands goes. */
import type { CommandStage, FrameStage, LatencyFailure } from '@farpoint/operator';

export const timing = {
  /** Why a latency test failed, for the dashboard. */
  failures: {
    timeout: 'no green cloud arrived',
    'no-session': 'connect to a robot first',
    'no-lease': 'only the driver can test',
    busy: 'another test is running',
  } satisfies Record<LatencyFailure, string>,
  /** The same as a notice. */
  failureNotices: {
    timeout: 'No green cloud arrived: the request or the whole cloud was lost.',
    'no-session': 'Connect to a robot first.',
    'no-lease': 'Someone else is driving. Only the driver can run a latency test.',
    busy: 'A latency test is already running.',
  } satisfies Record<LatencyFailure, string>,
  result: (mtp: string, first: string) => `Motion to photon ${mtp} (first points ${first})`,
  notMeasured: 'Motion to photon: not measured yet',
  lastFailed: (why: string) => `Motion to photon: ${why}`,
  failed: 'failed',
  last: (mtp: string, first: string) => `Motion to photon: ${mtp}, first points ${first}`,
  tests: (count: number) => `Last ${count} test${count === 1 ? '' : 's'}`,
  testsFailed: (tests: string, failed: number) => `${tests}, ${failed} failed`,
  testsTook: (tests: string, median: string, p95: string) =>
    `${tests}: median ${median}, 95 of 100 within ${p95}`,
  frameStages: {
    capture: 'capture',
    encode: 'encoding',
    queue: 'robot’s queue',
    link: 'link',
    decode: 'decoding',
    draw: 'drawing',
  } satisfies Record<FrameStage, string>,
  commandStages: {
    hand: 'hand',
    page: 'page',
    link: 'link',
    gate: 'robot’s checks',
    wheels: 'wheels',
  } satisfies Record<CommandStage, string>,
  ageUnknown: 'age unknown',
  total: (what: string, median: string, p95: string) => `${what}: ${median}, 95 of 100 within ${p95}`,
  clockUnknown: 'The link is unknown until the robot’s clock has been compared with this one.',
  noneTold: 'The robot has told its own times of none.',
  allButTold: (untold: number, of: number) =>
    `The robot has told its own times of all but ${untold} of ${of}.`,
  /** The tile of the dashboard. */
  clouds: 'Clouds, from the sensor to the screen',
  commands: 'Commands, from the hand to the wheels',
  cloudsAsCsv: 'Clouds as CSV',
  cloudsAsCsvTitle: 'Save the last 30 s of clouds as a table',
  commandsAsCsv: 'Commands as CSV',
  commandsAsCsvTitle: 'Save the last 30 s of commands as a table',
  median: 'Median',
  p95: '95 of 100 take no longer',
  openStages: 'Where the time goes, of each cloud and each command',
  single: 'Single',
  singleTitle: 'Measure motion to photon once',
  continuous: 'Continuous',
  continuousTitle: 'Measure motion to photon again and again',
  abort: 'Abort',
  abortTitle: 'Start no further test',
  testsAsCsv: 'Tests as CSV',
  testsAsCsvTitle: 'Save the last 100 tests as a table',
};
