import { createSocket } from 'node:dgram';
import { once } from 'node:events';
import type { IceServer } from '@farpoint/protocol';
import { eventually } from '@farpoint/service/testing/eventually';
import { useCleanups } from '@farpoint/webrtc/testing/cleanups';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { OperatorClient } from '../../testing/operator-client.ts';
import { OperatorPeer } from './operator-peer.ts';
import type { PeerEnd } from './peer-events.ts';
import type { RtpTransport } from './rtp-transport.ts';

const cleanups = useCleanups();

function robotPeer(connectTimeoutMs = 20_000, iceServers: IceServer[] = []) {
  const messages: [string, string | Uint8Array][] = [];
  let client: OperatorClient | null = null;
  let answering: Promise<unknown> = Promise.resolve();
  const answers: string[] = [];
  const connected = Promise.withResolvers<RtpTransport>();
  const ended = Promise.withResolvers<[PeerEnd, string]>();
  const heard = Promise.withResolvers<void>();
  const peer = new OperatorPeer(
    { iceServers, connectTimeoutMs },
    {
      // They follow the offer to which they belong.
      onCandidate: (candidate) =>
        void answering
          .then(() => client?.connection.addIceCandidate(candidate as never))
          .catch(() => undefined),
      onConnected: (transport) => connected.resolve(transport),
      onMessage: (channel, data) => {
        messages.push([channel, data]);
        heard.resolve();
      },
      onEnded: (end, detail) => ended.resolve([end, detail]),
    },
  );
  cleanups.push(() => peer.close());
  const meet = async () => {
    client = new OperatorClient();
    cleanups.push(() => client?.close());
    client.onCandidate = (candidate) => peer.addCandidate(candidate);
    await negotiate(await peer.offer());
    return client;
  };
  const negotiate = async (offer: string) => {
    const answer = client?.answer(offer) ?? '';
    answering = Promise.resolve(answer);
    const sdp = await answer;
    answers.push(sdp);
    return peer.answer(sdp);
  };
  return {
    peer,
    answers,
    messages,
    connected: connected.promise,
    ended: ended.promise,
    heard: heard.promise,
    meet,
    negotiate,
  };
}

