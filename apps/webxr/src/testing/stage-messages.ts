/** What a scripted robot says in the states of stage-states.ts: each with everything that the page can show of it. */
import type { ToldMessage } from '@farpoint/operator/testing/scripted-link';
import {
  type MotionState,
  NEAR_SECTORS,
  type NearSector,
  nearFieldText,
  type PresentOperator,
  type RobotStatus,
  type Videos,
} from '@farpoint/protocol';

/** What the robot makes of a wish, where nothing bounds it. */
export const freeMotion: MotionState = { factor: 1, reasons: [], mostLinear: 0.5, obstacleGuard: 'on' };

/** Robots of a list, and what each tells about itself. */
export const fleet: readonly { id: string; name: string; status: RobotStatus }[] = Array.from(
  { length: 12 },
  (_, i) => ({
    id: `robot-${i + 1}`,
    name: i === 3 ? `Mule with a name of sixty-four characters, as long as one can be` : `Robot ${i + 1}`,
    status: {
      state: (['free', 'driven', 'stopped', 'fault'] as const)[i % 4] ?? 'free',
      sinceMs: Date.UTC(2026, 0, 1) - i * 3_600_000,
      battery: i / 12,
      ...(i === 1 ? { driver: 'Ada' } : {}),
      operators: i % 5,
      watchers: i % 3,
      maxOperators: 4,
      alarms: i % 4,
      version: '1.2.3',
    },
  }),
);

/** Two topics with curves, a position on the earth, diagnostics and a reading. */
export function telemetryOf(robotMs: number): ToldMessage[] {
  const temperature = (number: number, label: string): ToldMessage => ({
    ...{ type: 'quantity', number, topic: `/motor_${number}`, field: 'temperature', label, unit: '°C' },
  });
  return [
    temperature(0, 'Left motor'),
    temperature(1, 'Right motor'),
    {
      ...{ type: 'samples', timeMs: robotMs },
      samples: [
        [0, -100, 30],
        [1, -100, 31],
        [0, 0, 31],
        [1, 0, 32],
      ],
    },
    {
      ...{ type: 'diagnostics', topic: '/diagnostics', timeMs: robotMs },
      counts: { error: 0, warn: 1, stale: 0, ok: 3 },
      reports: [
        { name: 'Battery', level: 'warn', message: 'low', sinceMs: robotMs },
        { name: 'Left motor', level: 'ok', message: '30 °C', sinceMs: robotMs },
      ],
    },
    {
      ...{ type: 'reading', topic: '/arm', label: 'Arm', level: 'ok', ageMs: 0, timeMs: robotMs },
      values: [['', 'stowed']],
    },
  ];
}

export function lowBattery(robotMs: number, recorded = false): ToldMessage {
  return {
    ...{ type: 'alarm', number: 0, level: 'warn', text: 'The battery is low: drive to the charger' },
    ...{ value: 15, limit: 20, unit: '%', sinceMs: robotMs },
    ...(recorded ? { recorded: true as const } : {}),
  };
}

/**
 * What is near the robot.
 *
 * @param sector of the nearest thing, of {@link NEAR_SECTORS}, counter-clockwise from ahead
 * @param metres from the footprint's edge to it
 */
export function thingAt(sector: number, metres: number, robotMs: number): ToldMessage {
  const sectors = Array.from({ length: NEAR_SECTORS }, (_, i): NearSector => {
    const off = Math.min(
      (i - sector + NEAR_SECTORS) % NEAR_SECTORS,
      (sector - i + NEAR_SECTORS) % NEAR_SECTORS,
    );
    if (off > 3) return { hit: null, unseen: null };
    return { hit: { kind: 'thing', metres: metres + 0.05 * off }, unseen: null };
  });
  return { type: 'nearField', timeMs: robotMs, sectors: nearFieldText(sectors) };
}

export const twoSensors: ToldMessage = { type: 'sensors', sensors: [{ name: 'Camera' }, { name: 'LiDAR' }] };
export const lidarRings: ToldMessage = {
  ...{ type: 'rings', sensor: 1 },
  elevations: Array.from({ length: 16 }, (_, i) => ((-25 + 1.87 * i) * Math.PI) / 180),
};
export const twoVideos: Videos = {
  type: 'videos',
  videos: [
    { name: 'Front', mid: 'v0', codec: 'VP8' },
    { name: 'Rear', mid: 'v1', codec: 'VP8' },
  ],
};
export const twoCameras: ToldMessage = { type: 'cameras', cameras: [{ name: 'Gripper' }, { name: 'Mast' }] };
export const sound: ToldMessage = {
  ...{ type: 'sound', mid: 's0', microphone: { state: 'off' }, voice: { state: 'closed' } },
};
export const people: ToldMessage = {
  type: 'operators',
  operators: [
    { number: 1, name: 'Anna', role: 'supervise', drives: false, you: true },
    { number: 2, name: 'Bo', role: 'drive', drives: true, you: false },
    { number: 3, name: 'Cy', role: 'watch', drives: false, you: false },
  ],
};
/** At a robot without grants: nothing proves their names. */
/** Commands of each kind: one that can be given, one that cannot, one that runs; and a recording. */
export const commands: readonly ToldMessage[] = [
  { type: 'robotCommand', id: 'lights', label: 'Lights', group: 'Signals' },
  { type: 'robotCommand', id: 'horn', label: 'Horn', group: 'Signals', barred: 'estop' },
  { type: 'robotCommand', id: 'dock', label: 'Dock', group: 'Power', confirm: true },
  { type: 'robotCommand', id: 'self-test', label: 'Self-test', group: 'Service', cancel: true },
  { type: 'robotCommand', id: 'record', label: 'Record', recording: 'start' },
  { type: 'robotCommand', id: 'record-stop', label: 'Stop recording', recording: 'stop' },
  { type: 'robotCommand', id: 'bookmark', label: 'Bookmark', recording: 'bookmark' },
  {
    type: 'commandRun',
    run: 1,
    id: 'self-test',
    by: { number: 2, name: 'Bo' },
    state: 'running',
    progress: 0.5,
    detail: 'tests the camera',
  },
  { type: 'recording', on: true, bytes: 48_000_000, forS: 62 },
];
export const threePeople: readonly Omit<PresentOperator, 'drives'>[] = [
  { number: 1, name: 'Anna', claimed: true, role: 'drive', you: true },
  { number: 2, name: 'Bo', claimed: true, role: 'drive', you: false },
  { number: 3, name: 'Cy', claimed: true, role: 'drive', you: false, away: true },
];
