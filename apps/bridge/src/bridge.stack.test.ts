/** The bridge against the real signaling service and robots that behave like the reference system's. */

import { once } from 'node:events';
import { get, type IncomingMessage } from 'node:http';
import { ReferenceRobot, SocketPeer } from '@farpoint/conformance';
import { LocalStack } from '@farpoint/local-stack';
import { writePointPacketHeader } from '@farpoint/protocol';
import { createLogger } from '@farpoint/service';
import { afterAll, beforeAll, expect, it, onTestFinished } from 'vitest';
import type { Bridge } from './bridge.ts';
import { openBridge } from './testing/open-bridge.ts';

let stack: LocalStack;
beforeAll(async () => {
  stack = await LocalStack.start({ robots: [] });
}, 30_000);
afterAll(() => stack.stop());

async function robot(name: string): Promise<ReferenceRobot> {
  const made = await ReferenceRobot.register(`ws://127.0.0.1:${stack.ports.referenceRobot}`, name);
  onTestFinished(() => made.close());
  return made;
}

async function bridge(): Promise<Bridge> {
  const made = await openBridge(stack.ports.referenceClient);
  onTestFinished(() => made.close());
  return made;
}

async function page(port: number, origin?: string): Promise<SocketPeer> {
  const made = await SocketPeer.open(`ws://127.0.0.1:${port}/any`, origin);
  onTestFinished(() => made.close());
  return made;
}

/** A frame of 200 points in two packets of the reference profile. Each point has its robot's mark as x. */
function frame(number: number, mark: number): Buffer[] {
  return [0, 150].map((first) => {
    const count = Math.min(150, 200 - first);
    const bytes = Buffer.alloc(1216);
    const view = new DataView(bytes.buffer, bytes.byteOffset);
    writePointPacketHeader(view, 0, {
      frameNumber: number,
      frameLength: 1600,
      sequenceOffset: first * 8,
      sequenceLength: count * 8,
    });
    for (let i = 0; i < count; i++) view.setInt16(16 + 6 * i, mark, true);
    return bytes;
  });
}

const markOf = (data: string | Uint8Array) =>
  typeof data === 'string' ? null : new DataView(data.buffer, data.byteOffset).getInt16(0, true);

it('shows one robot, switches, passes commands on, reports bandwidth, and survives garbage', async () => {
  const first = await robot('first');
  const made = await bridge();
  const control = await page(made.ports.control);
  const telemetry = await page(made.ports.telemetry);
  const streaming = await page(made.ports.streaming);
  const command = { linear: { x: 0.25, y: 0, z: 0 }, angular: { x: 0, y: 0, z: -0.5 } };
  // No channel is open yet, so this is dropped.
  telemetry.send({ type: 'command', command });
  await first.heard('start');
  const second = await robot('second');
  await second.heard('stop');
  // An unusable offer, and an invalid message.
  const bad = await robot('bad');
  bad.signal({ type: 'offer', robotId: bad.id, sdpOffer: 'v=0\r\nm=nonsense' });
  const garbage = ['null', '{', '{"type":"switchRobot","robotId":"x"}', '\u0000', Buffer.of(0xff, 0xfe)];
  for (const each of [control, telemetry, streaming]) for (const data of garbage) each.sendRaw(data);
  first.sendFrame([Buffer.from([1, 2, 3]), ...frame(0, 1)]);
  const shown = await streaming.inbox.next((data) => markOf(data) === 1);
  expect(shown.length).toBe(1600);
  expect(await first.report()).toBeGreaterThan(0);

  telemetry.send({ type: 'command', command });
  expect(await first.command()).toEqual(command);

  control.send({ type: 'switchRobot', robotId: second.id });
  await control.message({ type: 'switchedRobot', robotId: second.id });
  await first.heard('stop');
  await second.heard('start');
  // A robot that ignores `stop` is not shown either.
  first.sendFrame(frame(1, 1));
  second.sendFrame(frame(0, 2));
  expect(markOf(await streaming.bytes())).toBe(2);
}, 30_000);

it('tells a page of the reference system, which sends only initBridge, everything it needs', async () => {
  const made = await bridge();
  const url = `ws://127.0.0.1:${stack.ports.referenceClient}`;
  const early = await page(made.ports.control);
  // The address already in use, though without the slash.
  early.send({ type: 'initBridge', url });
  const none = '{"type":"updateRobots","robots":null}';
  expect([await early.inbox.next(), await early.inbox.next()]).toEqual([none, none]);
  const { id } = await robot('shown');
  const list = JSON.stringify({ type: 'updateRobots', robots: [{ id, name: 'shown' }] });
  const switched = JSON.stringify({ type: 'switchedRobot', robotId: id });
  // The page looks the robot up in its last list, so the list must come first.
  expect([await early.inbox.next(), await early.inbox.next()]).toEqual([list, switched]);
  // When the page is reloaded, it connects and sends the same again.
  const late = await page(made.ports.control);
  expect([await late.inbox.next(), await late.inbox.next()]).toEqual([list, switched]);
  late.send({ type: 'updateRobots' });
  expect(await late.inbox.next()).toBe(list);
  // An invalid address changes nothing; at another service there are no robots.
  for (const [to, told] of [
    [url, list],
    [url, list],
    ['nowhere', list],
    ['ws://127.0.0.1:1', none],
  ]) {
    late.send({ type: 'initBridge', url: to });
    expect(await late.inbox.next()).toBe(told);
  }
});

it('refuses pages from other origins, and says how to allow them', async () => {
  const lines: string[] = [];
  const stream = { write: (line: string) => void lines.push(line) };
  const log = createLogger({ name: 'bridge', level: 'info', format: 'json', stream });
  const made = await openBridge(
    stack.ports.referenceClient,
    { allowedOrigins: ['https://own.example'] },
    log,
  );
  onTestFinished(() => made.close());
  for (const port of Object.values(made.ports)) {
    await expect(page(port, 'https://evil.example')).rejects.toThrow('401');
    expect(await refusalOf(port, 'https://evil.example')).toContain('--allowed-origins https://evil.example');
  }
  const refused = lines.filter((line) => line.includes('--allowed-origins https://evil.example'));
  expect(refused.length).toBe(1);
  await page(made.ports.telemetry, 'http://localhost:517');
  await page(made.ports.telemetry, 'https://own.example');
});

/** The response body for a refused page. */
async function refusalOf(port: number, origin: string): Promise<string> {
  const headers = {
    Connection: 'Upgrade',
    Upgrade: 'websocket',
    'Sec-WebSocket-Version': '13',
    'Sec-WebSocket-Key': 'x3JJHMbDL1EzLkh9GBhXDw==',
    Origin: origin,
  };
  const [response] = (await once(get({ host: '127.0.0.1', port, headers }), 'response')) as [IncomingMessage];
  return (await response.toArray()).join('');
}
