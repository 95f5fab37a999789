import type { Telemetry } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import type { EventDetail } from '../events/page-event.ts';
import { reportSchema } from './report-schema.ts';
import { SessionRecord } from './session-record.ts';

const START = {
  robot: { id: 'rover-1', name: 'Rover' },
  operator: { name: 'Ann', role: 'drive' },
  epochMs: 1_700_000_000_000,
  nowMs: 5000,
  maxLinearMps: 1,
};
const FIGURES = {
  bytesReceived: 2_000_000,
  packetsReceived: 990,
  packetsLost: 10,
  bitsPerSecond: 8_000_000,
  rttMs: 40,
  framesPerSecond: 10,
  pointsPerSecond: 200_000,
  displayFramesPerSecond: 60,
  viewAgeMs: null,
};
const stop = { kind: 'stop', name: '', heldBy: [], start: null, already: false } as const;

/** Each event, a second apart. */
function happen(record: SessionRecord, ...details: EventDetail[]): void {
  for (const [i, detail] of details.entries()) record.onEvent(detail, START.nowMs + i * 1000, 1);
}

function interventionsOf(...details: EventDetail[]) {
  const record = new SessionRecord(START);
  happen(record, ...details);
  return record.report(START.nowMs).interventions;
}

describe('the report of a session', () => {
  test('says with whom it was, from when to when, and why it ended; and is what its schema says', () => {
    const record = new SessionRecord(START);
    const lasting = record.report(6500);
    expect(lasting).toMatchObject({ beganMs: START.epochMs, endedMs: null, durationS: 1.5, end: null });
    record.end('robot-stopped', 65_000);
    record.end('left', 70_000);
    const report = record.report(99_000);
    expect(report).toMatchObject({
      robot: START.robot,
      operator: START.operator,
      endedMs: START.epochMs + 60_000,
      durationS: 60,
      end: 'robot-stopped',
    });
    expect(reportSchema.parse(JSON.parse(JSON.stringify(report)))).toEqual(report);
    expect(reportSchema.safeParse({ ...report, version: 2 }).success).toBe(false);
  });

  test('counts STOPs by whom; one that was on before is none of the session', () => {
    const counts = interventionsOf(
      { ...stop, heldBy: [], by: 'you' },
      { ...stop, heldBy: [], by: 'operator' },
      { ...stop, heldBy: [], by: 'operator' },
      { ...stop, heldBy: [], by: 'robot' },
      { ...stop, heldBy: [], by: 'robot', already: true },
    );
    expect(counts).toMatchObject({ stopsByYou: 1, stopsByOthers: 2, stopsByRobot: 1, stopsByName: {} });
    // Names are what a robot says.
    const record = new SessionRecord(START);
    const by = 'operator' as const;
    for (const name of [
      'Bo',
      'constructor',
      'Bo',
      '__proto__',
      ...Array.from({ length: 50 }, (_, i) => `n${i}`),
    ])
      record.onEvent({ ...stop, heldBy: [], by, name }, 0, 1);
    const { stopsByName } = record.report(0).interventions;
    expect(Object.entries(stopsByName).slice(0, 3)).toEqual([
      ['Bo', 2],
      ['constructor', 1],
      ['__proto__', 1],
    ]);
    expect(Object.keys(stopsByName)).toHaveLength(32);
  });

  test('counts what held and slowed the robot, and refusals by their reason', () => {
    const record = new SessionRecord(START);
    happen(
      record,
      { kind: 'held', reasons: ['obstacle'] },
      { kind: 'slowed', reasons: ['view-late'] },
      { kind: 'held', reasons: ['fence'] },
      { kind: 'watchdog' },
      { kind: 'let-go-first' },
      { kind: 'blocked' },
      { kind: 'grip-lost', loss: 'path-lost' },
      { kind: 'alarm', level: 'error', text: 'Hot', value: 1, limit: 0, unit: '', recorded: false },
      { kind: 'free' },
    );
    record.onEvent({ kind: 'command-refused', reason: 'stale' }, 0, 12);
    record.onEvent({ kind: 'command-refused', reason: 'stale' }, 0, 3);
    record.onEvent({ kind: 'command-refused', reason: 'repeated' }, 0, 1);
    expect(record.report(0).interventions).toMatchObject({
      held: 2,
      slowed: 1,
      watchdog: 1,
      letGoFirst: 1,
      blocked: 1,
      gripLost: 1,
      alarms: 1,
      commandsRefused: { stale: 15, repeated: 1 },
    });
  });

  test('tells take-overs from hand-overs, and leaves out what others agree among themselves', () => {
    const lease = (holder: 'you' | 'other' | 'nobody', driver = ''): EventDetail => ({
      kind: 'lease',
      holder,
      driver,
    });
    const agreed: EventDetail = { kind: 'handover', step: 'offer', from: 'Ann', to: 'Bo', ended: 'accepted' };
    expect(interventionsOf(lease('you'), lease('other', 'Bo'))).toMatchObject({ takeovers: 1, handovers: 0 });
    expect(interventionsOf(lease('you'), lease('other', 'Bo'), agreed)).toMatchObject({
      takeovers: 0,
      handovers: 1,
    });
    expect(
      interventionsOf(lease('you'), lease('other', 'Bo'), { ...agreed, ended: 'refused' }),
    ).toMatchObject({
      takeovers: 1,
      handovers: 0,
    });
    expect(interventionsOf(lease('you'), lease('nobody'), lease('other', 'Bo')).takeovers).toBe(0);
    expect(interventionsOf(lease('other', 'Bo'), lease('other', 'Cy')).takeovers).toBe(0);
  });

  test('for how long the operator had the drive, also while it still has', () => {
    const record = new SessionRecord(START);
    const lease = (holder: 'you' | 'nobody', nowMs: number) =>
      record.onEvent({ kind: 'lease', holder, driver: '' }, nowMs, 1);
    lease('you', 6000);
    lease('nobody', 8000);
    lease('you', 10_000);
    expect(record.report(11_000).driving.leaseS).toBe(3);
    record.end('left', 12_000);
    expect(record.report(99_000).driving.leaseS).toBe(4);
  });

  test('outages: how many, how long, and the longest; the end of the session ends one', () => {
    const record = new SessionRecord(START);
    record.onEvent({ kind: 'robot-silent' }, 10_000, 1);
    record.onEvent({ kind: 'robot-heard', silentMs: 3000 }, 12_300, 1);
    record.onEvent({ kind: 'rate-fell', fromKbps: 2, toKbps: 1 }, 12_300, 1);
    record.onEvent({ kind: 'robot-silent' }, 20_000, 1);
    record.end('silent', 21_000);
    expect(record.report(0).link).toMatchObject({ outages: 2, outageS: 4, longestOutageS: 3, rateFalls: 1 });
  });

  test('figures of each second, the newest totals, and nothing of what is not known', () => {
    const record = new SessionRecord(START);
    record.onSample({ ...FIGURES, bytesReceived: 1, rttMs: 20 });
    record.onSample(FIGURES);
    record.onSample({ ...FIGURES, rttMs: null });
    const { link, view } = record.report(0);
    expect(link).toMatchObject({ bytesReceived: 2_000_000, packetsReceived: 990, packetsLost: 10 });
    expect(link.kbitPerSecond).toMatchObject({ count: 3, mean: 8000, max: 8000 });
    expect(link.roundTripMs).toMatchObject({ count: 2, mean: 30, max: 40 });
    expect(view.pointsPerSecond?.max).toBe(200_000);
    expect(view.framesPerSecond?.p50).toBe(10);
    expect(view.displayFramesPerSecond?.max).toBe(60);
    expect(view.ageMs).toBeNull();
  });

  test('stages of clouds and commands, and motion to photon', () => {
    const record = new SessionRecord(START);
    const row = { number: 1, endedMs: 0, told: true };
    const stages = { capture: 5, encode: 10, queue: 1, link: 30, decode: null, draw: 8 };
    record.frames.add({ ...row, totalMs: 60, stages });
    record.frames.add({ ...row, totalMs: null, stages: { ...stages, link: null } });
    record.commands.add({ ...row, totalMs: 20, stages: { hand: 1, page: 1, link: 15, gate: 1, wheels: 2 } });
    record.onEvent({ kind: 'latency', mtpMs: 88, firstMs: 70 }, 0, 1);
    const { latency } = record.report(0);
    expect(latency.frameMs).toMatchObject({ count: 1, p50: 60 });
    expect(latency.frameStagesMs.capture?.count).toBe(2);
    expect(latency.frameStagesMs.link?.max).toBe(30);
    expect(latency.frameStagesMs.decode).toBeNull();
    expect(latency.commandMs?.max).toBe(20);
    expect(latency.commandStagesMs.link?.max).toBe(15);
    expect(latency.motionToPhotonMs?.max).toBe(88);
  });

  test('how far it drove, and for how long it was held', () => {
    const record = new SessionRecord(START);
    for (let i = 0; i <= 20; i++)
      record.onTelemetry({
        timeMs: i * 50,
        pose: { position: { x: i * 0.05, y: 0, z: 0 } },
        twist: { linear: { x: 1, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0 } },
        motion: { factor: 0, reasons: ['obstacle'] },
      } as unknown as Telemetry);
    const { driving, interventions } = record.report(0);
    expect(driving.distanceM).toBeCloseTo(1, 1);
    expect(driving).toMatchObject({ topSpeedMps: 1, positionJumps: 0 });
    expect(interventions.heldS).toBeCloseTo(1, 6);
  });
});