describe('OperatorPeer', () => {
  it('offers one bundle: the cloud as audio in its own stream, an idle video, data channels', async () => {
    const { peer } = robotPeer();
    const sdp = await peer.offer();
    expect(sdp.match(/^m=\w+/gm)).toEqual(['m=audio', 'm=video', 'm=application']);
    expect(sdp).toMatch(/a=group:BUNDLE 0 1 2/);
    expect(sdp).toMatch(/a=rtpmap:\d+ opus\/48000\/2/);
    expect(sdp).toMatch(/a=msid:farpoint-cloud /);
    const ids = (uri: string) =>
      [...sdp.matchAll(new RegExp(`a=extmap:(\\d+) ${uri}`, 'g'))].map((match) => match[1]);
    for (const uri of ['urn:ietf:params:rtp-hdrext:sdes:mid', '.*transport-wide-cc-extensions-01']) {
      expect(ids(uri)).toHaveLength(2);
      expect(new Set(ids(uri)).size).toBe(1);
    }
  });

  it('connects, carries packets and messages, and notices when the operator leaves', async () => {
    const robot = robotPeer();
    const client = await robot.meet();
    const transport = await robot.connected;
    expect(transport.ready).toBe(true);
    const sequences = [0, 1, 2].map((i) => transport.send(Buffer.alloc(100, i), i, true, 0, 1000) as number);
    expect(sequences[2]).toBe(((sequences[0] as number) + 2) & 0xffff);
    await client.until(() => client.packets === 3);
    await client.until(() => client.control.readyState === 'open');
    client.control.send('hello');
    await robot.heard;
    expect(robot.messages).toEqual([['control', 'hello']]);
    await client.close();
    expect((await robot.ended)[0]).toBe('connection-lost');
    expect(transport.send(Buffer.alloc(100), 0, true, 0, 1000)).toBeNull();
  });

  it('restarts ICE on new sockets: a new path with the same keys, counters and channels', async () => {
    const robot = robotPeer();
    const client = await robot.meet();
    const transport = await robot.connected;
    await client.until(() => client.control.readyState === 'open');
    const ufragsOf = (sdp: string) =>
      new Set([...sdp.matchAll(/ice-ufrag:(\S+)/g)].map(([, ufrag]) => ufrag));
    const first = transport.send(Buffer.alloc(100), 0, true, 0, 1000) as number;
    await client.until(() => client.packets === 1);
    const ufrags = new Set<string>();
    for (let round = 1; round <= 3; round++) {
      const offer = await robot.peer.restart();
      for (const ufrag of ufragsOf(offer)) ufrags.add(ufrag as string);
      expect(transport.ready).toBe(false);
      await robot.negotiate(offer);
      await eventually(() => transport.ready);
      expect(transport.send(Buffer.alloc(100), round, true, 0, 1000)).toBe((first + round) & 0xffff);
      await client.until(() => client.packets === 1 + round);
      client.control.send(`after ${round}`);
      await eventually(() => robot.messages.some(([, data]) => data === `after ${round}`));
    }
    expect(ufrags.size).toBe(3);
    expect(robot.peer.restarts).toBe(3);
    expect(robot.peer.connected).toBe(true);
  });

  it('does not wait for a STUN server that does not answer', async () => {
    const silent = createSocket('udp4').bind(0, '127.0.0.1');
    cleanups.push(() => silent.close());
    await once(silent, 'listening');
    const robot = robotPeer(20_000, [{ urls: `stun:127.0.0.1:${silent.address().port}` }]);
    // werift queries it for five seconds, as long as a test may take.
    await robot.meet();
    await robot.connected;
    expect(robot.peer.connected).toBe(true);
  });

  it('drops answers while the channel is full: a flood of probes gets few answers, and costs little', async () => {
    const robot = robotPeer();
    const client = await robot.meet();
    await robot.connected;
    await client.until(() => client.control.readyState === 'open');
    let received = 0;
    client.control.onMessage.subscribe(() => received++);
    client.control.send('hello');
    await robot.heard;
    const answer = '{"type":"clockAnswer","id":3,"sentMs":1000.25,"robotMs":88123.75}';
    for (let i = 0; i < 5000; i++) robot.peer.sendControl(answer);
    const taken = 5000 - robot.peer.unreliableDrops;
    expect(taken).toBeGreaterThan(100);
    // What is queued, and what is in flight.
    expect(taken * answer.length).toBeLessThan(2 * 16_384);
    await eventually(() => received === taken);
    robot.peer.sendControl(answer);
    await eventually(() => received === taken + 1);
  });

  it('closes unknown channels', async () => {
    const robot = robotPeer();
    const client = await robot.meet();
    await robot.connected;
    const strange = client.connection.createDataChannel('strange');
    await new Promise<void>((resolve) =>
      strange.stateChanged.subscribe((state) => state === 'closed' && resolve()),
    );
    expect(robot.peer.unknownChannels).toBe(1);
    expect(robot.peer.connected).toBe(true);
  });

  it('gives up if nobody answers', async () => {
    const robot = robotPeer(20);
    await robot.peer.offer();
    expect((await robot.ended)[0]).toBe('not-connected');
  });

  it('ends on an invalid answer', async () => {
    const bad = robotPeer();
    await bad.peer.offer();
    await bad.peer.answer('v=0\r\nnonsense');
    expect(await bad.ended).toEqual(['bad-answer', '0 m-lines, where the offer has 3']);
  });

  it('ignores a repeated or unrequested answer', async () => {
    const robot = robotPeer();
    const client = await robot.meet();
    const transport = await robot.connected;
    const answer = client.connection.localDescription?.sdp ?? '';
    expect(await robot.peer.answer(robot.answers.at(-1) ?? '')).toBe('repeated');
    expect(await robot.peer.answer(answer.replace(/ice-ufrag:\S+/g, 'ice-ufrag:other'))).toBe('unasked');
    expect(await robot.peer.answer('v=0')).toBe('unasked');
    // The old answer does not count while a restart waits for its own, either.
    const offer = await robot.peer.restart();
    expect(await robot.peer.answer(robot.answers.at(-1) ?? '')).toBe('repeated');
    await robot.negotiate(offer);
    await eventually(() => transport.ready);
    const { packets } = client;
    expect(transport.send(Buffer.alloc(100), 0, true, 0, 1000)).not.toBeNull();
    await client.until(() => client.packets > packets);
    expect(robot.peer.connected).toBe(true);
  });

  it('survives damaged answers', async () => {
    const donor = robotPeer();
    const offer = await donor.peer.offer();
    const client = new OperatorClient();
    cleanups.push(() => client.close());
    const lines = (await client.answer(offer)).split('\r\n');
    const damage = fc.array(
      fc.tuple(fc.nat(), fc.constantFrom('drop', 'twice', 'cut', 'swap'), fc.string({ maxLength: 8 })),
      { minLength: 1, maxLength: 4 },
    );
    await fc.assert(
      fc.asyncProperty(damage, async (edits) => {
        const broken = [...lines];
        for (const [n, edit, text] of edits) {
          const at = n % broken.length;
          const line = broken[at] ?? '';
          if (edit === 'drop') broken.splice(at, 1);
          else if (edit === 'twice') broken.splice(at, 0, line);
          else if (edit === 'cut') broken[at] = line.slice(0, n % (line.length + 1));
          else broken[at] = line.replace(/[0-9a-f]+/, text);
        }
        const robot = robotPeer();
        await robot.peer.offer();
        await robot.peer.answer(broken.join('\r\n'));
        robot.peer.close();
        await robot.ended;
      }),
      { seed: 11, numRuns: 40 },
    );
  });
});
