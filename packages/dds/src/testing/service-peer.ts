/** A stand-in for a node on rmw_cyclonedds that serves a service and an action: python_server.py, if it can be run. */
import { type ChildProcess, spawn } from 'node:child_process';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { eventually } from '@farpoint/service/testing/eventually';
import * as z from 'zod';
import { findPeer } from './peers.ts';

const PROGRAM = join(import.meta.dirname, '..', '..', 'testing', 'peers', 'python_server.py');

const request = z.object({
  event: z.literal('request'),
  number: z.int(),
  /** Its full name. */
  service: z.string(),
  client: z.string(),
  sequence: z.int(),
  fields: z.record(z.string(), z.unknown()),
});
const event = z.discriminatedUnion('event', [z.object({ event: z.literal('ready') }), request]);
export type ServedRequest = z.infer<typeof request>;

export interface ServicePeerOptions {
  domain: number;
  service?: string;
  /** Of std_srvs; `Trigger` by default. */
  type?: 'Empty' | 'Trigger' | 'SetBool';
  /** The action `robot_msgs/Dock` under this name. */
  action?: string;
  /** `no`: it does not tell its identifier, as no other implementation does. */
  identifier?: 'yes' | 'no';
}

/** What it does. Goals are 16 bytes. */
export type ServicePeerCommand =
  | { do: 'vanish' }
  | { do: 'feedback'; goal: number[]; left: number }
  | { do: 'status'; goal: number[]; status: number }
  /** @param to number of the request @param client @param sequence what is added to its header */
  | { do: 'reply'; to: number; client?: number; sequence?: number; fields?: Record<string, unknown> };

/** The command that runs it; `null` if it cannot be run here. */
export function findServicePeer(): string[] | null {
  const [python] = findPeer('Python') ?? [];
  return python === undefined ? null : [python, PROGRAM];
}

export class ServicePeer {
  readonly requests: ServedRequest[] = [];
  readonly #child: ChildProcess;
  readonly #ended: Promise<void>;
  #isReady = false;

  /** Resolves once it has joined the domain. */
  static async start(command: readonly string[], options: ServicePeerOptions): Promise<ServicePeer> {
    const [program, ...first] = command as [string, ...string[]];
    const args = Object.entries(options).flatMap(([name, value]) => [`--${name}`, String(value)]);
    const peer = new ServicePeer(spawn(program, [...first, ...args], { stdio: ['pipe', 'pipe', 'inherit'] }));
    await eventually(() => peer.#isReady);
    return peer;
  }

  private constructor(child: ChildProcess) {
    this.#child = child;
    this.#ended = new Promise((resolve) => child.once('exit', () => resolve()));
    child.stdin?.on('error', () => undefined);
    createInterface({ input: child.stdout as NodeJS.ReadableStream }).on('line', (line) => {
      const told = event.parse(JSON.parse(line));
      if (told.event === 'ready') this.#isReady = true;
      else this.requests.push(told);
    });
  }

  /** @returns the request of a service that is the `count`th, from 1 on */
  async request(service: string, count = 1): Promise<ServedRequest> {
    const all = () => this.requests.filter((each) => each.service === service);
    await eventually(() => all().length >= count);
    return all()[count - 1] as ServedRequest;
  }

  do(command: ServicePeerCommand): void {
    this.#child.stdin?.write(`${JSON.stringify(command)}\n`);
  }

  async kill(): Promise<void> {
    this.#child.kill('SIGKILL');
    await this.#ended;
  }
}
