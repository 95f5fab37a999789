import { type Command, type RobotSessionMessage, zeroTwist } from '@farpoint/protocol';
import { describe, expect, it } from 'vitest';
import { BridgeSession, type BridgeSessionActions } from './bridge-session.ts';

function setUp(signaling: string | null = null) {
  const control: object[] = [];
  const said: { linear: { x: number; z: number } }[] = [];
  const told: RobotSessionMessage[] = [];
  const phases: string[] = [];
  const paths: boolean[] = [];
  const actions: BridgeSessionActions = {
    sendControl: (text) => control.push(JSON.parse(text)),
    sendTelemetry: (text) => said.push(JSON.parse(text).command),
    onRobots: () => undefined,
    onPhase: (phase) => phases.push(phase),
    onBegin: () => phases.push('begin'),
    onRobotMessage: (text) => told.push(JSON.parse(text)),
    onPath: (up) => paths.push(up),
  };
  const session = new BridgeSession(actions, signaling);
  const robots = (...listed: [number, string][]) =>
    session.onControl(
      JSON.stringify({ type: 'updateRobots', robots: listed.map(([id, name]) => ({ id, name })) }),
      0,
    );
  const switched = (robotId: number, nowMs = 0) =>
    session.onControl(JSON.stringify({ type: 'switchedRobot', robotId }), nowMs);
  const live = () => {
    session.onSockets(true);
    robots([0, 'first'], [1, 'second']);
    session.want('1');
    switched(1);
    session.session({ type: 'leaseRequest', take: false });
  };
  return { session, control, said, told, phases, paths, robots, switched, live };
}

function forward(x: number, more: Partial<Command> = {}): Command {
  const twist = { ...zeroTwist(), linear: { x, y: 0, z: 0 } };
  return { type: 'command', sequence: 1, timeMs: 0, lease: 'bridge', deadMan: x !== 0, twist, ...more };
}

describe('BridgeSession', () => {
  it('chooses the wanted robot once it is listed, and is live when the bridge confirms it', () => {
    const { session, control, told, phases, robots, switched } = setUp();
    session.want('1');
    session.onSockets(true);
    expect(control).toEqual([{ type: 'updateRobots' }]);
    robots([0, 'first']);
    expect(session.phase).toBe('waiting');
    robots([0, 'first'], [1, 'second']);
    expect(control[1]).toEqual({ type: 'switchRobot', robotId: 1 });
    switched(0);
    expect(session.phase).toBe('opening');
    switched(1);
    expect(phases).toEqual(['waiting', 'opening', 'begin', 'live']);
    expect(told.map(({ type }) => type)).toEqual(['welcome', 'lease', 'estop']);
  });

  it('tells the bridge which signaling service to use, if the page was given one', () => {
    const { session, control } = setUp('ws://signaling.example:3002/');
    session.onSockets(true);
    session.onSockets(false);
    session.onSockets(true);
    const init = { type: 'initBridge', url: 'ws://signaling.example:3002/' };
    expect(control).toEqual([init, init]);
  });

  it('is not live with a robot that no list names', () => {
    const { session, phases, robots, switched } = setUp();
    session.want('1');
    session.onSockets(true);
    switched(1);
    expect(session.phase).toBe('waiting');
    robots([1, 'second']);
    robots();
    switched(1);
    expect(session.phase).toBe('waiting');
    robots([1, 'second']);
    switched(1);
    expect(phases).toEqual(['waiting', 'opening', 'waiting', 'opening', 'begin', 'live']);
  });

  it('finds its robot again by its name', () => {
    const { session, control, robots, switched, live } = setUp();
    live();
    session.onSockets(false);
    expect(session.phase).toBe('waiting');
    session.onSockets(true);
    robots([4, 'second'], [5, 'first']);
    expect(control.at(-1)).toEqual({ type: 'switchRobot', robotId: 4 });
    switched(4);
    expect([session.phase, session.robotId]).toEqual(['live', '4']);
    // The bridge itself switches to the robot's next registration.
    robots([4, 'second'], [7, 'second']);
    switched(7);
    expect([session.phase, session.robotId]).toEqual(['live', '7']);
    // Another page chose another robot.
    switched(5);
    expect(session.phase).toBe('waiting');
  });

  it('passes motion on only with the grip held, the page’s lease, no stop, and points arriving', () => {
    const { session, said, paths, live } = setUp();
    live();
    session.command(forward(0.4), 0);
    expect(said.at(-1)?.linear.x).toBe(0.4);
    session.command(forward(0.4, { deadMan: false }), 0);
    expect(said.at(-1)?.linear.x).toBe(0);
    session.session({ type: 'leaseRelease' });
    session.command(forward(0.4), 0);
    expect(said.at(-1)?.linear.x).toBe(0);
    session.session({ type: 'leaseRequest', take: false });
    session.session({ type: 'estop', latch: true });
    session.command(forward(0.4), 0);
    expect(said.at(-1)?.linear.x).toBe(0);
    // Released while the grip is held: no motion until the grip is released.
    session.session({ type: 'estop', latch: false });
    session.command(forward(0.4), 0);
    expect(said.at(-1)?.linear.x).toBe(0);
    session.command(forward(0), 0);
    session.command(forward(0.4), 0);
    expect(said.at(-1)?.linear.x).toBe(0.4);
    // No points: the robot is told to stop, then nothing is sent.
    session.checkSilence(1001);
    expect(said.at(-1)?.linear.x).toBe(0);
    const { length } = said;
    session.command(forward(0.4), 1010);
    expect([said.length, session.interrupted]).toEqual([length, true]);
    session.onPoints(1020);
    session.command(forward(0.4), 1030);
    expect([said.at(-1)?.linear.x, paths]).toEqual([0.4, [false, true]]);
  });

  it('latches its stop, and keeps it when the robot comes back', () => {
    const { session, said, told, robots, switched, live } = setUp();
    live();
    for (let i = 0; i < 3; i++) session.session({ type: 'estop', latch: true });
    robots([7, 'second']);
    switched(7);
    expect(told.findLast(({ type }) => type === 'estop')).toMatchObject({ latched: true });
    session.session({ type: 'leaseRequest', take: false });
    session.command(forward(0), 0);
    session.command(forward(0.4), 0);
    expect(said.at(-1)?.linear.x).toBe(0);
    session.session({ type: 'estop', latch: false });
    expect(told.at(-1)).toEqual({ type: 'estop', latched: false });
  });

  it('asks for a green frame by linear.z, but not with every repetition', () => {
    const { session, said, live } = setUp();
    live();
    const greens = () => said.filter(({ linear }) => linear.z !== 0).length;
    for (const at of [0, 50, 100, 450]) session.command(forward(0, { latencyTest: 3 }), at);
    expect(greens()).toBe(1);
    session.command(forward(0, { latencyTest: 3 }), 500);
    session.command(forward(0, { latencyTest: 4 }), 501);
    expect(greens()).toBe(3);
  });

  it('stops the robot that it leaves, and ignores garbage', () => {
    const { session, said, live } = setUp();
    live();
    session.command(forward(0.4), 0);
    for (const text of ['', 'null', '{"type":"switchedRobot","robotId":-1}']) session.onControl(text, 0);
    session.want('0');
    expect(said.slice(-4).map(({ linear }) => linear.x)).toEqual([0, 0, 0, 0]);
    const { length } = said;
    session.command(forward(0.4), 0);
    expect(said.length).toBe(length);
  });
});
