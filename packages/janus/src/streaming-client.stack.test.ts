/** The client with a real Janus. */
import { findJanus, JANUS_REMEDY, JanusServer } from '@farpoint/local-stack';
import { afterAll, beforeAll, describe, expect, it, onTestFinished } from 'vitest';
import { JanusFailure } from './janus-failure.ts';
import { StreamingClient } from './streaming-client.ts';
import type { MountpointRequest } from './streaming-message.ts';

const failureOf = (request: Promise<unknown>) =>
  request.then(
    () => null,
    (error: unknown) => (error instanceof JanusFailure ? error.reason : error),
  );

describe.skipIf(findJanus() === null)(`Janus’ streaming plugin (needs: ${JANUS_REMEDY})`, () => {
  let janus: JanusServer;
  beforeAll(async () => {
    janus = await JanusServer.start();
  }, 30_000);
  afterAll(() => janus?.stop());

  async function connect(events: Partial<Parameters<typeof StreamingClient.connect>[1]> = {}) {
    const open = () => new WebSocket(janus.url, 'janus-protocol');
    const client = await StreamingClient.connect({ open }, { onClosed: () => undefined, ...events });
    onTestFinished(() => client.close());
    return client;
  }

  const request = (id: number): MountpointRequest => ({
    ...{ id, name: `m${id}`, description: 'Rover', metadata: '{"a":1}', secret: 's', pin: 'p' },
    ...{ adminKey: janus.adminKey, address: '127.0.0.1', srtp: null },
    media: [
      { mid: 'cloud', type: 'audio', label: 'Clouds', codec: 'opus', pt: 111 },
      { mid: 'v0', type: 'video', label: 'Front', codec: 'vp8', pt: 96 },
    ],
  });

  it('makes a mountpoint, tells about it, changes its metadata and removes it', async () => {
    const client = await connect();
    const { ports } = await client.create(request(1));
    expect(ports.map(({ mid }) => mid)).toEqual(['cloud', 'v0']);
    expect(ports.every(({ rtcp_port }) => rtcp_port !== undefined)).toBe(true);
    expect(await client.info(1, 's')).toMatchObject({ viewers: 0, metadata: '{"a":1}' });
    expect((await client.info(1)).viewers).toBe(undefined);
    await client.edit(1, 's', '{"a":2}');
    expect((await client.info(1)).metadata).toBe('{"a":2}');
    await client.destroy(1, 's');
    expect(await failureOf(client.info(1))).toBe('no-mountpoint');
  });

  it('says why it is refused', async () => {
    const client = await connect();
    expect(await failureOf(client.create({ ...request(2), adminKey: 'wrong' }))).toBe('unauthorised');
    await client.create(request(2));
    expect(await failureOf(client.create(request(2)))).toBe('plugin');
    expect(await failureOf(client.edit(2, 'wrong', ''))).toBe('unauthorised');
  });

  it('gives those who watch an offer, and tells them of new metadata and of the end', async () => {
    const owner = await connect();
    await owner.create(request(3));
    const heard: unknown[] = [];
    let wake = (): void => undefined;
    const viewer = await connect({
      onEvent: (event, jsep) => {
        heard.push(jsep?.type ?? event);
        wake();
      },
    });
    const next = async (count: number) => {
      while (heard.length < count)
        await new Promise<void>((resolve) => {
          wake = resolve;
        });
      return heard[count - 1];
    };
    await viewer.watch(3, 'p');
    expect(await next(1)).toBe('offer');
    await owner.edit(3, 's', '{"a":3}');
    expect(await next(2)).toMatchObject({ metadata: '{"a":3}' });
    await owner.destroy(3, 's');
    expect(await next(3)).toMatchObject({ result: { status: 'stopped' } });
  });

  it('notices that Janus has died', async () => {
    const closed = Promise.withResolvers<JanusFailure>();
    await connect({ onClosed: closed.resolve });
    await janus.kill();
    expect((await closed.promise).reason).toBe('closed');
    expect(await failureOf(connect())).toBe('unreachable');
    await janus.restart();
    await connect();
  });
});
