/** What the server says to its clients. Source: the specification of foxglove.websocket.v1. */

/**
 * Subprotocols that are one and the same protocol: the first is the name that Foxglove's current libraries and
 * applications use, the second the older one.
 */
export const SUBPROTOCOLS: readonly string[] = ['foxglove.sdk.v1', 'foxglove.websocket.v1'];

/** Opcode of a channel's message; and opcode, u32 subscription, u64 time before its bytes. */
const MESSAGE_DATA = 1;
export const MESSAGE_HEAD_BYTES = 1 + 4 + 8;

export interface ChannelSpec {
  topic: string;
  /** How messages are encoded: `cdr`, `json` … */
  messageEncoding: string;
  /** `null` for JSON that describes itself. */
  schema: { name: string; encoding: string; text: string } | null;
}

export interface Channel extends ChannelSpec {
  readonly id: number;
}

export interface ServerName {
  /** For people. */
  name: string;
  /** A client that connects again sees by it whether this is still the same run. */
  sessionId: string;
}

export function serverInfo({ name, sessionId }: ServerName): string {
  return JSON.stringify({ op: 'serverInfo', name, capabilities: [], sessionId });
}

export function advertise(channels: readonly Channel[]): string {
  return JSON.stringify({
    op: 'advertise',
    channels: channels.map(({ id, topic, messageEncoding, schema }) => ({
      id,
      topic,
      encoding: messageEncoding,
      schemaName: schema?.name ?? '',
      schema: schema?.text ?? '',
      ...(schema === null ? {} : { schemaEncoding: schema.encoding }),
    })),
  });
}

const LEVELS = { info: 0, warning: 1, error: 2 } as const;

/** A sentence that the viewer shows to its user. */
export function status(level: keyof typeof LEVELS, message: string): string {
  return JSON.stringify({ op: 'status', level: LEVELS[level], message });
}

/** What precedes a message's bytes. */
export function messageHead(subscription: number, ns: bigint): Uint8Array {
  const head = new Uint8Array(MESSAGE_HEAD_BYTES);
  const view = new DataView(head.buffer);
  view.setUint8(0, MESSAGE_DATA);
  view.setUint32(1, subscription, true);
  view.setBigUint64(5, BigInt.asUintN(64, ns), true);
  return head;
}
