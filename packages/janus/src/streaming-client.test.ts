import fc from 'fast-check';
import { describe, expect, test, vi } from 'vitest';
import { JanusFailure } from './janus-failure.ts';
import { readJanusMessage } from './janus-message.ts';
import { type JanusSocket, StreamingClient, type StreamingClientEvents } from './streaming-client.ts';

/** A socket whose other end is the test. */
class Line implements JanusSocket {
  onopen: ((event: never) => void) | null = null;
  onmessage: ((event: never) => void) | null = null;
  onclose: ((event: never) => void) | null = null;
  onerror: ((event: never) => void) | null = null;
  readonly sent: Record<string, unknown>[] = [];
  closed = false;

  send(text: string): void {
    this.sent.push(JSON.parse(text) as Record<string, unknown>);
  }

  close(): void {
    this.closed = true;
  }

  say(message: unknown): void {
    this.onmessage?.({ data: typeof message === 'string' ? message : JSON.stringify(message) } as never);
  }

  /** Answers the last request. */
  answer(message: object): void {
    this.say({ ...message, transaction: this.sent.at(-1)?.transaction });
  }
}

const turn = () => new Promise<void>((resolve) => queueMicrotask(resolve));

async function attached(events: Partial<StreamingClientEvents> = {}) {
  const line = new Line();
  const connecting = StreamingClient.connect({ open: () => line }, { onClosed: () => undefined, ...events });
  line.onopen?.(undefined as never);
  await turn();
  line.answer({ janus: 'success', data: { id: 5 } });
  for (let i = 0; i < 4; i++) await turn();
  line.answer({ janus: 'success', data: { id: 6 } });
  return { line, client: await connecting };
}

const reasonOf = (promise: Promise<unknown>) =>
  promise.then(
    () => null,
    (error: unknown) => (error as JanusFailure).reason,
  );

describe('the client', () => {
  test('names its session and handle', async () => {
    const { line, client } = await attached();
    const info = client.info(3);
    expect(line.sent.at(-1)).toMatchObject({ session_id: 5, handle_id: 6, body: { request: 'info', id: 3 } });
    const data = { streaming: 'info', info: { id: 3, media: [] } };
    line.answer({ janus: 'success', plugindata: { data } });
    expect((await info).id).toBe(3);
    client.close();
    expect(line.closed).toBe(true);
  });

  test('takes no answer for another', async () => {
    const { line, client } = await attached();
    const destroyed = client.destroy(3, 's');
    line.say({ janus: 'success', transaction: '99', plugindata: { data: { streaming: 'destroyed' } } });
    line.answer({ janus: 'success', plugindata: { data: { error_code: 455, error: 'No such mountpoint' } } });
    expect(await reasonOf(destroyed)).toBe('no-mountpoint');
    client.close();
  });

  test('refuses what cannot be an answer', async () => {
    const { line, client } = await attached();
    const created = reasonOf(client.info(3));
    line.answer({ janus: 'success', plugindata: { data: { streaming: 'info', info: { id: 'x' } } } });
    expect(await created).toBe('malformed');
    const refused = reasonOf(client.info(3));
    line.answer({ janus: 'error', error: { code: 458, reason: 'No such session' } });
    expect(await refused).toBe('refused');
    client.close();
  });

  test('ends all requests with the connection, and says so once', async () => {
    const onClosed = vi.fn();
    const { line, client } = await attached({ onClosed });
    const info = reasonOf(client.info(3));
    line.onclose?.(undefined as never);
    line.say({ janus: 'timeout' });
    expect(await info).toBe('closed');
    expect(await reasonOf(client.info(3))).toBe('closed');
    expect(onClosed).toHaveBeenCalledOnce();
  });
});

test('any text is a message or none', () => {
  fc.assert(
    fc.property(fc.oneof(fc.string(), fc.json()), (text) => {
      readJanusMessage(text);
    }),
    { seed: 1, numRuns: 500 },
  );
  expect(readJanusMessage('{"janus":"webrtcup","session_id":1,"sender":2}')).toEqual({
    janus: 'webrtcup',
    sender: 2,
  });
  expect(readJanusMessage(7)).toBe(null);
});

test('a failure has a reason for programs', () => {
  expect(new JanusFailure('timeout', 'too late')).toMatchObject({ reason: 'timeout', code: null });
});
