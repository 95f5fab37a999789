/** Plays a recorded exchange against a running service. */
import type { KnownDefect } from './known-defects.ts';
import { SocketPeer } from './peers/socket-peer.ts';

export interface ExchangeStep {
  open?: 'robot' | 'client';
  as?: string;
  close?: string;
  from?: string;
  send?: unknown;
  sendText?: string;
  at?: string;
  /** A message that has at least these members arrives; earlier ones are skipped. */
  expect?: unknown;
  /** The very next message has at least these members. */
  expectNext?: unknown;
}

export interface Exchange {
  name: string;
  /** Why the released signaling departs from this. */
  defect?: KnownDefect;
  /** The defect ends the program. */
  deadly?: boolean;
  steps: ExchangeStep[];
}

/**
 * `{bind: NAME}` matches any value; `{use: NAME}` inserts that value; `{containing: X}` matches a list with an X in it.
 */
type Bindings = Map<string, unknown>;

const TIMEOUT_MS = 2000;

/** @throws {Error} naming the step at which the service departs from the exchange */
export async function playExchange(
  { steps }: Exchange,
  urls: { robot: string; client: string },
): Promise<void> {
  const peers = new Map<string, SocketPeer>();
  const bindings: Bindings = new Map();
  const peer = (name: string | undefined): SocketPeer => {
    const found = peers.get(name ?? '');
    if (found === undefined) throw new Error(`no socket '${name}' in this exchange`);
    return found;
  };
  try {
    for (const [i, step] of steps.entries()) {
      try {
        if (step.open !== undefined) peers.set(step.as ?? step.open, await SocketPeer.open(urls[step.open]));
        else if (step.close !== undefined) await peer(step.close).close();
        else if (step.send !== undefined) peer(step.from).send(filled(step.send, bindings));
        else if (step.sendText !== undefined) peer(step.from).sendRaw(step.sendText);
        else if (step.expectNext !== undefined) await expectNext(peer(step.at), step.expectNext, bindings);
        else await expectMessage(peer(step.at), step.expect, bindings);
      } catch (error) {
        throw new Error(
          `step ${i + 1}, ${JSON.stringify(step)}: ${error instanceof Error ? error.message : error}`,
        );
      }
    }
  } finally {
    for (const open of peers.values()) await open.close();
  }
}

async function expectMessage(peer: SocketPeer, wanted: unknown, bindings: Bindings): Promise<void> {
  await peer.inbox.next((data) => agrees(parsed(data), wanted, bindings), TIMEOUT_MS, 'such a message');
}

async function expectNext(peer: SocketPeer, wanted: unknown, bindings: Bindings): Promise<void> {
  const data = await peer.inbox.next(undefined, TIMEOUT_MS, 'a message');
  if (!agrees(parsed(data), wanted, bindings)) throw new Error(`came: ${String(data).slice(0, 200)}`);
}

function parsed(data: string | Uint8Array): unknown {
  try {
    return JSON.parse(typeof data === 'string' ? data : new TextDecoder().decode(data));
  } catch {
    return undefined;
  }
}

function filled(value: unknown, bindings: Bindings): unknown {
  if (typeof value !== 'object' || value === null) return value;
  if (Array.isArray(value)) return value.map((part) => filled(part, bindings));
  if ('use' in value) return bindings.get(String(value.use));
  return Object.fromEntries(Object.entries(value).map(([key, part]) => [key, filled(part, bindings)]));
}

function agrees(value: unknown, wanted: unknown, bindings: Bindings): boolean {
  if (typeof wanted !== 'object' || wanted === null) return value === wanted;
  if ('use' in wanted) return value === bindings.get(String(wanted.use));
  if ('bind' in wanted) {
    bindings.set(String(wanted.bind), value);
    return value !== undefined;
  }
  if ('containing' in wanted)
    return Array.isArray(value) && value.some((part) => agrees(part, wanted.containing, bindings));
  if (typeof value !== 'object' || value === null) return false;
  return Object.entries(wanted).every(([key, part]) =>
    agrees((value as Record<string, unknown>)[key], part, bindings),
  );
}
